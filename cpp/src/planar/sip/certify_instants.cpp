#include <cmath>
#include <limits>

#include "certify_rows.hpp"

namespace mcplan::sip::proof {
namespace {

Amount number(double low, double high) { return {{low, high}, {{{low, high}, {low, high}, {low, high}}}, 0.0}; }

Range difference(const Range& a, const Range& b) { return {a.min - b.max, a.max - b.min}; }
Range magnitude(const Range& a) { return {std::max({0.0, a.min, -a.max}), std::max(std::abs(a.min), std::abs(a.max))}; }

void add_row(std::vector<InstantRow>& out, Kind kind, const std::string& where, int phase, double time_s,
             const Amount& amount) {
  InstantRow row;
  row.row.kind = kind;
  row.row.where = where;
  row.phase = phase;
  row.time_s = time_s;
  row.amount = amount;
  out.push_back(row);
}

/// d_k > 0, where a microsecond counts as nothing.
void add_durations(const PlanarPlan& plan, std::vector<InstantRow>& out) {
  const std::vector<double> knots = plan.knot_times();
  for (std::size_t k = 0; k < plan.durations.size(); ++k) {
    const double missing = 1e-6 - plan.durations[k];
    add_row(out, Kind::phase_duration, "", static_cast<int>(k), knots[k], number(missing, missing));
  }
}

struct Named {
  const Trajectory* trajectory;
  const std::string* name;
};

/// Splines of an interval: the joints', then the base's where it has its own.
std::vector<Named> splines_of(const PlanarPlan& plan, const Trajectories& interval) {
  const auto& bodies = plan.task.robot.bodies;
  std::vector<Named> out;
  for (std::size_t j = 0; j < interval.joints.size(); ++j) out.push_back({&interval.joints[j], &bodies[j + 1].name});
  if (!interval.base_given) return out;
  for (const Trajectory& x : interval.base) out.push_back({&x, &bodies[0].name});
  out.push_back({&interval.bodies[0], &bodies[0].name});
  return out;
}

/// Jumps of q, q' h and q'' h^2 (h: the shorter interval) at the knots, relative to their size where that exceeds one.
void add_continuity(const PlanarPlan& plan, const std::vector<IntervalRows>& intervals, std::vector<InstantRow>& out) {
  for (std::size_t k = 0; k + 1 < intervals.size(); ++k) {
    const Trajectories &left = intervals[k].interval(), &right = intervals[k + 1].interval();
    const double h = std::min(left.length_s, right.length_s);
    const std::vector<Named> before = splines_of(plan, left), after = splines_of(plan, right);
    for (std::size_t j = 0; j < before.size(); ++j) {
      Range jump{0.0, 0.0}, size{1.0, 1.0};
      const auto compare = [&](const UncertainPolynomial& a, const UncertainPolynomial& b, double scale) {
        const Range one = a.at(1.0), step = magnitude(difference(one, b.at(-1.0)));
        jump = {std::max(jump.min, scale * step.min), std::max(jump.max, scale * step.max)};
        size = {std::max(size.min, scale * magnitude(one).min), std::max(size.max, scale * magnitude(one).max)};
      };
      const Trajectory &a = *before[j].trajectory, &b = *after[j].trajectory;
      compare(a.position, b.position, 1.0);
      compare(a.velocity, b.velocity, h);
      compare(a.acceleration, b.acceleration, h * h);
      add_row(out, Kind::continuity, *before[j].name, right.phase, right.begin_s,
              number(jump.min / size.max, jump.max / size.min));
    }
  }
}

/// |q'| h and |q''| h^2 at both ends of the motion.
void add_rest(const PlanarPlan& plan, const std::vector<IntervalRows>& intervals, std::vector<InstantRow>& out) {
  const auto add = [&](const IntervalRows& rows, double s) {
    const Trajectories& interval = rows.interval();
    const double h = interval.length_s;
    for (const Named& spline : splines_of(plan, interval)) {
      const Range rate = magnitude(spline.trajectory->velocity.at(s));
      const Range bend = magnitude(spline.trajectory->acceleration.at(s));
      add_row(out, Kind::rest, *spline.name, interval.phase, rows.time_s(s),
              number(std::max(h * rate.min, h * h * bend.min), std::max(h * rate.max, h * h * bend.max)));
    }
  };
  add(intervals.front(), -1.0);
  add(intervals.back(), 1.0);
}

/// Heights of swinging points at the begin of interval n / 2 of their phase.
void add_middle_heights(const PlanarPlan& plan, const std::vector<PhaseConstants>& constants,
                        const std::vector<IntervalRows>& intervals, int order, std::vector<InstantRow>& out) {
  const PlanarTask& task = plan.task;
  for (std::size_t p = 0; p < task.phases.size(); ++p) {
    const PlanarPhase& phase = task.phases[p];
    const IntervalRows& rows = intervals[task.first_interval(static_cast<int>(p)) + phase.intervals / 2];
    for (const PlanarClearance& clearance : phase.clearances) {
      if (std::isinf(clearance.middle_height)) continue;
      const Trajectories instant = rows.piece(-1.0, 0.0);
      PieceModels models(plan, constants[p], instant, order);
      models.kinematics();
      const PlanarEndEffector& end = task.robot.end_effectors[clearance.end_effector];
      for (std::size_t k = 0; k < end.points.size(); ++k)
        add_row(
            out, Kind::clearance, end.name + " point " + std::to_string(k) + " at mid-swing", static_cast<int>(p),
            rows.time_s(-1.0),
            scaled(
                Amount::of(
                    over_surface(plan, models, clearance.end_effector, clearance.surface, static_cast<int>(k)).height),
                -1.0, clearance.middle_height));
    }
  }
}

/// min <= x, y, angle <= max of a body at an instant; the instant is known to 1e-14 of half an interval.
void add_poses(const PlanarPlan& plan, const std::vector<PhaseConstants>& constants,
               const std::vector<IntervalRows>& intervals, int order, std::vector<InstantRow>& out) {
  constexpr double kInstant = 1e-14;
  const PlanarTask& task = plan.task;
  for (std::size_t p = 0; p < task.phases.size(); ++p) {
    const PlanarPhase& phase = task.phases[p];
    for (const PlanarPose& pose : phase.poses) {
      const double place = pose.fraction * phase.intervals;
      const int i = std::min(static_cast<int>(place), phase.intervals - 1);
      const IntervalRows& rows = intervals[task.first_interval(static_cast<int>(p)) + i];
      const double s = std::clamp(2.0 * (place - i) - 1.0, -1.0 + kInstant, 1.0 - kInstant);
      const Trajectories instant = rows.piece(s, kInstant);
      PieceModels models(plan, constants[p], instant, order);
      models.kinematics();
      const Vector at_W = models.point_W(pose.body, {});
      const Amount values[] = {Amount::of(at_W.x), Amount::of(at_W.y), Amount::of(instant.bodies[pose.body].position)};
      Amount beyond = number(-kInfinity, -kInfinity);
      for (int c = 0; c < 3; ++c) {
        if (!std::isinf(pose.min[c])) beyond = larger(beyond, scaled(values[c], -1.0, pose.min[c]));
        if (!std::isinf(pose.max[c])) beyond = larger(beyond, scaled(values[c], 1.0, -pose.max[c]));
      }
      if (std::isinf(beyond.upper()) && beyond.upper() < 0.0) continue;
      add_row(out, Kind::pose, task.robot.bodies[pose.body].name, static_cast<int>(p), rows.time_s(s), beyond);
    }
  }
}

}  // namespace

std::vector<InstantRow> instant_rows(const PlanarPlan& plan, const std::vector<PhaseConstants>& constants,
                                     const std::vector<IntervalRows>& intervals, int order) {
  std::vector<InstantRow> out;
  add_durations(plan, out);
  add_continuity(plan, intervals, out);
  add_rest(plan, intervals, out);
  add_middle_heights(plan, constants, intervals, order, out);
  add_poses(plan, constants, intervals, order, out);
  return out;
}

}  // namespace mcplan::sip::proof
