#pragma once

#include <atomic>
#include <exception>
#include <thread>
#include <type_traits>
#include <vector>

/// What work(0) .. work(count - 1) return, each in a thread of its own; none begins before all are there. What one of
/// them throws is thrown here.
template <typename Work>
auto in_threads(int count, const Work& work) {
  std::vector<std::invoke_result_t<Work, int>> results(count);
  std::vector<std::exception_ptr> errors(count);
  std::vector<std::thread> threads;
  std::atomic<int> waiting = count;
  for (int t = 0; t < count; ++t)
    threads.emplace_back([&, t] {
      for (--waiting; waiting > 0;) std::this_thread::yield();
      try {
        results[t] = work(t);
      } catch (...) {
        errors[t] = std::current_exception();
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  return results;
}
