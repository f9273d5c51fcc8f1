#include "ddp/replan/given.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "ddp/constants.hpp"
#include "ddp/headings.hpp"
#include "ddp/reachable_surfaces.hpp"
#include "ddp/replan_fit.hpp"
#include "mcplan/base/error.hpp"
#include "mcplan/robot/similarity.hpp"
#include "mcplan/scene/polygon.hpp"

namespace mcplan::ddp {

using Eigen::Vector3d;

namespace {

constexpr double kTurn = 2.0 * M_PI;

/// The same heading, counted as `near` is; what no heading is stays as it is.
double counted_as(double near, double yaw) {
  return std::abs(yaw - near) < kTurnsMax * kTurn ? yaw + kTurn * std::round((near - yaw) / kTurn) : yaw;
}

}  // namespace

Measured completed(const Measured& measured, const Plan& previous, double t, const Scene& scene, const Robot& robot) {
  Measured out = measured;
  const PlanState planned = previous.at(t);
  const std::size_t count = robot.end_effectors.size();
  Knot& state = out.state;
  if (out.contacts.empty())
    for (const EndEffectorState& end : planned.end_effectors) out.contacts.push_back(end.surface);
  // Estimators wrap headings around, and plans count turns.
  state.base_rpy.z() = counted_as(planned.base_rpy.z(), state.base_rpy.z());
  for (double& yaw : state.end_effector_yaw) yaw = counted_as(state.base_rpy.z(), yaw);
  if (state.end_effector_yaw.empty()) state.end_effector_yaw.assign(count, state.base_rpy.z());
  if (state.end_effector_velocities_W.empty())
    for (const EndEffectorState& end : planned.end_effectors) state.end_effector_velocities_W.push_back(end.velocity_W);
  const double off_max = kStandsOff_m * similarity_of(robot, scene.gravity).length;
  for (std::size_t e = 0; e < count; ++e) {
    int& contact = out.contacts[e];
    if (contact == kFree) continue;
    const std::string& name = previous.scene.surfaces[contact].name;
    contact = scene.surface_index(name);
    if (contact < 0)
      throw InvalidScene("surfaces", "must have those that the robot stands on", "none of the name " + name);
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

void count_turns_as(double yaw, Rest& rest, Measured& measured) {
  const double desired = std::abs(yaw) <= kHeadingMax ? yaw : std::remainder(yaw, kTurn);
  const double further = kTurn * std::round((desired - measured.state.base_rpy.z()) / kTurn);
  if (further == 0.0) return;
  const auto turn = [further](Knot& knot) {
    knot.base_rpy.z() += further;
    for (double& sole : knot.end_effector_yaw) sole += further;
  };
  for (Knot& knot : rest.plan.knots) turn(knot);
  turn(measured.state);
}

void require_contacts(const std::vector<int>& contacts, const Plan& previous) {
  if (contacts.empty()) return;
  const int surfaces = static_cast<int>(previous.scene.surfaces.size());
  if (static_cast<int>(contacts.size()) != previous.end_effector_count())
    throw InvalidPlan("measured.contacts", "must be one per end-effector (" + text(previous.end_effector_count()) + ")",
                      text(static_cast<int>(contacts.size())));
  for (std::size_t e = 0; e < contacts.size(); ++e)
    if (contacts[e] < kFree || contacts[e] >= surfaces)
      throw InvalidPlan("measured.contacts[" + std::to_string(e) + "]",
                        "must be -1 or the index of a surface (below " + text(surfaces) + ")", text(contacts[e]));
}

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

std::optional<Scene> with_goal_counted(const Scene& scene, const Plan& previous) {
  const double yaw = turning_least(previous.knots.back().base_rpy.z(), scene.goal.yaw);
  if (yaw == scene.goal.yaw || !(std::abs(yaw) <= kTurn)) return std::nullopt;
  Scene counted = scene;
  counted.goal.yaw = yaw;
  return counted;
}

void rename(Rest& rest, const Scene& scene) {
  const auto renamed = [&](int surface) {
    if (surface == kFree) return kFree;
    const std::string& name = rest.plan.scene.surfaces[surface].name;
    const int here = scene.surface_index(name);
    if (here < 0) throw InvalidScene("surfaces", "must have those of the plan", "none of the name " + name);
    return here;
  };
  for (Phase& phase : rest.plan.phases)
    for (Contact& contact : phase.contacts) contact.surface = renamed(contact.surface);
  for (int& surface : rest.plan.final_contacts) surface = renamed(surface);
  rest.plan.scene = scene;
}

}  // namespace mcplan::ddp
