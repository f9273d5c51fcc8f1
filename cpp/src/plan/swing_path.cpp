#include "swing_path.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mcplan/base/rotation.hpp"
#include "plan/hermite.hpp"
#include "plan/swing_lift.hpp"

namespace mcplan {

using Eigen::Vector3d;

namespace {

/// A number and its rate.
struct Moving {
  double value, rate;
};

/// Of y, how far something is beyond a limit, and the width w of a band on both sides of it: y before the band, 0 after
/// it, and between them, with u = (y + w) / 2w,
///
///     -w + 2 w (u - u^3 + u^4 / 2),
///
/// twice continuously differentiable in y and w. Without a band, min(y, 0).
Moving bent(const Moving& y, const Moving& band) {
  if (!(y.value > -band.value)) return y;
  if (y.value >= band.value) return {0.0, 0.0};
  const double u = (y.value + band.value) / (2.0 * band.value), u2 = u * u;
  const double g = u - u * u2 + 0.5 * u2 * u2, slope = 1.0 - 3.0 * u2 + 2.0 * u * u2;
  return {band.value * (2.0 * g - 1.0), slope * y.rate + (2.0 * g - 1.0 - (2.0 * u - 1.0) * slope) * band.rate};
}

/// The lift at s = t / total, over the swing's height.
Moving bump_at(double s, double total) {
  const SwingLift lift(s);
  return {lift.value(), lift.rate() / total};
}

double swung(const ActiveSwing& active, double since_start) {
  return std::clamp((active.before_s + since_start) / active.total_s, 0.0, 1.0);
}

/// From `lift` at s = 0 by way of `middle` to `land` at s = 1.
Moving band_at(double lift, double middle, double land, double s, double total) {
  const Moving bump = bump_at(s, total);
  const double ends = (1.0 - s) * lift + s * land;
  return {ends + bump.value * (middle - ends),
          (1.0 - bump.value) * (land - lift) / total + bump.rate * (middle - ends)};
}

/// Add L(s), s = 0..1 of `total` [s], to a place and a velocity.
void add_lift(const Swing& swing, double s, double total, Vector3d& position_W, Vector3d& velocity_W) {
  const Moving bump = bump_at(s, total);
  const Vector3d turn = swing.land_normal_W - swing.lift_normal_W;
  if (turn.isZero(0.0) && swing.lift_normal_W.squaredNorm() == 1.0) {
    position_W += swing.height * bump.value * swing.lift_normal_W;
    velocity_W += swing.height * bump.rate * swing.lift_normal_W;
    return;
  }
  const Vector3d along = swing.lift_normal_W + s * turn;
  // Opposite normals (a hand going from one wall to the facing one) make the sum vanish half way: no bump there.
  const double length = along.norm();
  if (length < 1e-6) return;
  const Vector3d n = along / length;
  const Vector3d n_rate = (turn - n * n.dot(turn)) / (length * total);
  position_W += swing.height * bump.value * n;
  velocity_W += swing.height * (bump.rate * n + bump.value * n_rate);
}

void add_clearance(const ActiveSwing& active, double since_start, EndEffectorState& end) {
  const double before = active.swing->elapsed_s, since_knot = active.before_s + since_start;
  const double total = before + active.total_s;
  add_lift(*active.swing, std::clamp((before + since_knot) / total, 0.0, 1.0), total, end.position_W, end.velocity_W);
  if (before == 0.0) return;
  // What the first knot has of the lift already.
  Vector3d begun = Vector3d::Zero(), begun_rate = Vector3d::Zero(), position, velocity;
  add_lift(*active.swing, before / total, total, begun, begun_rate);
  const Hermite rest(active.total_s, swung(active, since_start));
  rest.put(begun, begun_rate, Vector3d::Zero(), Vector3d::Zero(), position, velocity);
  end.position_W -= position;
  end.velocity_W -= velocity;
}

/// The path bends within a band inside of the box's sides, so that its velocity goes on where it comes to one.
void hold_in_reach(const ActiveSwing& active, double since_start, const PlanState& state, const RpyTrig& trig,
                   const Eigen::Matrix3d& r_WB, EndEffectorState& end) {
  const Vector3d &low = active.reach_min_B, &high = active.reach_max_B;
  const Vector3d offset = end.position_W - state.com_W;
  Vector3d relative = r_WB.transpose() * offset;
  const Vector3d& near = active.middle_band_B;
  if ((relative.array() >= (low + near).array()).all() && (relative.array() <= (high - near).array()).all()) return;
  const double s = swung(active, since_start), total = active.total_s;
  const Vector3d spin = trig.angular_velocity_W(state.base_rpy_rate);
  Vector3d rate = r_WB.transpose() * (end.velocity_W - state.com_velocity_W - spin.cross(offset));
  for (int i = 0; i < 3; ++i) {
    const int upper = relative[i] - high[i] > low[i] - relative[i];
    const double out = upper ? 1.0 : -1.0, side = upper ? high[i] : low[i];
    const Moving beyond{out * (relative[i] - side), out * rate[i]};
    if (!(beyond.value > -near[i])) continue;
    const Moving held =
        bent(beyond, band_at(active.lift_bands_B[upper][i], near[i], active.land_bands_B[upper][i], s, total));
    relative[i] = side + out * held.value;
    rate[i] = out * held.rate;
  }
  end.position_W = state.com_W + r_WB * relative;
  end.velocity_W = state.com_velocity_W + spin.cross(r_WB * relative) + r_WB * rate;
}

/// The same at the faces that cut the box, after its sides: along the axis that a face cuts off most of.
void hold_in_cuts(const ActiveSwing& active, double since_start, const PlanState& state, const RpyTrig& trig,
                  const Eigen::Matrix3d& r_WB, EndEffectorState& end) {
  for (int i = 0; i < active.cut_count; ++i) {
    const ActiveSwing::Cut& cut = active.cuts[i];
    const Vector3d offset = end.position_W - state.com_W;
    Vector3d relative = r_WB.transpose() * offset;
    const double beyond = cut.normal_B.dot(relative) - cut.max;
    if (!(beyond > -cut.middle_band)) continue;
    const Vector3d spin = trig.angular_velocity_W(state.base_rpy_rate);
    Vector3d rate = r_WB.transpose() * (end.velocity_W - state.com_velocity_W - spin.cross(offset));
    const Moving free{beyond, cut.normal_B.dot(rate)};
    const Moving held =
        bent(free, band_at(cut.lift_band, cut.middle_band, cut.land_band, swung(active, since_start), active.total_s));
    int axis = 0;
    cut.normal_B.cwiseAbs().maxCoeff(&axis);
    relative[axis] += (held.value - free.value) / cut.normal_B[axis];
    rate[axis] += (held.rate - free.rate) / cut.normal_B[axis];
    end.position_W = state.com_W + r_WB * relative;
    end.velocity_W = state.com_velocity_W + spin.cross(r_WB * relative) + r_WB * rate;
  }
}

}  // namespace

ActiveSwing active_swing(const Plan& plan, const Swing& swing, int phase) {
  const EndEffector& limits = plan.robot.end_effectors[swing.end_effector];
  ActiveSwing out;
  out.swing = &swing;
  const Eigen::AlignedBox3d usual = limits.usual_box();
  out.reach_min_B = usual.min();
  out.reach_max_B = usual.max();
  for (int k = swing.first_phase; k < swing.end_phase; ++k) {
    if (k == phase) out.before_s = out.total_s;
    out.total_s += plan.phases[k].duration;
  }
  // The knots themselves may lie outside by the planner's tolerance; widening by them keeps the path continuous.
  const auto relative_at = [&](int k) -> Vector3d {
    const Knot& knot = plan.knots[k];
    return rotation_from_rpy(knot.base_rpy).transpose() * (knot.end_effectors_W[swing.end_effector] - knot.com_W);
  };
  const Vector3d lift = relative_at(swing.first_phase), land = relative_at(swing.end_phase);
  out.reach_min_B = out.reach_min_B.cwiseMin(lift).cwiseMin(land);
  out.reach_max_B = out.reach_max_B.cwiseMax(lift).cwiseMax(land);
  // No wider at the ends than these are away from the box's sides: there the path is the contact's.
  out.middle_band_B = (out.reach_max_B - out.reach_min_B) / 20.0;
  out.lift_bands_B[0] = out.middle_band_B.cwiseMin(lift - out.reach_min_B);
  out.lift_bands_B[1] = out.middle_band_B.cwiseMin(out.reach_max_B - lift);
  out.land_bands_B[0] = out.middle_band_B.cwiseMin(land - out.reach_min_B);
  out.land_bands_B[1] = out.middle_band_B.cwiseMin(out.reach_max_B - land);
  // A plan may be asked for its motion before anyone has validated its robot.
  const Polytope& cuts = limits.reach_cut;
  out.cut_count = static_cast<int>(std::min<Eigen::Index>({cuts.A.rows(), cuts.b.size(), kReachCuts}));
  for (int i = 0; i < out.cut_count; ++i) {
    ActiveSwing::Cut& cut = out.cuts[i];
    cut.normal_B = cuts.A.row(i).transpose();
    cut.max = std::max({cuts.b[i], cut.normal_B.dot(lift), cut.normal_B.dot(land)});
    cut.middle_band = cut.normal_B.cwiseAbs().dot(out.middle_band_B);
    cut.lift_band = std::min(cut.middle_band, cut.max - cut.normal_B.dot(lift));
    cut.land_band = std::min(cut.middle_band, cut.max - cut.normal_B.dot(land));
  }
  return out;
}

void straighten(ActiveSwing& active) {
  active.middle_band_B.setZero();
  for (int side : {0, 1}) {
    active.lift_bands_B[side].setZero();
    active.land_bands_B[side].setZero();
  }
  for (ActiveSwing::Cut& cut : active.cuts) cut.lift_band = cut.land_band = cut.middle_band = 0.0;
}

void put_on_path(const ActiveSwing& active, double since_start, const PlanState& state, const RpyTrig& trig,
                 const Eigen::Matrix3d& r_WB, EndEffectorState& end) {
  add_clearance(active, since_start, end);
  hold_in_reach(active, since_start, state, trig, r_WB, end);
  hold_in_cuts(active, since_start, state, trig, r_WB, end);
}

}  // namespace mcplan
