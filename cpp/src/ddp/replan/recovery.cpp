#include "ddp/replan/recovery.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "ddp/constants.hpp"
#include "ddp/replan/under_feet.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Feet = std::array<int, 2>;

/// Swings are guessed at most and at least so long [s], stances between them so long, a swing under way at least so
/// long. Chosen.
constexpr double kSwing_s = 0.35, kQuickSwing_s = 0.2, kBetween_s = 0.12, kSwingLeft_s = 0.1;
/// So many steps, and phases at the end in which the robot stands. Chosen.
constexpr int kSteps = 3, kStands = 2;
/// A plan of so many phases at most, some of them quick, is such steps: the swing under way is made in two phases at
/// most.
constexpr int kRecoveryPhases = 2 + 2 * kSteps + kStands;
/// What is left of a swing lasts at least as long as the foot takes to come down at this speed, and it gets no farther
/// than at this one [m/s]. Chosen.
constexpr double kDescent = 0.4, kSwingSpeed = 1.5;
/// A foot whose landing is due before it gets to the capture point is also tried to land there, if that takes longer by
/// at least so much [s]; times are looked at in steps of so much [s]. Chosen.
constexpr double kLonger_s = 0.05, kLookEvery_s = 0.02;
/// Ratio of a sole in which the centre of pressure is guessed. Chosen.
constexpr double kInside = 0.8;
/// The CoM comes down by so much at most [in CoM heights], and a foot bears so many weights. Chosen.
constexpr double kDrop = 0.15, kForce = 1.4;
/// Legs that cross may have a foot so far beyond the CoM on the other side [in CoM heights]: hips of TALOS turn inward
/// by 0.35 rad, and one is 0.1 heights beside the CoM. Chosen.
constexpr double kInward = 0.25;
/// A foot that steps across lands farther out than the capture point by this, at least and at most so far beyond the
/// foot that stands, and soles are so far apart lengthwise, since shanks have to pass [in CoM heights]. Chosen.
constexpr double kBeyond = 0.03, kAcrossMin = 0.05, kAcrossMax = 0.35, kAlongGap = 0.04;
/// From so near to there it crosses at once [in CoM heights]. Chosen.
constexpr double kNearly = 0.04;
/// It passes the foot that stands at this speed [m/s], within this time at least and at most, on the side on which it
/// will be after this time [s]. Chosen.
constexpr double kPassing = 1.2, kPassingMin_s = 0.08, kPassingMax_s = 0.22, kAhead_s = 0.05;

/// A linear inverted pendulum above the ground plane.
struct Pendulum {
  Vector2d com, velocity;
  double omega;

  Vector2d capture() const { return com + velocity / omega; }

  void go_on(const Vector2d& pressure, double time_s) {
    const Vector2d capture_end = pressure + (capture() - pressure) * std::exp(omega * time_s);
    com = pressure + (com - pressure) * std::cosh(omega * time_s) + velocity / omega * std::sinh(omega * time_s);
    velocity = omega * (capture_end - com);
  }
};

/// The robot that stays upright: dropping the CoM slows down its fall to the side, but knees cannot catch that.
Robot upright(Robot robot, const Feet& feet, double gravity) {
  for (int e : feet) {
    EndEffector& end = robot.end_effectors[e];
    const double highest = end.nominal_B.z() + kDrop * robot.com_height;
    if (highest > end.reach_min_B.z()) end.reach_max_B.z() = std::min(end.reach_max_B.z(), highest);
    end.max_force = std::min(end.max_force, kForce * robot.mass * gravity);
  }
  return robot;
}

/// The robot whose legs may cross.
Robot crossed(Robot robot, const Feet& feet) {
  const double inward = kInward * robot.com_height;
  for (int e : feet) {
    EndEffector& end = robot.end_effectors[e];
    end.partner_reach.clear();
    if (end.nominal_B.y() > 0.0)
      end.reach_min_B.y() = std::min(end.reach_min_B.y(), -inward);
    else
      end.reach_max_B.y() = std::max(end.reach_max_B.y(), inward);
  }
  return robot;
}

