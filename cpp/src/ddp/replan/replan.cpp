#include "mcplan/ddp/replan.hpp"

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>

#include "ddp/best_plan.hpp"
#include "ddp/constants.hpp"
#include "ddp/reachable_surfaces.hpp"
#include "ddp/replan/trial.hpp"
#include "ddp/replan_fit.hpp"
#include "mcplan/base/error.hpp"
#include "mcplan/plan/friction_use.hpp"
#include "mcplan/version.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// The measured state with what it leaves out, by the contacts that are given or else planned; what stands is put onto
/// its plane, since a contact knows more than a measurement of its place.
Measured completed(const Measured& measured, const Plan& previous, double t, const Scene& scene, const Robot& robot) {
  Measured out = measured;
  const PlanState planned = previous.at(t);
  const std::size_t count = robot.end_effectors.size();
  Knot& state = out.state;
  if (out.contacts.empty())
    for (const EndEffectorState& end : planned.end_effectors) out.contacts.push_back(end.surface);
  if (state.end_effector_yaw.empty()) state.end_effector_yaw.assign(count, state.base_rpy.z());
  if (state.end_effector_velocities_W.empty())
    for (const EndEffectorState& end : planned.end_effectors) state.end_effector_velocities_W.push_back(end.velocity_W);
  const double off_max = kStandsOff_m * similarity_of(robot, scene.gravity).length;
  for (std::size_t e = 0; e < count; ++e) {
    int& contact = out.contacts[e];
    if (contact == kFree) continue;
    contact = scene.surface_index(previous.scene.surfaces[contact].name);
    const Polygon polygon(scene.surfaces[contact].vertices_W);
    Vector3d& place = state.end_effectors_W[e];
    const double height = polygon.height(place), off = std::max(std::abs(height), polygon.outside(place));
    if (!(off <= off_max))
      throw InvalidPlan("measured.end_effectors_W[" + std::to_string(e) + "]",
                        "must lie within " + text(off_max) + " m of the surface " + scene.surfaces[contact].name +
                            ", on which the end-effector stands",
                        text(place));
    place -= height * polygon.normal_W();
    state.end_effector_velocities_W[e].setZero();
  }
  return out;
}

void require_contacts(const std::vector<int>& contacts, const Plan& previous) {
  const int surfaces = static_cast<int>(previous.scene.surfaces.size());
  if (contacts.empty()) return;
  if (static_cast<int>(contacts.size()) != previous.end_effector_count())
    throw InvalidPlan("measured.contacts", "must be one per end-effector (" + text(previous.end_effector_count()) + ")",
                      text(static_cast<int>(contacts.size())));
  for (std::size_t e = 0; e < contacts.size(); ++e)
    if (contacts[e] < kFree || contacts[e] >= surfaces)
      throw InvalidPlan("measured.contacts[" + std::to_string(e) + "]",
                        "must be -1 or the index of a surface (below " + text(surfaces) + ")", text(contacts[e]));
}

/// Surfaces that matter: those of the plan, of the robot's feet, and those near the way to the goal.
std::vector<int> surfaces_of(const Scene& scene, const Robot& robot, const Measured& measured, const Rest& rest) {
  std::set<int> needed;
  for (const Stance* stance : {&scene.start, &scene.goal})
    for (const auto& [who, surface] : stance->contacts) needed.insert(scene.surface_index(surface));
  for (int k = 0; k <= rest.size(); ++k)
    for (int surface : rest.contacts(k))
      if (surface != kFree) needed.insert(scene.surface_index(rest.plan.scene.surfaces[surface].name));
  for (int surface : measured.contacts)
    if (surface != kFree) needed.insert(surface);
  needed.erase(-1);
  const ResolvedStance goal = resolve_stance(scene, robot, scene.goal, "goal");
  return surfaces_near_way(scene, measured.state.end_effectors_W, goal.end_effectors_W,
                           outlook(0).reach * reach_of(robot), needed);
}

Status status_of(const Trial& trial, Ending ending) {
  if (trial.ok()) return Status::solved;
  if (ending == Ending::time_limit) return Status::time_limit;
  if (ending == Ending::interrupted) return Status::interrupted;
  if (ending == Ending::iteration_limit) return Status::iteration_limit;
  return violation_ratio(trial.check.worst()) <= kAcceptable ? Status::acceptable : Status::infeasible;
}

}  // namespace

PlanResult replan(const Plan& previous, double t, const Measured& given, const Scene& scene_in, const Robot& robot_in,
                  const ReplanOptions& options) {
  const Deadline deadline(options.search.time_limit_s, options.search.clock);
  options.validate();
  previous.validate();
  scene_in.validate();
  robot_in.validate();
  const Robot robot = robot_for(robot_in, options.search);
  require_fit(previous, given.state, robot);
  require_contacts(given.contacts, previous);
  Report report;
  report.seed = options.search.seed;
  report.threads = options.search.threads;
  report.version = MCPLAN_VERSION;
  Now now{&scene_in, &robot, &options, &deadline, {}, {}, similarity_of(robot, scene_in.gravity)};
  now.measured = completed(given, previous, t, scene_in, robot);
  Rest rest = rest_of(previous, t);
  // Contacts of the rest are named by the plan's scene, those measured by the present one.
  if (!begin_with(rest, now.measured, now.measured.contacts, past_of(previous, t), now.similarity)) {
    report.status = Status::no_sequence;
    report.message = "no single changes of contacts lead from those measured to those planned";
    return {Plan(), std::move(report)};
  }
  stand_on(rest, options.phases_min, now.similarity);
  now.surfaces = surfaces_of(scene_in, robot, now.measured, rest);
  std::optional<Trial> best = try_out(now, rest, report);
  PlanResult out;
  if (best) {
    report.status = status_of(*best, best->ending);
    report.worst_violation = best->check.worst();
    report.warnings = best->check.warnings;
    report.cost = best->evaluation.cost;
    out.plan = std::move(best->plan);
  } else {
    report.status = Status::no_sequence;
  }
  report.time_s = deadline.elapsed_s();
  out.report = std::move(report);
  return out;
}

PlanResult replan(const Plan& previous, double t, const Measured& measured, const ReplanOptions& options) {
  return replan(previous, t, measured, previous.scene, previous.robot, options);
}

void ReplanOptions::validate() const { search.validate(); }

}  // namespace mcplan::ddp
