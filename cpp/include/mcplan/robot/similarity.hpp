#pragma once

#include "mcplan/robot/robot.hpp"

namespace mcplan {

/// How many times longer, slower and heavier a robot is than one of human size, for which margins, tolerances and
/// default durations are stated: dynamic similarity. A robot with CoM height h and mass m in gravity g moves like any
/// other once lengths are counted in h, times in sqrt(h / g) and masses in m, so that what is stated in SI for the one
/// holds for the other times these factors.
///
/// The factors are powers of two: products with them are exact, and the plan of a robot 4 times as long, 2 times as
/// slow and 64 times as heavy is that of the smaller one to the last bit. All three are 1 for CoM heights from 0.4 to
/// 1.6 m, masses from 20 to 160 kg and earth's gravity. Elsewhere each is within a factor of 2 of the exact ratio, the
/// mass of 4: no tolerance is known better than that.
struct Similarity {
  double length = 1.0;  ///< 4^i, from h
  double time = 1.0;    ///< 2^j, from sqrt(h / g)
  double mass = 1.0;    ///< 8^k

  double velocity() const { return length / time; }
  double rate() const { return 1.0 / time; }  ///< of angles
  double force() const { return mass * length / (time * time); }
  double moment() const { return force() * length; }
  double angular_momentum() const { return mass * length * velocity(); }
};

/// The factors of a robot in this gravity [m/s^2]; both are valid.
Similarity similarity_of(const Robot& robot, double gravity);

/// A length or duration that nobody has set is stated for a robot of human size and goes with the robot's; any other is
/// meant as it stands.
inline double by_size(double value, double unset, double factor) { return value == unset ? value * factor : value; }

/// Robot::swing_height [m] and Robot::phase_duration [s] as a planner takes them: by_size().
double swing_height_of(const Robot& robot, const Similarity& similarity);
Eigen::Vector2d phase_duration_of(const Robot& robot, const Similarity& similarity);

}  // namespace mcplan
