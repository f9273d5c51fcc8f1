#include "base/fork.hpp"

#include <pthread.h>

#include <atomic>

namespace mcplan {
namespace {

std::atomic<bool> in_child{false};
[[maybe_unused]] const int at_fork = pthread_atfork(nullptr, nullptr, [] { in_child = true; });

}  // namespace

bool forked() { return in_child; }

}  // namespace mcplan
