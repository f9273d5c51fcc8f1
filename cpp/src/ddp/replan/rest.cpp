#include "ddp/replan/rest.hpp"

#include <algorithm>
#include <cmath>

#include "ddp/constants.hpp"
#include "ddp/replan/under_feet.hpp"
#include "mcplan/base/rotation.hpp"
#include "mcplan/scene/polygon.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// Ratio of the robot's shortest phase below which phases count as quick. Chosen: durations are exact to rounding.
constexpr double kUsual = 0.99;

/// The state of a plan at an instant, as a knot.
Knot knot_of(const PlanState& state) {
  Knot knot;
  knot.com_W = state.com_W;
  knot.com_velocity_W = state.com_velocity_W;
  knot.base_rpy = state.base_rpy;
  knot.base_rpy_rate = state.base_rpy_rate;
  knot.angular_momentum_W = state.angular_momentum_W;
  for (const EndEffectorState& end : state.end_effectors) {
    knot.end_effectors_W.push_back(end.position_W);
    knot.end_effector_velocities_W.push_back(end.velocity_W);
    knot.end_effector_yaw.push_back(end.yaw);
  }
  return knot;
}

/// Whether any phase of a plan after this one is shorter than the robot's shortest.
bool has_quick_steps(const Plan& plan, int phase) {
  const double usual_s = phase_duration_of(plan.robot, similarity_of(plan.robot, plan.scene.gravity))[0];
  return std::any_of(plan.phases.begin() + phase + 1, plan.phases.end(),
                     [&](const Phase& later) { return later.duration < kUsual * usual_s; });
}

/// Until an end-effector that is late touches the plane below it [s].
double late_s(const Plan& plan, const Knot& now, int e, int surface, const Similarity& similarity) {
  const Polygon polygon(plan.scene.surfaces[surface].vertices_W);
  double descent = kLateDescent * similarity.velocity();
  if (static_cast<int>(now.end_effector_velocities_W.size()) > e)
    descent = std::max(descent, -polygon.normal_W().dot(now.end_effector_velocities_W[e]));
  const double height = std::max(polygon.height(now.end_effectors_W[e]), 0.0);
  return std::clamp(height / descent, kLateMin_s * similarity.time, kLateMax_s * similarity.time);
}

/// Where an end-effector stands elsewhere than planned, it does so until it lifts off. One that stands where it stood
/// before has not lifted off yet.
void stand_elsewhere(Rest& rest, const ContactState& contacts, const std::vector<Past>& before) {
  for (std::size_t e = 0; e < contacts.size(); ++e) {
    const auto stood = [&](const Past& past) { return past.contacts[e] == contacts[e]; };
    if (contacts[e] == kFree || std::any_of(before.begin(), before.end(), stood)) continue;
    int k = 0;
    while (k < rest.size() && rest.surface(k, static_cast<int>(e)) == kFree) ++k;
    const int planned = rest.surface(k, static_cast<int>(e));
    if (planned == kFree || planned == contacts[e]) continue;
    for (; k < rest.size() && rest.surface(k, static_cast<int>(e)) == planned; ++k)
      rest.plan.phases[k].contacts[e].surface = contacts[e];
  }
}

}  // namespace

ContactState Rest::contacts(int k) const {
  ContactState out;
  for (int e = 0; e < plan.end_effector_count(); ++e) out.push_back(surface(k, e));
  return out;
}

void Rest::insert(int k, const ContactState& contacts, double duration_s) {
  Phase phase;
  phase.law = plan.phases.front().law;
  phase.duration = duration_s;
  phase.contacts.assign(contacts.size(), {});
  for (std::size_t e = 0; e < contacts.size(); ++e) phase.contacts[e].surface = contacts[e];
  plan.phases.insert(plan.phases.begin() + k, phase);
  const Knot knot = plan.knots[k];
  plan.knots.insert(plan.knots.begin() + k, knot);
  if (!desired.empty()) {
    const Knot same = desired[k];
    desired.insert(desired.begin() + k, same);
  }
  planned.insert(planned.begin() + k, 0);
  share_weight(k);
}

void Rest::keep_first() {
  plan.phases.resize(1);
  plan.knots.resize(2);
  planned = {0};
  kept = 0;
  desired.clear();
}

void Rest::share_weight(int k) {
  std::vector<Contact>& contacts = plan.phases[k].contacts;
  const auto standing =
      std::count_if(contacts.begin(), contacts.end(), [](const Contact& c) { return c.surface != kFree; });
  for (std::size_t e = 0; e < contacts.size(); ++e) {
    const int surface = contacts[e].surface;
    contacts[e] = Contact();
    contacts[e].surface = surface;
    contacts[e].anchor_W = contacts[e].center_of_pressure_W = plan.knots[k].end_effectors_W[e];
    if (surface != kFree)
      contacts[e].stiffness = plan.scene.gravity / plan.robot.com_height / static_cast<double>(standing);
  }
}

void Rest::carry_hands(const Robot& robot) {
  const Knot start = plan.knots.front();
  const Eigen::Matrix3d from_start = rotation_from_rpy(start.base_rpy).transpose();
  for (int k = 1; k <= size(); ++k) {
    Knot& knot = plan.knots[k];
    const Eigen::Matrix3d turn = rotation_from_rpy(knot.base_rpy) * from_start;
    for (int e = 0; e < static_cast<int>(robot.end_effectors.size()); ++e)
      if (!is_foot(robot, e) && surface(0, e) == kFree && surface(k, e) == kFree)
        knot.end_effectors_W[e] = knot.com_W + turn * (start.end_effectors_W[e] - start.com_W);
  }
}

