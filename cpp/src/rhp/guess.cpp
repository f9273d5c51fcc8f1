#include "rhp/guess.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace mcplan::rhp {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

using Eigen::Matrix3d;

constexpr double kStride_m = 0.25, kSpeed = 0.2;  // ahead of the stance foot; of the CoM [m/s]

/// The variables with the least squares that make a force [kForceUnit]: for the edges of a pyramid they may be a little
/// negative on a steep slope.
void set_force(const ContactPoint& point, const Placement& placement, const Vector3d& force_W, VectorXd& x) {
  const Eigen::Matrix3Xd directions = point.directions_W(placement);
  x.segment(point.variable, point.count()) =
      directions.transpose() * (directions * directions.transpose()).inverse() * force_W;
}

/// Exchanges left and right of the heading, or nothing.
Matrix3d turn(const Walker& walker, bool mirrored) {
  const Vector3d left = walker.r_WH.col(1);
  Matrix3d out = Matrix3d::Identity();
  if (mirrored) out -= 2.0 * left * left.transpose();
  return out;
}

/// Where the mirror image of a control's point i is among its points, foot by foot: corners alternate in their side.
int mirror_image(const Horizon::Control& control, int i) {
  const int count = static_cast<int>(control.points.size());
  const bool both = control.points.front().placement != control.points.back().placement;
  const int per_foot = both ? count / 2 : count;
  const int first = both && i < per_foot ? per_foot : 0, within = i % per_foot;
  return first + (per_foot > 1 ? within ^ 1 : within);
}

/// The CoM, and its velocity, rise as the middle of the feet does: more or less than in the memory.
void follow_feet(const State& state, const Horizon& horizon, const Memory& memory, bool mirrored, VectorXd& x) {
  const int per_step = static_cast<int>(horizon.nodes.size() - 1) / horizon.steps;
  const double rise = state.com_W.z() - memory.state.com_W.z();
  std::vector<Vector3d> feet = state.feet_W, feet_then = memory.state.feet_W;
  x[horizon.nodes[0].com + 2] += rise;
  double lift = 0.0;
  for (int i = 0; i < horizon.steps; ++i) {
    const int foot = horizon.placements[2 + i].foot;
    feet[foot] = horizon.position_W(x, 2 + i);
    feet_then[mirrored ? 1 - foot : foot] = memory.footholds_W[i];
    const double next = 0.5 * (feet[0] + feet[1] - feet_then[0] - feet_then[1]).z() - rise;
    double duration = 0.0;
    for (int kind = 0; kind < 3; ++kind) duration += x[horizon.phases[3 * i + kind].duration];
    for (int k = 1; k <= per_step; ++k) {
      const Horizon::Node& node = horizon.nodes[i * per_step + k];
      x[node.com + 2] += rise + lift + (next - lift) * k / per_step;
      x[node.velocity + 2] += (next - lift) / duration;
    }
    lift = next;
  }
}

}  // namespace

std::vector<Vector3d> nominal_footholds(const Walker& walker, const State& state, const Footsteps& footsteps, int first,
                                        int steps) {
  const Vector3d forward = walker.r_WH.col(0), left = walker.r_WH.col(1);
  std::vector<Vector3d> feet = state.feet_W, out;
  for (int i = 0; i < steps; ++i) {
    const Footstep step = footsteps[first + i];
    const Vector3d &stance = feet[1 - step.foot], &own = feet[step.foot];
    const Vector3d desired = stance + kStride_m * forward + left * left.dot(own - stance);
    feet[step.foot] = walker.nearest_foothold_W(step.foot, step.surface, desired);
    out.push_back(feet[step.foot]);
  }
  return out;
}

