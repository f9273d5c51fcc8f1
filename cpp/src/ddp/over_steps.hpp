#pragma once

#include <algorithm>
#include <exception>

#include "base/fork.hpp"

#ifdef _OPENMP
#include <omp.h>
#endif

namespace mcplan::ddp {

/// The paper's "parallel for" over neighbours: body(k, thread) for the steps k = 1..n-1, thread < threads. Steps are
/// independent and each writes its own prices, so that the numbers are the same for any number of threads. They are
/// shared out where that is `worth` it and there is more than one thread and processor; returns whether they were.
template <class Body>
bool over_steps(int n, int threads, bool worth, const Body& body) {
#ifdef _OPENMP
  // More threads than processors gain nothing, and OpenMP ends the process where the system denies it a thread.
  const int team = std::min(threads, omp_get_num_procs());
  if (team > 1 && worth && !forked()) {
    std::exception_ptr failure;  // out of memory; an exception that left the loop would end the process
#pragma omp parallel for num_threads(team) schedule(static)
    for (int k = 1; k < n; ++k) {
      try {
        body(k, omp_get_thread_num());
      } catch (...) {
#pragma omp critical(step_failure)
        failure = std::current_exception();
      }
    }
    if (failure) std::rethrow_exception(failure);
    return true;
  }
#endif
  for (int k = 1; k < n; ++k) body(k, 0);
  return false;
}

}  // namespace mcplan::ddp
