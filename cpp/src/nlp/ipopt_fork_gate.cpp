#include "nlp/ipopt_fork_gate.hpp"

#include <pthread.h>
#include <sched.h>

#include <atomic>
#include <shared_mutex>

namespace mcplan::nlp {
namespace {

/// Shared by threads in a solver, held alone by one that forks. A child gets one of its own: those that held its
/// parent's are not there to let go.
std::shared_mutex* gate = new std::shared_mutex;
/// A shared mutex lets those that share it in before one that waits for it alone: they wait for these by themselves.
std::atomic<int> waiting{0};
/// Whether this thread holds the gate; of a thread that forks from within the solver nothing can be waited for.
thread_local bool holds = false;

void take() {
  while (waiting > 0) sched_yield();
  gate->lock_shared();
  holds = true;
}

void give_back() {
  holds = false;
  gate->unlock_shared();
}

void before_fork() {
  if (holds) return;
  ++waiting;
  gate->lock();
}

void after_fork_in_parent() {
  if (holds) return;
  gate->unlock();
  --waiting;
}

void after_fork_in_child() {
  gate = new std::shared_mutex;
  if (holds) gate->lock_shared();
  waiting = 0;
}

[[maybe_unused]] const int gate_at_fork = pthread_atfork(before_fork, after_fork_in_parent, after_fork_in_child);

}  // namespace

ForkGate::ForkGate() { take(); }
ForkGate::~ForkGate() { give_back(); }
ForkGate::Opening::Opening() { give_back(); }
ForkGate::Opening::~Opening() { take(); }

}  // namespace mcplan::nlp
