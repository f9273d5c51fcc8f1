#include "rhp/guess.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace mcplan::rhp {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kStride_m = 0.25, kSpeed = 0.2;  // ahead of the stance foot; of the CoM [m/s]

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
    for (const ContactPoint& point : control.points) {
      const Placement& placement = horizon.placements[point.placement];
      // The least factors, which for the edges of a pyramid may be a little negative on a steep slope.
      const Eigen::Matrix3Xd directions = point.directions_W(placement);
      x.segment(point.variable, point.count()) = directions.transpose() *
                                                 (directions * directions.transpose()).inverse() * weight /
                                                 static_cast<double>(control.points.size());
    }
    for (int psi : control.psi) x.segment<6>(psi).setConstant(0.5 * options.psi_max);
  }
  return x;
}

std::vector<Vector3d> moved_footholds(const Walker& walker, const State& state, const Footsteps& footsteps, int first,
                                      const Memory& memory) {
  std::vector<Vector3d> out;
  const Vector3d way = state.com_W - memory.state.com_W;
  for (std::size_t i = 0; i < memory.footholds_W.size(); ++i) {
    const Footstep step = footsteps[first + static_cast<int>(i)];
    out.push_back(walker.nearest_foothold_W(step.foot, step.surface, memory.footholds_W[i] + way));
  }
  return out;
}

VectorXd remembered_guess(const State& state, const Horizon& horizon, const Memory& memory) {
  VectorXd x = memory.x;
  for (const Placement& placement : horizon.placements) x.segment<2>(placement.variable).setZero();
  const double rise = state.com_W.z() - memory.state.com_W.z();
  for (const Horizon::Node& node : horizon.nodes) x[node.com + 2] += rise;
  return x;
}

}  // namespace mcplan::rhp