/// Steps that are put together one after the other, with the pendulum's motion as the guess. Every step catches it in
/// the guess, whether it does or not: what is off by 0.1 m would be off by ten metres three steps later, and from such
/// guesses nothing converges. (Measured on 188 states of the G1 within 0.6 s of pushes of 88 N: 57 plans are accepted
/// without that, 102 with it.)
class Steps {
 public:
  Steps(const Rest& rest, const Now& now, const Robot& robot, const Feet& feet)
      : now_(&now), robot_(&robot), feet_(feet), rest_(rest), yaw_(rest.plan.knots.front().base_rpy.z()) {
    const Knot& start = rest.plan.knots.front();
    pendulum_ = {start.com_W.head<2>(), start.com_velocity_W.head<2>(),
                 std::sqrt(now.scene->gravity / robot.com_height)};
    rest_.keep_first();
    rest_.free_end = true;
    rest_.shortest_s = quickest_s(robot, now.similarity);
    rest_.plan.final_contacts = rest.contacts(0);
    Knot& end = rest_.plan.knots.back() = start;
    end.base_rpy_rate.setZero();
    end.angular_momentum_W.setZero();
    for (Vector3d& velocity_W : end.end_effector_velocities_W) velocity_W.setZero();
  }

  /// The phase under way ends after so long, its contacts as they are.
  void wait(double time_s) {
    rest_.plan.phases.front().duration = time_s;
    go_on(time_s);
  }

  /// The foot in the air, or one that is lifted for it, lands after so long. False where no ground is.
  bool land(int foot, double swing_s) {
    const Vector3d from_W = rest_.plan.knots.back().end_effectors_W[foot];
    swing(foot, swing_s);
    return touch_down(foot, place(foot, from_W, kSwingSpeed * now_->similarity.velocity() * swing_s));
  }

  /// The foot in the air lands on the other side of the one that stands. False where no ground is.
  bool land_across(int foot, double swing_s, bool nearer) {
    const Knot start = rest_.plan.knots.front();  // a copy: phases that are put in move the knots
    const int other = other_than(foot);
    const EndEffector &one = robot_->end_effectors[foot], &stands = robot_->end_effectors[other];
    const double yaw = start.end_effector_yaw.empty() ? yaw_ : start.end_effector_yaw[other],
                 height = robot_->com_height;
    const Vector2d along = turned(Vector2d::UnitX(), yaw), out = outward(other, yaw);
    const Vector2d stands_W = start.end_effectors_W[other].head<2>();
    const Vector2d apart = start.end_effectors_W[foot].head<2>() - stands_W;
    Vector2d moving = Vector2d::Zero();
    if (!start.end_effector_velocities_W.empty()) moving = start.end_effector_velocities_W[foot].head<2>();
    const double ahead = along.dot(apart + kAhead_s * now_->similarity.time * moving);
    const Vector2d axis = (ahead < 0.0) == nearer ? Vector2d(-along) : along;
    const double apart_m = one.half_size.x() + stands.half_size.x() + kAlongGap * height;
    const double beside_m = one.half_size.y() + stands.half_size.y();
    rest_.across = Rest::Across{1, foot, other, axis, -1, Vector3d::Zero()};
    const double to_go_m = apart_m - axis.dot(apart);
    if (to_go_m > kNearly * height && out.dot(apart) < -0.3 * beside_m) {
      const double time = now_->similarity.time;
      const double passing_s =
          std::clamp(to_go_m / (kPassing * now_->similarity.velocity()), kPassingMin_s * time, kPassingMax_s * time);
      wait(passing_s);
      Knot& via = rest_.plan.knots.back();
      via.end_effectors_W[foot].head<2>() = stands_W + apart_m * axis + std::min(out.dot(apart), -beside_m) * out;
      rest_.across->via_knot = 1;
      rest_.across->via_W = via.end_effectors_W[foot];
      rest_.across->knot = 2;
      add(rest_.plan.final_contacts, swing_s);
      rest_.plan.phases.back().contacts = rest_.plan.phases.front().contacts;
      go_on(swing_s);
    } else {
      wait(swing_s);
    }
    const double beyond_m = std::clamp(out.dot(pendulum_.capture() - stands_W) + kBeyond * height, kAcrossMin * height,
                                       kAcrossMax * height);
    const Vector2d at = stands_W + apart_m * axis + beyond_m * out;
    const Found ground = ground_at(*now_->scene, one, Vector3d(at.x(), at.y(), start.end_effectors_W[other].z()));
    if ((ground.place_W.head<2>() - at).norm() > kAlongGap * height) return false;
    return touch_down(foot, ground);
  }