VectorXd nominal_guess(const Walker& walker, const State& state, const Horizon& horizon) {
  const nlp::Problem& problem = horizon.problem;
  VectorXd x = VectorXd::Zero(problem.variable_count());
  const Options& options = walker.options;
  const auto feet_centre = [&](const std::array<int, 2>& placements) -> Vector3d {
    return 0.5 * (horizon.position_W(x, placements[0]) + horizon.position_W(x, placements[1]));
  };
  Vector3d from = state.com_W, feet_before = feet_centre(horizon.phases.front().placements);
  const int per_step = 3 * options.intervals;
  for (int i = 0; i < horizon.steps; ++i) {
    const Vector3d feet_after = feet_centre(horizon.phases[3 * i + 2].placements);
    const Vector3d to = from + feet_after - feet_before;
    for (int k = 0; k <= per_step; ++k) {
      const Horizon::Node& node = horizon.nodes[i * per_step + k];
      x.segment<3>(node.com) = from + (to - from) * k / per_step - horizon.shift_W;
      x.segment<3>(node.velocity) = kSpeed * walker.r_WH.col(0);
    }
    from = to;
    feet_before = feet_after;
  }
  for (const Horizon::Phase& phase : horizon.phases)
    x[phase.duration] = 0.5 * (problem.variable_lower()[phase.duration] + problem.variable_upper()[phase.duration]);
  const Vector3d weight(0.0, 0.0, walker.robot.mass * walker.scene.gravity / kForceUnit);
  for (const Horizon::Control& control : horizon.controls) {
    for (const ContactPoint& point : control.points)
      set_force(point, horizon.placements[point.placement], weight / static_cast<double>(control.points.size()), x);
    for (int psi : control.psi) x.segment<6>(psi).setConstant(0.5 * options.psi_max);
  }
  return x;
}

Memory memory_of(const State& state, const Horizon& horizon, const VectorXd& x) {
  Memory memory;
  memory.state = state;
  memory.x = x;
  for (int i = 0; i < horizon.steps; ++i) memory.footholds_W.push_back(horizon.position_W(x, 2 + i));
  for (const Horizon::Control& control : horizon.controls) {
    Eigen::Matrix3Xd& forces_W = memory.forces_W.emplace_back(3, control.points.size());
    for (int i = 0; i < forces_W.cols(); ++i)
      forces_W.col(i) = control.points[i].force_W(horizon.placements[control.points[i].placement], x);
  }
  memory.swing = horizon.placements[2].foot;
  return memory;
}

std::vector<Vector3d> moved_footholds(const Walker& walker, const State& state, const Footsteps& footsteps, int first,
                                      const Memory& memory) {
  std::vector<Vector3d> out;
  const Matrix3d r_WM = turn(walker, memory.swing != footsteps[first].foot);
  for (std::size_t i = 0; i < memory.footholds_W.size(); ++i) {
    const Footstep step = footsteps[first + static_cast<int>(i)];
    const Vector3d desired_W = state.com_W + r_WM * (memory.footholds_W[i] - memory.state.com_W);
    out.push_back(walker.nearest_foothold_W(step.foot, step.surface, desired_W));
  }
  return out;
}

VectorXd remembered_guess(const Walker& walker, const State& state, const Horizon& horizon, const Memory& memory) {
  VectorXd x = memory.x;
  const bool mirrored = memory.swing != horizon.placements[2].foot;
  const Matrix3d r_WM = turn(walker, mirrored);
  const auto take = [&](int vector) {
    if (vector >= 0) x.segment<3>(vector) = r_WM * x.segment<3>(vector).eval();
  };
  const auto take_axial = [&](int vector) {  // turns about an axis, which a mirror reverses
    if (vector >= 0) x.segment<3>(vector) = r_WM.determinant() * r_WM * x.segment<3>(vector).eval();
  };
  for (const Placement& placement : horizon.placements) x.segment<2>(placement.variable).setZero();
  for (const Horizon::Node& node : horizon.nodes) {
    take(node.com);
    take(node.velocity);
    take_axial(node.momentum);
  }
  follow_feet(state, horizon, memory, mirrored, x);
  for (std::size_t k = 0; k < horizon.controls.size(); ++k) {
    const Horizon::Control& control = horizon.controls[k];
    take(control.acceleration);
    take_axial(control.rate);
    for (int i = 0; i < static_cast<int>(control.points.size()); ++i) {
      const ContactPoint& point = control.points[i];
      const Vector3d force_W = memory.forces_W[k].col(mirrored ? mirror_image(control, i) : i);
      set_force(point, horizon.placements[point.placement], r_WM * force_W / kForceUnit, x);
    }
  }
  return x;
}

}  // namespace mcplan::rhp
