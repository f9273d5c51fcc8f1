#pragma once

namespace mcplan {

/// A closed interval.
struct Range {
  double min = 0.0, max = 0.0;
};

inline bool operator==(const Range& a, const Range& b) { return a.min == b.min && a.max == b.max; }
inline bool operator!=(const Range& a, const Range& b) { return !(a == b); }

}  // namespace mcplan