  /// Both feet stand, the CoM between them, and that is the end.
  Rest stand() {
    for (int i = 0; i < kStands; ++i) add(rest_.plan.final_contacts, kStanding_s * now_->similarity.time);
    for (int i = 0; i < kStands; ++i) {
      Knot& knot = rest_.plan.knots[rest_.plan.knots.size() - 1 - i];
      const Vector3d middle_W = 0.5 * (knot.end_effectors_W[feet_[0]] + knot.end_effectors_W[feet_[1]]);
      knot.com_W = middle_W + robot_->com_height * Vector3d::UnitZ();
      knot.com_velocity_W.setZero();
    }
    rest_.carry_hands(*robot_);
    return std::move(rest_);
  }

  /// From a least time up to a longest one [s], that in which a foot gets to where the capture point is by then, as the
  /// other one stands.
  double time_to_capture(int foot, double least_s, double longest_s) const {
    const Knot& knot = rest_.plan.knots.back();
    const Vector2d from_W = knot.end_effectors_W[foot].head<2>(), at_W = pressure_on(other_than(foot), knot);
    double time_s = least_s;
    for (; time_s < longest_s; time_s += kLookEvery_s * now_->similarity.time) {
      Pendulum then = pendulum_;
      then.go_on(at_W, time_s);
      if ((near_capture(foot, then) - from_W).norm() <= kSwingSpeed * now_->similarity.velocity() * time_s) break;
    }
    return std::min(time_s, longest_s);
  }

  /// How far the capture point is beyond a foot on its outer side [m].
  double beyond(int foot) const {
    const Vector2d apart = pendulum_.capture() - rest_.plan.knots.front().end_effectors_W[foot].head<2>();
    return outward(foot, yaw_).dot(apart);
  }

 private:
  int other_than(int foot) const { return feet_[0] == foot ? feet_[1] : feet_[0]; }

  Vector2d outward(int foot, double yaw) const {
    return turned(Vector2d(0.0, robot_->end_effectors[foot].nominal_B.y() < 0.0 ? -1.0 : 1.0), yaw);
  }

  void add(const ContactState& contacts, double time_s) { rest_.insert(rest_.size(), contacts, time_s); }

  void swing(int foot, double time_s) {
    ContactState swinging = rest_.plan.final_contacts;
    if (swinging[foot] == kFree) return wait(time_s);
    swinging[foot] = kFree;
    add(swinging, time_s);
    rest_.plan.final_contacts = swinging;
    go_on(time_s);
  }

  bool touch_down(int foot, const Found& ground) {
    if (ground.surface == kFree) return false;
    rest_.plan.knots.back().end_effectors_W[foot] = ground.place_W;
    rest_.plan.final_contacts[foot] = ground.surface;
    pendulum_.velocity = pendulum_.omega * (pressure(rest_.plan.knots.back()) - pendulum_.com);
    add(rest_.plan.final_contacts, kBetween_s * now_->similarity.time);
    go_on(kBetween_s * now_->similarity.time);
    return true;
  }

