#include "ddp/constants.hpp"
#include "ddp/leg_joints.hpp"
#include "force_rows.hpp"
#include "mcplan/base/rotation.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// By the motion, what a row of a leg depends on.
void add_row(const StepView& step, const Instant& instant, const StandingLeg& leg, double value,
             const LegJoints::Slopes& by, Rows& rows) {
  const Layout& at = step.problem.layout;
  auto g = rows.add_dense(step.schedule.interior_weight, value);
  Vector3d along_rpy = Vector3d::Zero();
  for (int axis : at.axes()) {
    const Matrix3d turned = rotation_derivative(instant.rpy, axis);
    along_rpy[axis] = by.u.dot(turned * leg.own_B) + by.up.dot(turned.col(2));
    if (!leg.has_sole) along_rpy[axis] += by.heading.dot(turned.col(0));
  }
  instant.add_along(leg.by_com * by.u + leg.mu * by.force, along_rpy, g);
  if (!by.velocity.isZero(0.0)) instant.add_along_velocity(leg.by_com * by.velocity, g);
  at.add_along_line_point(step.l, -leg.mu * by.force, g);
  at.add_along_acting_point(step.l, by.acting, g);
  // The ankle moves with the end-effector.
  g.segment<3>(at.end(step.l)) -= by.u + by.acting;
  for (int m : step.problem.jointed.ends) {
    g.segment<3>(at.end(m)) += leg.limb.hip_shift * by.u;
    g.segment<3>(at.nx() + at.stride(m)) += leg.limb.hip_shift * instant.fraction * by.u;
  }
  g[at.nx() + at.stiffness(step.l)] += by.force.dot(leg.lever) * stiffness_slope(step);
}

/// The limits of LegJoints of a leg in contact, at every instant. Not in the paper.
class JointLimits final : public CostTerm {
 public:
  JointLimits() : CostTerm("joint_limits", Scope::contact, 80) {}

  bool applies(const StepView& step) const override {
    return step.schedule.tuning.hold_joints && step.between_knots() && step.problem.limits[step.l].limb.given();
  }

  void write(const StepView& step, Rows& rows) const override {
    const Matrix3d sole = step.problem.sole_frame(step.surface, step.sole_yaw);
    for (const Instant& i : step.instants) {
      const BodyAt body{step.x, *step.u, i.fraction, i.com, i.velocity, rotation_from_rpy(i.rpy)};
      const StandingLeg leg(step.problem, step.pendulum, step.l, sole, body);
      LegJoints joints(leg);
      const auto hold = [&](LegJoints::Row row) {
        const double value = joints.value(row), beyond = std::abs(value) - joints.limit(row);
        if (!(beyond > 0.0)) return;
        if (rows.with_gradient())
          add_row(step, i, leg, beyond, joints.slopes(row, value > 0.0 ? 1.0 : -1.0), rows);
        else
          rows.add_value(step.schedule.interior_weight, beyond);
      };
      if (!joints.presses_little())
        for (const LegJoints::Row row : LegJoints::kTorques) hold(row);
      hold(LegJoints::length);
      hold(LegJoints::speed);
    }
  }
};

}  // namespace

namespace cost {
const CostTerm& joint_limits() {
  static const JointLimits term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
