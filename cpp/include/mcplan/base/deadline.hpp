#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <utility>

namespace mcplan {

/// Seconds since any origin, never going back; null stands for the steady clock. A test hands in its own, and a
/// deadline then falls at the same instruction on every machine.
using Clock = std::function<double()>;

/// The time limit of one solve: begins when it is made, and is handed to everything that may take long.
class Deadline {
 public:
  explicit Deadline(double limit_s = std::numeric_limits<double>::infinity(), Clock clock = nullptr)
      : clock_(std::move(clock)), limit_s_(limit_s), start_s_(now_s()) {}

  /// The same beginning, ending earlier by what must still be done after it, but after half the limit at least.
  Deadline reserving(double finishing_s) const {
    Deadline out = *this;
    if (limited()) out.limit_s_ -= std::min(finishing_s, 0.5 * limit_s_);
    return out;
  }

  double elapsed_s() const { return now_s() - start_s_; }
  double remaining_s() const { return limit_s_ - elapsed_s(); }
  bool passed() const { return limited() && remaining_s() <= 0.0; }
  bool limited() const { return limit_s_ < std::numeric_limits<double>::infinity(); }

  /// Reading of the clock [s].
  double now_s() const {
    if (clock_) return clock_();
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

 private:
  Clock clock_;
  double limit_s_, start_s_;
};

}  // namespace mcplan
