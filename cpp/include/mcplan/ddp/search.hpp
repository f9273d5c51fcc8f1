#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "mcplan/base/status.hpp"
#include "mcplan/ddp/local_model.hpp"
#include "mcplan/ddp/pricing.hpp"
#include "mcplan/ddp/value_functions.hpp"
#include "mcplan/plan/report.hpp"

namespace mcplan::ddp {

/// Wall clock of a solve, shared by all its attempts.
class Deadline {
 public:
  explicit Deadline(double limit_s) : start_(std::chrono::steady_clock::now()), limit_s_(limit_s) {}
  double elapsed_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  bool passed() const { return elapsed_s() >= limit_s_; }

 private:
  std::chrono::steady_clock::time_point start_;
  double limit_s_;
};

/// Adds the time of a scope to a named part of the report.
class Stopwatch {
 public:
  Stopwatch(std::map<std::string, double>& timing, const char* part)
      : timing_(&timing), part_(part), start_(std::chrono::steady_clock::now()) {}
  ~Stopwatch() {
    (*timing_)[part_] += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  std::map<std::string, double>* timing_;
  const char* part_;
  std::chrono::steady_clock::time_point start_;
};

/// Where a search stands: motion, contact sequence and what they truly cost.
struct Incumbent {
  Trajectory trajectory;
  ContactSequence sequence;
  Evaluation evaluation;
};

/// How one attempt varies from the options.
struct Attempt {
  double proximal_weight = 30.0;
  double duration_initial_s = 0.45;
  StiffnessInput input = StiffnessInput::mu;
  int free_iterations = 40;     ///< with the sequence free
  int polish_iterations = 100;  ///< with the sequence frozen, at most
};

/// One descent from a first guess: search with a growing contact weight, then polish with the sequence frozen.
class Search {
 public:
  Search(const Problem& problem, const Deadline& deadline, Report& report);

  /// Runs to convergence or a limit. `now` is the first guess and holds the best iterate at the end. Returns solved when
  /// it converged (the checker has not seen it yet).
  Status run(Incumbent& now, const Attempt& attempt, bool keep_sequence);

  /// Drive the dynamics defects to rounding with the contacts exact: end-effectors on their surfaces and at rest, no
  /// force where there is no contact.
  bool make_exact(Incumbent& now);

  LocalModel& model() { return model_; }

 private:
  struct Candidate {
    Trajectory trajectory;
    Evaluation evaluation;
    double step = 0.0;
  };

  Status polish(Incumbent& now, Schedule& schedule, int iterations, double give_up_above);
  Status refine(Incumbent& now, Schedule& schedule);
  Status iterate(Incumbent& now, Schedule& schedule, bool free_sequence);
  bool line_search(const Incumbent& now, const ContactSequence& sequence, const Schedule& schedule, double merit,
                   Candidate& best);
  int switch_contacts(ContactSequence& sequence, Iteration& row);
  bool should_stop(Status& status) const;
  void log(const Iteration& row) const;

  const Problem* problem_;
  const Deadline* deadline_;
  Report* report_;
  LocalModel model_;
  ValueFunctions values_;
  Pricing pricing_;
  Evaluator evaluate_;
  std::vector<Eigen::VectorXd> dx_, du_;
  Candidate stay_, moved_;
  int whole_moves_left_ = 0;
};

}  // namespace mcplan::ddp