  /// The pendulum goes on over what stands, and the last knot is where it is by then.
  void go_on(double time_s) {
    Knot& knot = rest_.plan.knots.back();
    pendulum_.go_on(pressure(knot), time_s);
    knot.com_W.head<2>() = pendulum_.com;
    knot.com_velocity_W << pendulum_.velocity, 0.0;
    knot.base_rpy.head<2>().setZero();
  }

  /// The point that is nearest to the capture point, of a sole somewhat inside, of both of the line between them.
  Vector2d pressure(const Knot& knot) const {
    const Vector2d a = knot.end_effectors_W[feet_[0]].head<2>(), b = knot.end_effectors_W[feet_[1]].head<2>();
    const bool first = rest_.plan.final_contacts[feet_[0]] != kFree,
               both = first && rest_.plan.final_contacts[feet_[1]] != kFree;
    if (both) {
      const double length2 = (b - a).squaredNorm();
      return a + std::clamp(length2 > 0.0 ? (pendulum_.capture() - a).dot(b - a) / length2 : 0.0, 0.0, 1.0) * (b - a);
    }
    return pressure_on(first ? feet_[0] : feet_[1], knot);
  }

  Vector2d pressure_on(int foot, const Knot& knot) const {
    const Vector2d half = kInside * robot_->end_effectors[foot].half_size, at = knot.end_effectors_W[foot].head<2>();
    return at + turned(turned(pendulum_.capture() - at, -yaw_).cwiseMax(-half).cwiseMin(half), yaw_);
  }

  /// The capture point of the pendulum, but on the foot's own side of the other one, and within its reach.
  Vector2d near_capture(int foot, const Pendulum& pendulum) const {
    const EndEffector& end = robot_->end_effectors[foot];
    const int other = other_than(foot);
    const Vector2d stands_W = rest_.plan.knots.back().end_effectors_W[other].head<2>();
    const double side = end.nominal_B.y() < 0.0 ? -1.0 : 1.0;
    const double apart_m =
        end.half_size.y() + robot_->end_effectors[other].half_size.y() + kSoleRoom * robot_->com_height;
    Vector2d at = turned(pendulum.capture() - stands_W, -yaw_);
    at.y() = side * std::max(side * at.y(), apart_m);
    const Vector2d relative = turned(stands_W - pendulum.com, -yaw_) + at;
    const Eigen::AlignedBox3d usual = end.usual_box();
    const Vector2d within = relative.cwiseMax(usual.min().head<2>()).cwiseMin(usual.max().head<2>());
    return pendulum.com + turned(within, yaw_);
  }

  /// Ground there, or on the way there, no farther from a place than `way_m`.
  Found place(int foot, const Vector3d& from_W, double way_m) const {
    const Vector2d way = near_capture(foot, pendulum_) - from_W.head<2>();
    const Vector2d xy = from_W.head<2>() + way * std::min(1.0, way_m / std::max(way.norm(), 1e-9));
    const double height_W = rest_.plan.knots.back().end_effectors_W[other_than(foot)].z();
    return ground_at(*now_->scene, robot_->end_effectors[foot], Vector3d(xy.x(), xy.y(), height_W));
  }

  const Now* now_;
  const Robot* robot_;
  Feet feet_;
  Rest rest_;
  double yaw_;
  Pendulum pendulum_{};
};

/// The two feet; none where there are others.
std::optional<Feet> two_feet(const Robot& robot) {
  std::vector<int> feet;
  for (int e = 0; e < static_cast<int>(robot.end_effectors.size()); ++e)
    if (is_foot(robot, e)) feet.push_back(e);
  if (feet.size() != 2) return std::nullopt;
  return Feet{feet[0], feet[1]};
}

/// Whether the first step goes across: past the other foot on the side on which it is by now, or on the far one.
enum class Across { no, on_its_side, on_the_far_side };

