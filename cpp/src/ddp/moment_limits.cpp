#include "ddp/moment_limits.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace mcplan::ddp {

double torsion_arm(const Problem& problem, int l, int surface) {
  const double friction = problem.friction[surface];
  // Point contacts have no sole to judge by; their max_moment alone counts.
  if (std::isinf(friction) || problem.limits[l].half_width <= 0.0) return std::numeric_limits<double>::infinity();
  return problem.torsion_ratio * std::min(friction, 1.0) * problem.limits[l].half_width;
}

bool about_normal(const Problem& problem, const Layout::Moment& moment, int surface) {
  // What 100 N m have beside the normal is then within the checker's tolerance of 1 uN m.
  constexpr double kBesideNormal = 1e-8;
  return problem.model == Model::lipm ||
         moment.direction_W.cross(problem.polygons[surface].normal_W()).norm() <= kBesideNormal;
}

}  // namespace mcplan::ddp
