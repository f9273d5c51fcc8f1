#pragma once

#include <cstddef>
#include <cstdlib>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define MCPLAN_TEST_SANITIZED
#endif
#endif
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && \
    !defined(MCPLAN_TEST_SANITIZED)
#define MCPLAN_TEST_COUNTS_ALLOCATIONS
#endif

/// How often this thread has asked for memory, Eigen's matrices included: these call malloc and no operator new, so
/// that malloc is what is replaced. To be included in one source of a test program. Without glibc nothing is counted.
inline thread_local long allocations = 0;

#ifdef MCPLAN_TEST_COUNTS_ALLOCATIONS
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* malloc(std::size_t size) noexcept {
  ++allocations;
  return __libc_malloc(size);
}
#endif