/// The steps of one foot and the other in turn, the first of which takes so long if that is said; none where no ground
/// is.
std::optional<Rest> steps(Steps made, int foot, int other, std::optional<double> first_s, Across across,
                          const Similarity& similarity) {
  for (int i = 0; i < kSteps; ++i) {
    const int swings = i % 2 == 0 ? foot : other;
    const double swing_s =
        i == 0 && first_s ? *first_s
                          : made.time_to_capture(swings, kQuickSwing_s * similarity.time, kSwing_s * similarity.time);
    const bool crosses = i == 0 && across != Across::no;
    const bool landed =
        crosses ? made.land_across(foot, swing_s, across == Across::on_its_side) : made.land(swings, swing_s);
    if (!landed) return std::nullopt;
  }
  return made.stand();
}

}  // namespace

std::optional<Recovery> recovery_under_way(const Rest& rest, const Now& now) {
  const std::optional<Feet> feet = two_feet(*now.robot);
  if (!feet || !rest.quick || rest.size() > kRecoveryPhases) return std::nullopt;
  Recovery out{rest, upright(*now.robot, *feet, now.scene->gravity)};
  out.rest.free_end = true;
  out.rest.shortest_s = quickest_s(*now.robot, now.similarity);
  return out;
}

std::vector<Recovery> recoveries(const Rest& rest, const Now& now) {
  const std::optional<Feet> feet = two_feet(*now.robot);
  if (!feet) return {};
  const Robot robot = upright(*now.robot, *feet, now.scene->gravity);
  const auto stands = [&](int e) { return rest.surface(0, e) != kFree; };
  const double time = now.similarity.time;
  std::vector<Recovery> out;
  const auto add = [&](std::optional<Rest> made, const Robot& robot) {
    if (made) out.push_back({*std::move(made), robot});
  };
  if (stands((*feet)[0]) && stands((*feet)[1])) {
    // A step that is due soon stays due: put off anew by every replan it would never be made.
    const auto is_due = [&](int i) { return rest.surface(1, (*feet)[i]) == kFree; };
    const double left_s = std::max(rest.plan.phases.front().duration, kReplanRest_s * time);
    const int first = is_due(1) ? 1 : 0;
    for (int i : {first, 1 - first}) {
      Steps made(rest, now, robot, *feet);
      made.wait(is_due(i) ? std::min(left_s, kBetween_s * time) : kBetween_s * time);
      add(steps(std::move(made), (*feet)[i], (*feet)[1 - i], std::nullopt, Across::no, now.similarity), robot);
    }
    return out;
  }
  if (!stands((*feet)[0]) && !stands((*feet)[1])) return out;
  const int foot = stands((*feet)[0]) ? (*feet)[1] : (*feet)[0], other = stands((*feet)[0]) ? (*feet)[0] : (*feet)[1];
  const Knot& start = rest.plan.knots.front();
  const double height_m = std::max(start.end_effectors_W[foot].z() - start.end_effectors_W[other].z(), 0.0);
  const double least_s =
      std::clamp(height_m / (kDescent * now.similarity.velocity()), kReplanRest_s * time, kSwingLeft_s * time);
  const double left_s = std::clamp(rest.plan.phases.front().duration, least_s, kSwing_s * time);
  const Steps begun(rest, now, robot, *feet);
  add(steps(begun, foot, other, left_s, Across::no, now.similarity), robot);
  // Once: put off by every replan the foot would never land.
  const double there_s = rest.quick ? left_s : begun.time_to_capture(foot, left_s, kSwing_s * time);
  if (there_s > left_s + kLonger_s * time) add(steps(begun, foot, other, there_s, Across::no, now.similarity), robot);
  const bool soles = std::min(now.robot->end_effectors[foot].half_size.minCoeff(),
                              now.robot->end_effectors[other].half_size.minCoeff()) > 0.0;
  if (now.options->crossing && soles && begun.beyond(other) > 0.0) {
    const Robot crossing = crossed(robot, *feet);
    for (const Across across : {Across::on_its_side, Across::on_the_far_side})
      add(steps(Steps(rest, now, crossing, *feet), foot, other, kSwing_s * time, across, now.similarity), crossing);
  }
  return out;
}

}  // namespace mcplan::ddp
