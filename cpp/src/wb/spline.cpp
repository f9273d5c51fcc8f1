#include "wb/spline.hpp"

namespace mcplan::wb {

/// de Boor, A Practical Guide to Splines, ch. IX and X: derivatives are splines whose coefficients are divided
/// differences, and the second one, which is linear, has them as its values at the nodes.
Spline::Spline(const std::vector<double>& nodes_s) {
  const int count = static_cast<int>(nodes_s.size());
  const auto knot = [&](int i) {  // -3 .. count + 2
    if (i < 0) return 2.0 * nodes_s[0] - nodes_s[-i];
    if (i >= count) return 2.0 * nodes_s[count - 1] - nodes_s[2 * (count - 1) - i];
    return nodes_s[i];
  };
  basis_.resize(count);
  for (int k = 0; k < count; ++k) {
    const double t1 = knot(k - 2), t2 = knot(k - 1), t3 = knot(k), t4 = knot(k + 1), t5 = knot(k + 2);
    const double before = t4 - t1, after = t5 - t2, near = t4 - t2;
    const double right = (t4 - t3) / near, left = (t3 - t2) / near;
    const double lower = (t4 - t3) * (t4 - t3) / (before * near), upper = (t3 - t2) * (t3 - t2) / (after * near);
    basis_[k][0] = {lower, 1.0 - lower - upper, upper};
    basis_[k][1] = {-3.0 * right / before, 3.0 * right / before - 3.0 * left / after, 3.0 * left / after};
    const double scale = 6.0 / near;
    basis_[k][2] = {scale / before, -scale / before - scale / after, scale / after};
  }
}

}  // namespace mcplan::wb
