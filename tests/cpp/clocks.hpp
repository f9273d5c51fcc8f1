#pragma once

#include <memory>

#include "mcplan/base/deadline.hpp"

/// A clock that stands still but for `tick_s` at every look at it: what a time limit does is then the same on every
/// machine, however busy. Copies share their time, and options hold one by value.
struct CountingClock {
  explicit CountingClock(double tick_s = 0.0) : time_s(std::make_shared<double>(0.0)), tick(tick_s) {}
  double operator()() const { return *time_s += tick; }
  void advance(double seconds) const { *time_s += seconds; }

  std::shared_ptr<double> time_s;
  double tick;
};