void Rest::drop(int count) {
  const Knot now = plan.knots.front();
  plan.phases.erase(plan.phases.begin(), plan.phases.begin() + count);
  plan.knots.erase(plan.knots.begin(), plan.knots.begin() + count);
  planned.erase(planned.begin(), planned.begin() + count);
  if (!desired.empty()) desired.erase(desired.begin(), desired.begin() + count);
  plan.knots.front() = now;
}

double swing_duration_of(const Eigen::Vector2d& phase_duration_s) {
  return phase_duration_s[0] + kAddedSwing * (phase_duration_s[1] - phase_duration_s[0]);
}

Rest rest_of(const Plan& previous, double t) {
  const PlanState now = previous.at(t);
  const std::vector<double> times = previous.knot_times();
  Rest rest;
  rest.plan.scene = previous.scene;
  rest.plan.robot = previous.robot;
  rest.plan.planner = previous.planner;
  rest.plan.phases.assign(previous.phases.begin() + now.phase, previous.phases.end());
  rest.plan.knots.assign(previous.knots.begin() + now.phase, previous.knots.end());
  rest.plan.knots.front() = knot_of(now);
  rest.plan.phases.front().duration = std::max(times[now.phase + 1] - t, 0.0);
  rest.plan.final_contacts = previous.final_contacts;
  rest.planned.assign(rest.plan.phases.size(), 1);
  rest.quick = has_quick_steps(previous, now.phase);
  return rest;
}

std::vector<Past> past_of(const Plan& previous, double t) {
  const std::vector<double> times = previous.knot_times();
  std::vector<Past> out;
  for (int k = previous.at(t).phase - 1; k >= 0 && static_cast<int>(out.size()) < kContactsAhead; --k) {
    Past& past = out.emplace_back();
    for (const Contact& contact : previous.phases[k].contacts) past.contacts.push_back(contact.surface);
    past.since_s = t - times[k + 1];
  }
  return out;
}

namespace {

/// States that lead from the contacts that are measured to those of the rest, those measured first: what is missing is
/// made before anything is broken. Empty where something would have to go from surface to surface.
std::vector<ContactState> bridge_to(const ContactState& desired, ContactState now) {
  std::vector<ContactState> out{now};
  for (const bool making : {true, false})
    for (std::size_t e = 0; e < now.size(); ++e) {
      if (now[e] == desired[e]) continue;
      if (now[e] != kFree && desired[e] != kFree) return {};
      if ((desired[e] != kFree) != making) continue;
      now[e] = desired[e];
      if (now != desired) out.push_back(now);
    }
  return out;
}

/// begin_with(), but for the duration of what comes first.
bool find_begin(Rest& rest, const Measured& measured, const ContactState& contacts, const std::vector<Past>& before,
                const Similarity& similarity) {
  const Knot planned = rest.plan.knots.front();
  rest.plan.knots.front() = measured.state;
  stand_elsewhere(rest, contacts, before);
  // Late: what was before is still there.
  const auto late =
      std::find_if(before.begin(), before.end(), [&](const Past& past) { return past.contacts == contacts; });
  // Early: what comes soon is here already.
  double until_s = 0.0;
  for (int k = 0; k < std::min(rest.size(), kContactsAhead + 1); ++k) {
    if (rest.contacts(k) == contacts && (late == before.end() || until_s <= late->since_s)) {
      rest.drop(k);
      return true;
    }
    until_s += rest.plan.phases[k].duration;
  }
  std::vector<ContactState> bridge;
  if (late != before.end()) {
    for (auto past = before.begin(); past <= late; ++past) bridge.insert(bridge.begin(), past->contacts);
  } else {
    bridge = bridge_to(rest.contacts(0), contacts);
  }
  if (bridge.empty()) return false;
  const ContactState desired = rest.contacts(0);
  for (std::size_t i = bridge.size(); i-- > 0;) {
    const ContactState& next = i + 1 < bridge.size() ? bridge[i + 1] : desired;
    double duration_s = kLateMin_s * similarity.time;
    for (std::size_t e = 0; e < next.size(); ++e)
      if (i == 0 && bridge[i][e] == kFree && next[e] != kFree)
        duration_s = late_s(rest.plan, measured.state, static_cast<int>(e), next[e], similarity);
    rest.insert(0, bridge[i], duration_s);
    // The last of what is put in leads to where the plan was to be.
    if (i + 1 == bridge.size()) rest.plan.knots[1] = planned;
  }
  rest.plan.knots.front() = measured.state;
  return true;
}

}  // namespace

bool begin_with(Rest& rest, const Measured& measured, const ContactState& contacts, const std::vector<Past>& before,
                const Similarity& similarity) {
  if (!find_begin(rest, measured, contacts, before, similarity)) return false;
  double& first_s = rest.plan.phases.front().duration;
  first_s = std::max(first_s, kReplanRest_s * similarity.time);
  return true;
}

bool changes_contacts(const Rest& rest) {
  for (int k = 1; k <= rest.size(); ++k)
    if (rest.contacts(k) != rest.contacts(0)) return true;
  return false;
}

void stand_on(Rest& rest, int phases_min, const Similarity& similarity) {
  while (rest.size() < phases_min) {
    rest.insert(rest.size(), rest.plan.final_contacts, kStanding_s * similarity.time);
    rest.planned.back() = 1;
  }
}

}  // namespace mcplan::ddp
