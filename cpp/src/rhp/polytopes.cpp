#include "rhp/polytopes.hpp"

#include <Eigen/LU>
#include <cmath>
#include <vector>

namespace mcplan::rhp {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Corners on a plane count once, however many planes meet there.
bool holds(const std::vector<Vector3d>& corners, const Vector3d& corner) {
  for (const Vector3d& known : corners)
    if ((known - corner).norm() < 1e-7) return true;
  return false;
}

}  // namespace

Polytope box_polytope(const Vector3d& low, const Vector3d& high) {
  Polytope out;
  out.A.resize(6, 3);
  out.A << Matrix3d::Identity(), -Matrix3d::Identity();
  out.b.resize(6);
  out.b << high, -low;
  return out;
}

Polytope without_implied_rows(const Polytope& polytope, const Vector3d& low, const Vector3d& high) {
  const Polytope box = box_polytope(low, high);
  const int own = static_cast<int>(polytope.A.rows()), all = own + 6;
  Eigen::Matrix<double, Eigen::Dynamic, 3> A(all, 3);
  Eigen::VectorXd b(all);
  A << polytope.A, box.A;
  b << polytope.b, box.b;

  constexpr double kTolerance = 1e-9;
  std::vector<std::vector<Vector3d>> corners(own);
  for (int i = 0; i < all; ++i)
    for (int j = i + 1; j < all; ++j)
      for (int k = j + 1; k < all && i < own; ++k) {
        Matrix3d planes;
        planes << A.row(i), A.row(j), A.row(k);
        if (std::abs(planes.determinant()) < 1e-10) continue;
        const Vector3d corner = planes.inverse() * Vector3d(b[i], b[j], b[k]);
        if (((A * corner - b).array() > kTolerance).any()) continue;
        for (int row : {i, j, k})
          if (row < own && !holds(corners[row], corner)) corners[row].push_back(corner);
      }
  Polytope out;
  std::vector<int> kept;
  for (int i = 0; i < own; ++i)
    if (corners[i].size() >= 3) kept.push_back(i);
  out.A.resize(kept.size(), 3);
  out.b.resize(kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    out.A.row(i) = polytope.A.row(kept[i]);
    out.b[i] = polytope.b[kept[i]];
  }
  return out;
}

Polytope com_reach_of(const EndEffector& foot) {
  if (foot.com_reach.given()) return foot.com_reach;
  const Eigen::AlignedBox3d usual = foot.usual_box();
  const Polytope box = box_polytope(-usual.max(), -usual.min());
  if (!foot.reach_cut.given()) return box;
  // Of the CoM relative to the foot, where the cut is of the foot relative to the CoM.
  Polytope out;
  out.A.resize(box.A.rows() + foot.reach_cut.A.rows(), 3);
  out.A << box.A, -foot.reach_cut.A;
  out.b.resize(out.A.rows());
  out.b << box.b, foot.reach_cut.b;
  return out;
}

Polytope partner_reach_of(const EndEffector& foot, const EndEffector& other) {
  const auto given = foot.partner_reach.find(other.name);
  if (given != foot.partner_reach.end() && given->second.given()) return given->second;
  const Eigen::AlignedBox3d own = foot.usual_box(), its = other.usual_box();
  return box_polytope(its.min() - own.max(), its.max() - own.min());
}

Polytope rotated(const Polytope& polytope, const Matrix3d& R) { return {polytope.A * R.transpose(), polytope.b}; }

}  // namespace mcplan::rhp
