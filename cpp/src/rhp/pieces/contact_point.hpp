#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <vector>

namespace mcplan::rhp {

/// Where a foot stands: a surface's frame and two coordinates w on it, p = origin + w1 t1 + w2 t2. What a foot stands
/// on at the start of the horizon is a placement too, whose w is fixed at zero.
struct Placement {
  int foot = 0;
  int surface = -1;
  Eigen::Vector3d origin_W = Eigen::Vector3d::Zero();    ///< [m]
  Eigen::Matrix3d axes_W = Eigen::Matrix3d::Identity();  ///< columns t1, t2, n
  int variable = -1;                                     ///< of w1; w2 follows

  Eigen::Vector3d position_W(const Eigen::Vector2d& w) const { return origin_W + axes_W.leftCols<2>() * w; }
};

/// Forces count in hundreds of newtons, so that all variables are of the order of one.
inline constexpr double kForceUnit = 100.0;

/// A point of a foot in contact and its force
///
///     f = kForceUnit * directions * (variables),
///
/// the directions either t1, t2, n with friction as rows, or the edges of the friction pyramid (of unit normal
/// component) with variables that are not negative and no rows.
struct ContactPoint {
  int placement = 0;                                   ///< index
  Eigen::Vector3d offset_W = Eigen::Vector3d::Zero();  ///< from the foot's centre [m]
  int variable = -1;                                   ///< the first; one for each direction
  Eigen::Matrix3Xd edges_W;                            ///< of the pyramid; none: t1, t2, n

  int count() const { return edges_W.cols() > 0 ? static_cast<int>(edges_W.cols()) : 3; }
  Eigen::Matrix3Xd directions_W(const Placement& at) const {
    return edges_W.cols() > 0 ? edges_W : Eigen::Matrix3Xd(at.axes_W);
  }
  Eigen::Vector3d force_W(const Placement& at, const Eigen::VectorXd& x) const {
    return kForceUnit * directions_W(at) * x.segment(variable, count());
  }
};

/// Indices of `count` variables from `first` on, appended to a list; returns where they begin in it.
inline int append(std::vector<int>& variables, int first, int count) {
  const int at = static_cast<int>(variables.size());
  for (int i = 0; i < count; ++i) variables.push_back(first + i);
  return at;
}

/// Indices of three variables from each of `triples` on, then of the duration.
inline std::vector<int> triples_and_duration(std::initializer_list<int> triples, int duration) {
  std::vector<int> variables;
  for (int first : triples) append(variables, first, 3);
  append(variables, duration, 1);
  return variables;
}

/// a x b = skew(a) b.
inline Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d out;
  out << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return out;
}

}  // namespace mcplan::rhp
