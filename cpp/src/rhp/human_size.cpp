#include "rhp/human_size.hpp"

#include <cmath>

namespace mcplan::rhp {
namespace {

/// Factors from the robot of the paper to one of another size. Not the powers of two of the checker: the durations and
/// bounds of the programs suit robots that are nearer to it than a factor of two. From robots that are 4, 16, ... times
/// as long they are exact all the same.
Similarity from_the_papers_robot(const Robot& robot, double gravity) {
  constexpr double kHeight_m = 0.75, kMass_kg = 95.0, kGravity = 9.80665;
  return {robot.com_height / kHeight_m, std::sqrt(robot.com_height / gravity / (kHeight_m / kGravity)),
          robot.mass / kMass_kg};
}

Range by_size(const Range& value, const Range& unset, double factor) {
  const bool at_default = value.min == unset.min && value.max == unset.max;
  return at_default ? value : Range{value.min * factor, value.max * factor};
}

/// What is at its default is stated for human size already.
double to_human(double value, double unset, double factor) { return value == unset ? value : value * factor; }

Options scaled(const Options& options, const Similarity& by) {
  const Options unset;
  Options out = options;
  out.double_support_s = by_size(options.double_support_s, unset.double_support_s, by.time);
  out.single_support_s = by_size(options.single_support_s, unset.single_support_s, by.time);
  const auto scale = [&](double Options::*field, double factor) {
    out.*field = to_human(options.*field, unset.*field, factor);
  };
  scale(&Options::landing_s, by.time);
  scale(&Options::predicted_double_support_s, by.time);
  scale(&Options::predicted_single_support_s, by.time);
  scale(&Options::com_velocity_max, by.velocity());
  scale(&Options::momentum_max, by.angular_momentum());
  scale(&Options::momentum_rate_max, by.moment());
  scale(&Options::foothold_margin_m, by.length);
  return out;
}

State scaled(const State& state, const Similarity& by) {
  State out = state;
  out.com_W *= by.length;
  out.com_velocity_W *= by.velocity();
  out.angular_momentum_W *= by.angular_momentum();
  for (Eigen::Vector3d& foot : out.feet_W) foot *= by.length;
  return out;
}

}  // namespace

HumanSize::HumanSize(const Scene& scene, const Robot& robot, const Options& options)
    : scene_(scene), robot_(robot), options_(options) {
  scene.validate();
  robot.validate();
  options.validate();
  const Similarity of_checker = similarity_of(robot, scene.gravity);
  const bool human = of_checker.length == 1.0 && of_checker.time == 1.0 && of_checker.mass == 1.0;
  if (!human && !options.paper) own_ = from_the_papers_robot(robot, scene.gravity);
  human_ = inverse(own_);
}

Walker HumanSize::walker() const {
  return {mcplan::scaled(scene_, human_), mcplan::scaled(robot_, human_), scaled(options_, human_)};
}

State HumanSize::to_human(const State& state) const { return scaled(state, human_); }
State HumanSize::to_own(const State& state) const { return scaled(state, own_); }

Plan HumanSize::to_own(const Plan& plan) const {
  Plan out = scaled_motion(plan, own_);
  if (plan.phases.empty()) return out;
  out.scene = scene_;
  out.robot = robot_;
  return out;
}

}  // namespace mcplan::rhp
