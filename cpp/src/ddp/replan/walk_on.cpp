#include "ddp/replan/walk_on.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ddp/constants.hpp"
#include "ddp/crawl.hpp"
#include "ddp/replan/given.hpp"
#include "ddp/replan/under_feet.hpp"
#include "mcplan/base/rotation.hpp"
#include "mcplan/robot/similarity.hpp"
#include "mcplan/scene/polygon.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// How far the base of a robot on points turns to either side as it walks [rad]. Chosen.
constexpr double kSways = 0.35;

/// Level pose of the base: where its CoM is above, and its heading.
struct Pose {
  Vector2d position = Vector2d::Zero();
  double yaw = 0.0;
};

/// The way that a command leads: at constant velocity and rate of turning, then slower and slower until it stops at the
/// end.
class Way {
 public:
  Way(const Pose& at, double at_s, const VelocityCommand& command, double scale, double end_s, double stop_s)
      : from_(at),
        at_s_(at_s),
        velocity_(scale * command.velocity_B),
        yaw_rate_(scale * command.yaw_rate),
        end_s_(end_s),
        stop_s_(std::max(stop_s, 1e-9)) {}

  /// The arc of yaw psi(s) = yaw_rate s along the way, whose position is the integral of R(psi) v.
  Pose at(double t) const {
    const double s = progress(t), angle = yaw_rate_ * s;
    // sinc-like factors of the integral over a circle's arc.
    const double ratio = std::abs(angle) < 1e-6 ? s : std::sin(angle) / yaw_rate_;
    const double aside = std::abs(angle) < 1e-6 ? 0.5 * angle * s : (1.0 - std::cos(angle)) / yaw_rate_;
    const Vector2d moved(ratio * velocity_.x() - aside * velocity_.y(), aside * velocity_.x() + ratio * velocity_.y());
    return {from_.position + turned(moved, from_.yaw), from_.yaw + angle};
  }
  double rate(double t) const { return std::clamp((end_s_ - t) / stop_s_, 0.0, 1.0); }
  Vector2d velocity(double t) const { return rate(t) * turned(velocity_, at(t).yaw); }
  double yaw_rate(double t) const { return rate(t) * yaw_rate_; }

 private:
  /// Time for which the command would have been followed in full.
  double progress(double t) const {
    const auto until = [&](double at) {
      const double slow = std::max(at - (end_s_ - stop_s_), 0.0);
      return at - 0.5 * slow * slow / stop_s_;
    };
    return until(std::min(t, end_s_)) - until(at_s_);
  }

  Pose from_;
  double at_s_;
  Vector2d velocity_;
  double yaw_rate_, end_s_, stop_s_;
};

/// Knots' times from the start of the rest [s].
std::vector<double> times_of(const Rest& rest) { return rest.plan.knot_times(); }

/// What is planned beyond the horizon goes, back to a phase in which all stands that stands at the end.
void cut_off(Rest& rest, int phases) {
  const ContactState last = rest.contacts(rest.size());
  const auto stands = [&](int k) {
    for (int e = 0; e < static_cast<int>(last.size()); ++e)
      if ((last[e] == kFree) != (rest.surface(k, e) == kFree)) return false;
    return true;
  };
  int size = std::min(rest.size(), phases);
  while (size > 1 && !stands(size - 1)) --size;
  if (size == rest.size() || !stands(size - 1)) return;
  rest.plan.final_contacts = rest.contacts(size - 1);
  rest.plan.phases.resize(size);
  rest.plan.knots.resize(size + 1);
  rest.planned.resize(size);
}

/// Phases at the end in which the robot only stands go, but for one.
void stop_standing(Rest& rest) {
  const auto stands = [&](int k) { return rest.contacts(k) == rest.contacts(rest.size()); };
  while (rest.size() > 1 && stands(rest.size() - 1) && stands(rest.size() - 2)) {
    rest.plan.phases.pop_back();
    rest.plan.knots.erase(rest.plan.knots.end() - 2);
    rest.planned.pop_back();
  }
}

