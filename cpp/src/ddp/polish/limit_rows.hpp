#pragma once

#include <Eigen/Core>
#include <cmath>
#include <utility>

#include "ddp/polish/fixed_sequence.hpp"
#include "ddp/polish/motion.hpp"

namespace mcplan::ddp::polish {

/// Rounds the tip of a friction cone, as a length beside the force's direction of about one CoM height. Chosen.
constexpr double kConeTip = 3e-4;

/// Where the rows of a contact begin that hold at instants, and what they compare with.
struct OfContact {
  int first = 0;
  double friction = 0.0;
  int sides = -1;          ///< of the friction pyramid; 0: the cone, -1: neither
  double force_max = 0.0;  ///< 0: none
  double torsion_arm = 0.0;
  int moments = 0;  ///< that friction bounds
  bool yaw = false;
};

/// What the force rows of a contact need of its phase.
struct ForceView {
  ForceView(const Problem& problem, const Pendulum& pendulum, const Eigen::VectorXd& x, const Eigen::VectorXd& u,
            const Standing& s, const OfContact& limits)
      : of(limits),
        n(problem.polygons[s.surface].normal_W()),
        tangents(limits.sides > 0 ? &problem.pyramid[s.surface] : nullptr),
        pyramid_ratio(problem.pyramid_ratio),
        line_point(problem.layout.line_point(x, u, s.l)),
        mu(pendulum.mu(u, s.l)) {
    const double input = u[problem.layout.stiffness(s.l)];
    slope = problem.options.stiffness_input == StiffnessInput::lambda ? 2.0 * input : 1.0;
    for (int i = 0; i < limits.moments; ++i) tau[i] = u[problem.layout.moment(s.moments[i])];
  }
  const OfContact& of;
  const Eigen::Vector3d& n;
  const std::vector<Eigen::Vector3d>* tangents;
  double pyramid_ratio;
  Eigen::Vector3d line_point;  ///< s_l
  double mu, slope = 1.0;      ///< mu_l, and by its input
  double tau[3] = {0.0, 0.0, 0.0};
};

/// The rows of a contact that depend on d = p(t) - s_l, on its stiffness input and its moments, at one instant:
/// visit(row, value, d/dd, d/d(stiffness input), moment or -1, d/d(moment)).
template <class Visit>
void visit_forces(const ForceView& v, const Eigen::Vector3d& com, int& row, Visit&& visit) {
  using Eigen::Vector3d;
  const Vector3d d = com - v.line_point;
  const double normal = v.n.dot(d);
  if (v.of.sides == 0) {
    const Vector3d along = d - normal * v.n;
    const double length = std::sqrt(along.squaredNorm() + kConeTip * kConeTip);
    visit(row++, length - v.of.friction * normal, Vector3d(along / length - v.of.friction * v.n), 0.0, -1, 0.0);
  } else if (v.of.sides > 0) {
    for (const Vector3d& t : *v.tangents) {
      const Vector3d along = t - v.of.friction * v.pyramid_ratio * v.n;
      visit(row++, along.dot(d), along, 0.0, -1, 0.0);
    }
  }
  if (v.of.force_max > 0.0) {
    const double distance = d.norm();
    visit(row++, v.mu * distance - v.of.force_max, Vector3d(v.mu / distance * d), distance * v.slope, -1, 0.0);
  }
  for (int i = 0; i < v.of.moments; ++i) {
    const double most = v.of.torsion_arm * v.mu * normal;
    const Vector3d along = -v.of.torsion_arm * v.mu * v.n;
    const double by_stiffness = -v.of.torsion_arm * normal * v.slope;
    visit(row++, v.tau[i] - most, along, by_stiffness, i, 1.0);
    visit(row++, -v.tau[i] - most, along, by_stiffness, i, -1.0);
  }
}

/// Rows of the reach of an end-effector: both sides of its box by axis, then the faces that cut it.
inline int reach_rows(const EndLimits& limit) { return 6 + limit.cuts; }

/// Values of these rows, planned so far inside, from `row` on, which is left behind them.
inline void reach_values(const BodyPose& pose, const Eigen::Vector3d& end, const EndLimits& limit, double room,
                         int& row, Eigen::ArrayXd& r) {
  const Eigen::Vector3d place = pose.rotation.transpose() * (end - pose.com);
  for (int i = 0; i < 3; ++i) {
    r[row++] = place[i] - limit.reach_max[i] + room;
    r[row++] = limit.reach_min[i] - place[i] + room;
  }
  for (int i = 0; i < limit.cuts; ++i) r[row++] = limit.cut_A.row(i).dot(place) - limit.cut_b[i] + room;
}

}  // namespace mcplan::ddp::polish
