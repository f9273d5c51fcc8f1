#include "ddp/replan/ways_on.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ddp/constants.hpp"
#include "ddp/replan/footsteps.hpp"
#include "ddp/replan/under_feet.hpp"
#include "mcplan/base/rotation.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// Others are looked for with strides shorter by this ratio. A foot in the air lands elsewhere at this speed [m/s]. A
/// plan whose feet end farther than so many heights of the CoM from the goal does not lead there. Chosen. Where a foot
/// in the air lands catches the body, which is on its way there: a height of the CoM farther off is as dear as so many
/// steps.
constexpr double kWayShorter = 0.75, kWayLanding = 0.8, kWayOff = 0.1, kWayElsewhere = 8.0;

std::vector<int> feet_of(const Robot& robot) {
  std::vector<int> out;
  for (int e = 0; e < static_cast<int>(robot.end_effectors.size()); ++e)
    if (is_foot(robot, e)) out.push_back(e);
  return out;
}

double heading(const Knot& knot, int e) {
  return e < static_cast<int>(knot.end_effector_yaw.size()) ? knot.end_effector_yaw[e] : knot.base_rpy.z();
}

/// Where an end-effector lands that is in the air, as planned: the knot.
int landing_of(const Rest& rest, int e) {
  int k = 0;
  while (k < rest.size() && rest.surface(k, e) == kFree) ++k;
  return k;
}

/// From the feet of a rest to the goal; nothing where there are not two of them, both at the goal, and one that stands.
std::optional<Walk> walk_of(const Rest& rest, const Scene& scene, const Robot& robot) {
  const std::vector<int> feet = feet_of(robot);
  if (feet.size() != 2) return std::nullopt;
  const ResolvedStance goal = resolve_stance(scene, robot, scene.goal, "goal");
  const Knot& now = rest.plan.knots.front();
  Walk walk;
  for (int i = 0; i < 2; ++i) {
    const int e = feet[i];
    walk.feet[i] = e;
    walk.from[i] = {rest.surface(0, e), now.end_effectors_W[e], heading(now, e)};
    walk.to[i] = {goal.contacts[e], goal.end_effectors_W[e], goal.yaw};
    if (goal.contacts[e] == kFree) return std::nullopt;
    if (walk.from[i].surface != kFree) continue;
    walk.first = i;
    const int due = landing_of(rest, e);
    for (const Vector3d& place_W : {rest.plan.knots[due].end_effectors_W[e], now.end_effectors_W[e]})
      if (const Found found = ground_at(scene, robot.end_effectors[e], place_W); found.surface != kFree)
        walk.offered.push_back({found.surface, found.place_W, heading(rest.plan.knots[due], e)});
  }
  if (walk.from[0].surface == kFree && walk.from[1].surface == kFree) return std::nullopt;
  return walk;
}

/// The rest made of steps: phases, and knots in which feet stand where they step to and the base is over them.
class RestOfSteps {
 public:
  RestOfSteps(const Rest& rest, const Robot& robot, const Similarity& similarity)
      : from_(&rest), robot_(&robot), box_s_(phase_duration_of(robot, similarity)), similarity_(similarity) {}