/// The pose that the feet are nominal for, those in the air where they are about to land, and when that will be.
std::pair<Pose, double> pose_of(const Rest& rest, const Robot& robot) {
  const std::vector<double> times = times_of(rest);
  Pose pose;
  double at_s = 0.5 * rest.plan.phases.front().duration, sine = 0.0, cosine = 0.0;
  int feet = 0;
  for (int e = 0; e < static_cast<int>(robot.end_effectors.size()); ++e) {
    if (!is_foot(robot, e)) continue;
    int k = 0;
    while (k < rest.size() && rest.surface(k, e) == kFree) ++k;
    if (rest.surface(k, e) == kFree) continue;
    if (k > 0) at_s = std::max(at_s, times[k] + (k < rest.size() ? 0.5 * rest.plan.phases[k].duration : 0.0));
    const Knot& knot = rest.plan.knots[k];
    // The sole's heading: the base's sways.
    const bool headed = e < static_cast<int>(knot.end_effector_yaw.size());
    const double yaw = headed ? knot.end_effector_yaw[e] : knot.base_rpy.z();
    sine += std::sin(yaw);
    cosine += std::cos(yaw);
    pose.position += knot.end_effectors_W[e].head<2>() - turned(robot.end_effectors[e].nominal_B.head<2>(), yaw);
    ++feet;
  }
  if (feet == 0) return {{rest.plan.knots.front().com_W.head<2>(), rest.plan.knots.front().base_rpy.z()}, 0.0};
  pose.position /= feet;
  pose.yaw = rest.plan.knots.front().base_rpy.z();
  pose.yaw += std::remainder(std::atan2(sine, cosine) - pose.yaw, 2.0 * M_PI);  // counts the turns that the base counts
  return {pose, at_s};
}

/// Feet in the order in which they stepped last, the one whose turn is next first, and when that was: the phase of the
/// rest, -1 where it was before.
struct Turns {
  std::vector<int> feet, phase;
};

Turns turns_so_far(const Rest& rest, const Robot& robot) {
  std::vector<std::pair<int, int>> found;
  for (int e = 0; e < static_cast<int>(robot.end_effectors.size()); ++e) {
    if (!is_foot(robot, e) || rest.plan.final_contacts[e] == kFree) continue;
    int k = rest.size() - 1;
    while (k >= 0 && rest.surface(k, e) != kFree) --k;
    found.emplace_back(k, e);
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  Turns out;
  for (const auto& [k, e] : found) {
    out.phase.push_back(k);
    out.feet.push_back(e);
  }
  return out;
}

/// Of more than two feet what is left of a plan does not tell whose turn is next, since some have stepped before: they
/// go on as in a crawl, and where none steps any more the one begins that lags most.
std::vector<int> turns_of(const Rest& rest, const Robot& robot, const Pose& pose, const VelocityCommand& command) {
  Turns turns = turns_so_far(rest, robot);
  if (turns.feet.size() <= 2 || turns.phase.front() >= 0) return turns.feet;
  const double speed = command.velocity_B.norm();
  const Vector2d ahead_B = speed > 0.0 ? Vector2d(command.velocity_B / speed) : Vector2d(1.0, 0.0);
  const auto nominal_B = [&](int e) { return Vector2d(robot.end_effectors[e].nominal_B.head<2>()); };
  const auto lag = [&](int e) {
    const Vector2d off = rest.plan.knots.back().end_effectors_W[e].head<2>() - pose.position;
    return ahead_B.dot(nominal_B(e) - turned(off, -pose.yaw));
  };
  const bool steps = turns.phase.back() >= 0;
  const int latest = turns.feet.back();
  std::vector<int> order = std::move(turns.feet);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return crawl_turn(ahead_B, nominal_B(a)) < crawl_turn(ahead_B, nominal_B(b)); });
  const auto first = steps
                         ? std::find(order.begin(), order.end(), latest) + 1
                         : std::max_element(order.begin(), order.end(), [&](int a, int b) { return lag(a) < lag(b); });
  std::rotate(order.begin(), first, order.end());
  return order;
}

void add_steps(Rest& rest, const Robot& robot, const VelocityCommand& command, int phases,
               const Similarity& similarity) {
  const std::vector<int> turns = turns_of(rest, robot, pose_of(rest, robot).first, command);
  const Vector2d box_s = phase_duration_of(robot, similarity);
  const double swing_s = swing_duration_of(box_s), stand_s = box_s[0];
  for (int i = 0; !turns.empty() && rest.size() + 2 <= phases; ++i) {
    ContactState swinging = rest.contacts(rest.size());
    swinging[turns[i % turns.size()]] = kFree;
    rest.insert(rest.size(), swinging, swing_s);
    rest.insert(rest.size(), rest.contacts(rest.size()), stand_s);
  }
}

/// Where a foot is due under a pose, at the height of the ground below.
Vector3d due(const Robot& robot, int e, const Pose& pose, double ground) {
  const Vector2d place = pose.position + turned(robot.end_effectors[e].nominal_B.head<2>(), pose.yaw);
  return {place.x(), place.y(), ground};
}

