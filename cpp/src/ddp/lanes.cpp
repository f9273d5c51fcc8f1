#include "ddp/lanes.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <thread>
#include <utility>

#include "base/fork.hpp"
#include "ddp/constants.hpp"

#ifdef _OPENMP
#include <omp.h>
#endif

namespace mcplan::ddp {

int team_of(int threads) {
#ifdef _OPENMP
  if (!forked() && !omp_in_parallel()) return std::min(threads, omp_get_num_procs());
#endif
  return 1;
}

bool run_ahead(int count, int team, const StopRequest& stop,
               const std::function<bool(int task, int thread, const StopRequest& stop)>& run) {
  std::atomic<int> next{0}, last{count - 1}, working{0};
  std::atomic<bool> stopped{false};
  std::exception_ptr failure;
#ifdef _OPENMP
#pragma omp parallel num_threads(team)
#endif
  {
#ifdef _OPENMP
    const int thread = omp_get_thread_num();
#else
    const int thread = 0;
#endif
    ++working;
#pragma omp barrier
    try {
      const auto asked = [&] {
        if (thread == 0 && stop && stop()) stopped = true;
        return stopped.load();
      };
      for (int task = next++; task <= last && !asked(); task = next++) {
        if (!run(task, thread, [&] { return task > last || asked(); })) continue;
        for (int end = last; task < end && !last.compare_exchange_weak(end, task);) {
        }
      }
      // Only the caller's thread may ask, whoever is still at work.
      for (--working; thread == 0 && working > 0; std::this_thread::sleep_for(std::chrono::microseconds(kAskPause_us)))
        asked();
    } catch (...) {
#pragma omp critical(task_failure)
      failure = std::current_exception();
      stopped = true;
      --working;
    }
  }
  if (failure) std::rethrow_exception(failure);
  return stopped;
}

Lanes::Lanes(Search& main, const Deadline& deadline) : main_(&main), deadline_(&deadline) {}

void Lanes::run(int count, const Run& task) {
  const Problem& problem = main_->problem();
  const int team = std::min(count, team_of(problem.options.threads));
  tasks_.clear();
  // Near a time limit iterates are looked at as they come.
  if (team < 2 || (deadline_->limited() && deadline_->remaining_s() < kAheadRest_s)) return;
  tasks_.resize(count);
  while (static_cast<int>(lanes_.size()) < team) lanes_.push_back(std::make_unique<Lane>(problem, *deadline_, unused_));
  const bool stopped = run_ahead(count, team, problem.options.stop, [&](int i, int thread, const StopRequest& stop) {
    Search& search = lanes_[thread]->search;
    search.stand_in_for(*main_, tasks_[i].trace, stop);
    const bool ends = task(i, search);
    tasks_[i].complete = !stop();
    return ends;
  });
  if (stopped) main_->interrupt();
}

const Search::Trace* Lanes::trace(int task) const {
  return task < static_cast<int>(tasks_.size()) && tasks_[task].complete ? &tasks_[task].trace : nullptr;
}

bool Lanes::tell(int task, int rows) { return trace(task) && main_->replay(std::move(tasks_[task].trace), rows); }

}  // namespace mcplan::ddp