  Rest made_of(const std::vector<Footstep>& steps) {
    begin();
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const bool in_the_air = i == 0 && from_->surface(0, steps[i].foot) == kFree;
      if (!in_the_air) {
        ContactState swinging = out_.plan.final_contacts;
        swinging[steps[i].foot] = kFree;
        out_.insert(out_.size(), swinging, swing_duration_of(box_s_));
      } else {
        land_now(steps[i]);
      }
      land(steps[i]);
      out_.insert(out_.size(), out_.plan.final_contacts, box_s_[0]);
    }
    out_.insert(out_.size(), out_.plan.final_contacts, kStanding_s * similarity_.time);
    stand_over_feet();
    out_.desired = out_.plan.knots;
    for (int k = 1; k < out_.size(); ++k) out_.share_weight(k);
    return std::move(out_);
  }

 private:
  /// The phase under way alone.
  void begin() {
    out_ = *from_;
    out_.keep_first();
    out_.plan.final_contacts = from_->contacts(0);
    out_.plan.knots.back() = out_.plan.knots.front();
    for (Vector3d& velocity_W : out_.plan.knots.back().end_effector_velocities_W) velocity_W.setZero();
    if (std::all_of(out_.plan.final_contacts.begin(), out_.plan.final_contacts.end(),
                    [](int surface) { return surface != kFree; }))
      out_.plan.phases.front().duration = std::max(out_.plan.phases.front().duration, box_s_[0]);
  }

  /// A foot in the air lands when it was to, or later where that is farther from where it is.
  void land_now(const Footstep& step) {
    const int due = landing_of(*from_, step.foot);
    const Vector3d now_W = from_->plan.knots.front().end_effectors_W[step.foot];
    const double far_m = (step.onto.place_W - now_W).norm();
    out_.plan.phases.front().duration =
        std::max(from_->plan.knot_times()[due], far_m / (kWayLanding * similarity_.velocity()));
  }

  void land(const Footstep& step) {
    Knot& knot = out_.plan.knots.back();
    knot.end_effectors_W[step.foot] = step.onto.place_W;
    if (!knot.end_effector_yaw.empty()) knot.end_effector_yaw[step.foot] = step.onto.yaw;
    out_.plan.final_contacts[step.foot] = step.onto.surface;
  }

  void stand_over_feet() {
    std::vector<Knot>& knots = out_.plan.knots;
    const std::vector<double> times = out_.plan.knot_times();
    for (int k = 1; k <= out_.size(); ++k) stand_over_feet(knots[k]);
    out_.carry_hands(*robot_);
    for (int k = 1; k <= out_.size(); ++k) {
      Knot& knot = knots[k];
      knot.com_velocity_W.setZero();
      knot.base_rpy_rate.setZero();
      if (k < out_.size()) {
        const double between_s = times[k + 1] - times[k - 1];
        knot.com_velocity_W = (knots[k + 1].com_W - knots[k - 1].com_W) / between_s;
        knot.base_rpy_rate.z() = (knots[k + 1].base_rpy.z() - knots[k - 1].base_rpy.z()) / between_s;
      }
      knot.angular_momentum_W = robot_->inertia.cwiseProduct(knot.base_rpy_rate);
    }
  }

  /// The base where the feet are nominal for it.
  void stand_over_feet(Knot& knot) const {
    const std::vector<int> feet = feet_of(*robot_);
    knot.com_W.setZero();
    double yaw = 0.0;
    for (int e : feet) yaw += heading(knot, e) / static_cast<double>(feet.size());
    knot.base_rpy = {0.0, 0.0, yaw};
    for (int e : feet) {
      const Vector3d nominal_W = rotation_from_rpy(knot.base_rpy) * robot_->end_effectors[e].nominal_B;
      knot.com_W += (knot.end_effectors_W[e] - nominal_W) / static_cast<double>(feet.size());
    }
  }

  const Rest* from_;
  const Robot* robot_;
  Eigen::Vector2d box_s_;
  Similarity similarity_;
  Rest out_;
};

/// As a walk stands, its feet where it goes on from.
ResolvedStance stance_of(const Walk& walk, const Scene& scene, const Robot& robot) {
  ResolvedStance out = resolve_stance(scene, robot, scene.goal, "goal");
  out.com_W = 0.5 * (walk.from[0].place_W + walk.from[1].place_W);
  out.com_W.z() += robot.com_height;
  out.yaw = 0.5 * (walk.from[0].yaw + walk.from[1].yaw);
  return out;
}

bool same_contacts(const Rest& one, const Rest& other) {
  if (one.size() != other.size()) return false;
  for (int k = 0; k <= one.size(); ++k)
    if (one.contacts(k) != other.contacts(k)) return false;
  return true;
}

}  // namespace

bool ends_elsewhere(const Rest& rest, const Scene& scene, const Robot& robot) {
  const ResolvedStance goal = resolve_stance(scene, robot, scene.goal, "goal");
  for (int e : feet_of(robot)) {
    if (goal.contacts[e] == kFree) continue;
    if (rest.plan.final_contacts[e] != goal.contacts[e]) return true;
    const double off_m = (rest.plan.knots.back().end_effectors_W[e] - goal.end_effectors_W[e]).norm();
    if (off_m > kWayOff * robot.com_height) return true;
  }
  return false;
}

std::vector<Rest> ways_on(const Rest& rest, const Scene& scene, const Robot& robot, const Similarity& similarity) {
  std::optional<Walk> walk = walk_of(rest, scene, robot);
  if (!walk) return {};
  const bool in_the_air = walk->from[0].surface == kFree || walk->from[1].surface == kFree;
  const RoundSolids round(scene, robot, stance_of(*walk, scene, robot),
                          resolve_stance(scene, robot, scene.goal, "goal"));
  walk->round = &round;
  std::vector<Rest> out;
  const auto add = [&](const std::vector<Footstep>& steps) {
    if (steps.empty()) return;
    Rest way = RestOfSteps(rest, robot, similarity).made_of(steps);
    if (std::none_of(out.begin(), out.end(), [&](const Rest& other) { return same_contacts(way, other); }))
      out.push_back(std::move(way));
  };
  const auto step = [&](double ratio) {
    std::vector<std::vector<Footstep>> found;
    for (int first = 0; first < (in_the_air ? 1 : 2); ++first) {
      if (!in_the_air) walk->first = first;
      found.push_back(footsteps(*walk, scene, robot, ratio * kCommandStride));
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
    for (const std::vector<Footstep>& steps : found) add(steps);
  };
  const std::vector<Route> routes = round.routes().empty() ? std::vector<Route>{{}} : round.routes();
  walk->elsewhere = in_the_air ? kWayElsewhere : 0.0;
  for (const double ratio : {1.0, kWayShorter})
    for (const Route& route : routes) {
      if (out.size() >= kWaysTried) break;
      walk->route = route;
      step(ratio);
    }
  if (!in_the_air || out.size() >= kWaysTried) return out;
  walk->elsewhere = 0.0;
  walk->route = routes.front();
  step(1.0);
  return out;
}

}  // namespace mcplan::ddp