/// What lies under way gets the command's motion as what is desired, and surfaces where that has the feet.
class Follow {
 public:
  Follow(Rest& rest, const Scene& scene, const Robot& robot, const Way& way)
      : rest_(&rest), scene_(&scene), robot_(&robot), way_(&way), times_(times_of(rest)) {}

  void run() {
    rest_->desired = rest_->plan.knots;
    rest_->kept = 0;
    for (int e = 0; e < static_cast<int>(robot_->end_effectors.size()); ++e)
      if (is_foot(*robot_, e)) place(e);
    for (int k = 1; k <= rest_->size(); ++k) move(k);
    for (int k = 0; k < rest_->size(); ++k)
      if (!rest_->planned[k]) rest_->share_weight(k);
  }

 private:
  /// Contacts of a foot after the one under way, each in the middle of its stance under the base.
  void place(int e) {
    int k = 0;
    double ground = 0.0;
    while (k < rest_->size() && rest_->surface(k, e) == kFree) ++k;  // the swing under way stays
    rest_->kept = std::max(rest_->kept, k);
    while (k < rest_->size() && rest_->surface(k, e) != kFree) ++k;
    ground = rest_->plan.knots[std::max(k - 1, 0)].end_effectors_W[e].z();
    while (k < rest_->size()) {
      while (k < rest_->size() && rest_->surface(k, e) == kFree) ++k;
      int end = k;
      while (end < rest_->size() && rest_->surface(end, e) != kFree) ++end;
      const bool last = end == rest_->size();
      const Pose pose = way_->at(last ? times_.back() : 0.5 * (times_[k] + times_[end]));
      const Found found = ground_at(*scene_, robot_->end_effectors[e], due(*robot_, e, pose, ground));
      if (found.surface == kFree) return;
      ground = found.place_W.z();
      for (int j = k; j < end; ++j) rest_->plan.phases[j].contacts[e].surface = found.surface;
      if (last) rest_->plan.final_contacts[e] = found.surface;
      for (int j = k; j <= std::min(end, rest_->size()); ++j) {
        rest_->desired[j].end_effectors_W[e] = found.place_W;
        // What has just been added begins there; what was planned is where the motion begins.
        if (!rest_->planned[std::min(k, rest_->size() - 1)]) rest_->plan.knots[j].end_effectors_W[e] = found.place_W;
      }
      k = end;
    }
  }

  /// The base at a knot.
  void move(int k) {
    const Pose pose = way_->at(times_[k]);
    double ground = 0.0;
    int feet = 0;
    Knot& knot = rest_->desired[k];
    for (int e = 0; e < static_cast<int>(robot_->end_effectors.size()); ++e) {
      if (!is_foot(*robot_, e) || rest_->surface(std::min(k, rest_->size()), e) == kFree) continue;
      ground += knot.end_effectors_W[e].z();
      ++feet;
    }
    const Vector2d velocity = way_->velocity(times_[k]);
    knot.com_W.head<2>() = pose.position;
    if (feet > 0) knot.com_W.z() = ground / feet + robot_->com_height;
    knot.com_velocity_W = {velocity.x(), velocity.y(), 0.0};
    knot.base_rpy.z() = pose.yaw;
    knot.base_rpy_rate = {0.0, 0.0, way_->yaw_rate(times_[k])};
    knot.angular_momentum_W = robot_->inertia.cwiseProduct(knot.base_rpy_rate);
    const bool added = k == rest_->size() ? !rest_->planned.back() : !rest_->planned[k];
    if (!added) return;
    Knot& start = rest_->plan.knots[k];
    const std::vector<Vector3d> ends = start.end_effectors_W;
    start = knot;
    start.end_effectors_W = ends;
  }

  Rest* rest_;
  const Scene* scene_;
  const Robot* robot_;
  const Way* way_;
  std::vector<double> times_;
};

/// The heading at at_s [rad], at a rate of turning [rad/s]. Soles that land by then have it; of a robot on points there
/// is but the base's, which sways: where the command does not turn it is that in which the plan before ends, where the
/// two differ by no more than that.
double heading_at(const Rest& rest, const Robot& robot, const Pose& pose, double at_s, double yaw_rate) {
  for (int e = 0; e < static_cast<int>(robot.end_effectors.size()); ++e)
    if (is_foot(robot, e) && robot.end_effectors[e].half_size.minCoeff() > 0.0) return pose.yaw;
  const double now = rest.plan.knots.front().base_rpy.z();
  const double off = std::remainder(rest.plan.scene.goal.yaw - now, 2.0 * M_PI);
  if (yaw_rate == 0.0) return std::abs(off) < kSways ? now + off : now;
  return now + yaw_rate * at_s;
}

