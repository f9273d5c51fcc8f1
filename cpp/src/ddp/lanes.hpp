#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "ddp/search.hpp"

namespace mcplan::ddp {

/// Threads to share work out over, of so many that are asked for: no more than there are processors, and the caller's
/// alone where OpenMP is missing, in a child of fork() and within a loop that is shared out already.
int team_of(int threads);

/// run(task, thread, stop) for tasks from 0 on, on a team of threads of which the caller's is 0, until all are done or
/// one returns true: later ones are not begun then, and those under way are asked to stop. So are all when `stop`,
/// which the caller's thread alone asks, says so; returns whether it did. What a task throws is thrown here.
bool run_ahead(int count, int team, const StopRequest& stop,
               const std::function<bool(int task, int thread, const StopRequest& stop)>& run);

/// A loop of a search over tasks that do not depend on each other, of which the first that succeeds ends the loop:
/// first guesses, changed sequences. Threads run tasks ahead; what they did is told in the order of the tasks as if the
/// main search had done it, and the rest is forgotten. Report, iterates and plan are thus the same for any number of
/// threads.
class Lanes {
 public:
  /// Keeps a reference to the search, whose problem it copies for every further thread.
  Lanes(Search& main, const Deadline& deadline);

  /// Does the task by this search; true: the loop ends with it. Writes to what belongs to its task alone.
  using Run = std::function<bool(int task, Search& search)>;

  /// Run tasks ahead where that pays.
  void run(int count, const Run& task);

  /// What a thread has done for the task, or null: the main search has to do it.
  const Search::Trace* trace(int task) const;

  /// Tell of the first `rows` iterations of a task, or of all. False: nothing is told, the main search has to do it.
  bool tell(int task, int rows = -1);

 private:
  struct Lane {
    Lane(const Problem& of, const Deadline& deadline, Report& report)
        : problem(of), search(problem, deadline, report) {}
    Problem problem;  // its dynamics have a scratch for one thread
    Search search;
  };
  struct Task {
    Search::Trace trace;
    bool complete = false;
  };

  Search* main_;
  const Deadline* deadline_;
  Report unused_;
  std::vector<std::unique_ptr<Lane>> lanes_;
  std::vector<Task> tasks_;
};

}  // namespace mcplan::ddp
