#pragma once

namespace mcplan::nlp {

/// Lets `fork()` happen only while no thread is inside of a solver that keeps global state.
///
/// Such a solver (MUMPS) has allocated and freed half of its module's arrays in the middle of a call; a child forked at
/// that moment inherits them so, and its own first solve frees what was never allocated. So each thread holds the gate
/// while it is in the solver and opens it in callbacks, between two calls of MUMPS; a fork waits for that, which
/// takes a factorisation at most. Callbacks may wait for locks of the forking thread (Python's), since the gate is open
/// while they do.
class ForkGate {
 public:
  ForkGate();
  ~ForkGate();
  ForkGate(const ForkGate&) = delete;
  ForkGate& operator=(const ForkGate&) = delete;

  /// Opens the gate that this thread holds while it lives: for the time of a callback.
  class Opening {
   public:
    Opening();
    ~Opening();
    Opening(const Opening&) = delete;
    Opening& operator=(const Opening&) = delete;
  };
};

}  // namespace mcplan::nlp
