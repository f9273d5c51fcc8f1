#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "planar/sip/taylor_model.hpp"

namespace mcplan::sip::proof {

/// Bounds of a quantity over a piece of time, and at the piece's begin, middle and end. What is above a limit at one of
/// these places, by its lower bound, is a violation; what is below it over the piece, by its upper bound, is proved.
struct Amount {
  static constexpr int kPlaces = 3;
  static constexpr double place(int i) { return i - 1.0; }  ///< s = -1, 0, 1

  Range over;
  std::array<Range, kPlaces> at;
  double rounding = 0.0;  ///< how much of the bounds' width is for floating-point arithmetic

  static Amount of(const TaylorModel& f) { return of(f, f.rounding()); }
  static Amount of(const UncertainPolynomial& p) { return of(p, p.error); }

  /// The same operation on all bounds.
  template <class Operation>
  Amount map(const Operation& operation) const {
    Amount out{operation(over), {}, rounding};
    for (int i = 0; i < kPlaces; ++i) out.at[i] = operation(at[i]);
    return out;
  }
  template <class Operation>
  Amount map(const Amount& other, const Operation& operation) const {
    Amount out{operation(over, other.over), {}, std::max(rounding, other.rounding)};
    for (int i = 0; i < kPlaces; ++i) out.at[i] = operation(at[i], other.at[i]);
    return out;
  }

  double upper() const { return over.max; }
  int worst_place() const {
    int worst = 0;
    for (int i = 1; i < kPlaces; ++i)
      if (at[i].min > at[worst].min) worst = i;
    return worst;
  }
  double lower() const { return at[worst_place()].min; }

 private:
  /// Not a number, from an overflow, bounds nothing.
  static Range known(const Range& r) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {std::isnan(r.min) ? -infinity : r.min, std::isnan(r.max) ? infinity : r.max};
  }
  template <class Function>
  static Amount of(const Function& f, double rounding) {
    Amount out{known(f.range()), {}, rounding};
    for (int i = 0; i < kPlaces; ++i) out.at[i] = known(f.at(place(i)));
    return out;
  }
};

/// factor a + shift, rounded outward; factor and shift may themselves come from a few operations.
inline Amount scaled(const Amount& a, double factor, double shift) {
  Amount out = a.map([&](const Range& r) {
    const double low = (factor < 0.0 ? r.max : r.min) * factor, high = (factor < 0.0 ? r.min : r.max) * factor;
    constexpr double relative = 32.0 * std::numeric_limits<double>::epsilon();
    const double margin = relative * (std::max(std::abs(low), std::abs(high)) + std::abs(shift)) + 1e-300;
    return Range{low + shift - margin, high + shift + margin};
  });
  out.rounding *= std::abs(factor);
  return out;
}

inline Amount absolute(const Amount& a) {
  return a.map([](const Range& r) {
    return Range{std::max({0.0, r.min, -r.max}), std::max(std::abs(r.min), std::abs(r.max))};
  });
}

/// Square root of a square, whose bounds may reach below zero.
inline Amount root(const Amount& a) {
  return a.map([](const Range& r) {
    constexpr double down = 1.0 - 1e-15, up = 1.0 + 1e-15;
    return Range{std::sqrt(std::max(0.0, r.min)) * down, std::sqrt(std::max(0.0, r.max)) * up};
  });
}

inline Amount larger(const Amount& a, const Amount& b) {
  return a.map(b, [](const Range& r, const Range& q) { return Range{std::max(r.min, q.min), std::max(r.max, q.max)}; });
}

inline Amount smaller(const Amount& a, const Amount& b) {
  return a.map(b, [](const Range& r, const Range& q) { return Range{std::min(r.min, q.min), std::min(r.max, q.max)}; });
}

}  // namespace mcplan::sip::proof