/// The ratio of the command at which no foot is asked for strides that are longer than its reach box; a step that is
/// aslant, or turns, is as long as the ellipsoid in that box allows.
double ratio_of_strides(const Robot& robot, const VelocityCommand& command, const Similarity& similarity) {
  const Vector2d box_s = phase_duration_of(robot, similarity);
  double ratio = 1.0;
  int feet = 0;
  for (const EndEffector& end : robot.end_effectors) feet += end.kind == "foot";
  const double between_s = feet * (swing_duration_of(box_s) + box_s[0]);
  const double part = feet > 2 ? kCrawlStride : kCommandStride;
  for (const EndEffector& end : robot.end_effectors) {
    if (end.kind != "foot") continue;
    const Vector2d turning = command.yaw_rate * Vector2d(-end.nominal_B.y(), end.nominal_B.x());
    const Vector2d stride = between_s * (command.velocity_B + turning);
    const Vector2d stride_max = part * end.usual_box().sizes().head<2>();
    const double length = stride.cwiseQuotient(stride_max).norm();
    if (length > 1.0) ratio = std::min(ratio, 1.0 / length);
  }
  return ratio;
}

/// Whether every foot that stands at the end of the rest finds ground where it is due in a pose there.
bool finds_ground(const Rest& rest, const Scene& scene, const Robot& robot, const Pose& pose) {
  for (int e = 0; e < static_cast<int>(robot.end_effectors.size()); ++e) {
    if (rest.plan.final_contacts[e] == kFree || !is_foot(robot, e)) continue;
    const Vector3d desired = due(robot, e, pose, rest.plan.knots.back().end_effectors_W[e].z());
    if (!(ground_at(scene, robot.end_effectors[e], desired).distance <= kCommandOff * robot.com_height)) return false;
  }
  return true;
}

/// The stance at the end of the rest.
Stance stance_of(const Rest& rest, const Scene& scene, const Robot& robot, const Pose& pose) {
  Stance stance;
  double height = 0.0;
  int feet = 0;
  for (int e = 0; e < static_cast<int>(robot.end_effectors.size()); ++e) {
    const int surface = rest.plan.final_contacts[e];
    if (surface == kFree) continue;
    stance.contacts[robot.end_effectors[e].name] = scene.surfaces[surface].name;
    if (!is_foot(robot, e)) continue;
    height += rest.desired.back().end_effectors_W[e].z();
    ++feet;
  }
  stance.position_W = {pose.position.x(), pose.position.y(), feet > 0 ? height / feet : 0.0};
  stance.yaw = pose.yaw;
  return stance;
}

}  // namespace

double walk_on(Rest& rest, Scene& scene, const Robot& robot, const VelocityCommand& command, int phases) {
  const Similarity similarity = similarity_of(robot, scene.gravity);
  cut_off(rest, phases);
  stop_standing(rest);
  add_steps(rest, robot, command, phases, similarity);
  const auto [pose, at_s] = pose_of(rest, robot);
  const double end_s = times_of(rest).back();
  const double stop_s = std::min(kCommandStop_s * similarity.time, std::max(end_s - at_s, 0.0));
  const double turn = std::abs(command.yaw_rate) * std::max(end_s - at_s, 0.0);
  const double strides =
      std::min(ratio_of_strides(robot, command, similarity), turn > kHeadingAhead ? kHeadingAhead / turn : 1.0);
  for (const double shorter : {1.0, 0.75, 0.5, 0.25, 0.0}) {
    const double ratio = shorter * strides;
    const Pose from{pose.position, heading_at(rest, robot, pose, at_s, ratio * command.yaw_rate)};
    const Way way(from, at_s, command, ratio, end_s, stop_s);
    if (ratio > 0.0 && !finds_ground(rest, scene, robot, way.at(end_s))) continue;
    Follow(rest, scene, robot, way).run();
    scene.goal = stance_of(rest, scene, robot, way.at(end_s));
    return ratio;
  }
  return 0.0;
}

void stay(Rest& rest, Scene& scene, const Robot& robot) {
  const auto [pose, at_s] = pose_of(rest, robot);
  const Way nowhere(pose, at_s, {}, 0.0, times_of(rest).back(), 0.0);
  Follow(rest, scene, robot, nowhere).run();
  scene.goal = stance_of(rest, scene, robot, pose);
}

}  // namespace mcplan::ddp
