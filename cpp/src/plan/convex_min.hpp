#pragma once

namespace mcplan {

/// Where on 0 <= s <= 1 a convex function is least, within 1e-8: by the golden section.
template <class Function>
double convex_min(const Function& value) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kSteps = 39;  // kGolden^39 < 1e-8
  double low = 0.0, high = 1.0, left = 1.0 - kGolden, right = kGolden;
  double at_left = value(left), at_right = value(right);
  for (int i = 0; i < kSteps; ++i) {
    if (at_left <= at_right) {
      high = right, right = left, at_right = at_left;
      at_left = value(left = high - kGolden * (high - low));
    } else {
      low = left, left = right, at_left = at_right;
      at_right = value(right = low + kGolden * (high - low));
    }
  }
  return 0.5 * (low + high);
}

}  // namespace mcplan
