#include "mcplan/robot/similarity.hpp"

#include <algorithm>
#include <cmath>

namespace mcplan {
namespace {

/// 2^exponent, the largest integer power of 2^step that is at most 2 ratio. Takes the exponent from the floating-point
/// number itself, so that a ratio times a power of 2^step has the factor times the same, to the last bit.
/// Numbers that no valid robot has give 0: plans are asked questions before anybody has validated them.
int exponent_of(double ratio, int step) {
  if (!(std::isfinite(ratio) && ratio > 0.0)) return 0;
  constexpr int kMax = 240;  // products of three factors stay finite
  const int log2 = std::clamp(std::ilogb(2.0 * ratio), -kMax, kMax);
  const int steps = static_cast<int>(std::floor(static_cast<double>(log2) / step));
  return steps * step;
}

}  // namespace

Similarity similarity_of(const Robot& robot, double gravity) {
  constexpr double kHeight_m = 0.8, kGravity = 9.81, kMass_kg = 40.0;
  Similarity out;
  out.length = std::ldexp(1.0, exponent_of(robot.com_height / kHeight_m, 2));
  out.time = std::ldexp(1.0, exponent_of(robot.com_height / gravity * (kGravity / kHeight_m), 2) / 2);
  out.mass = std::ldexp(1.0, exponent_of(robot.mass / kMass_kg, 3));
  return out;
}

double swing_height_of(const Robot& robot, const Similarity& similarity) {
  return by_size(robot.swing_height, Robot().swing_height, similarity.length);
}

Eigen::Vector2d phase_duration_of(const Robot& robot, const Similarity& similarity) {
  const Eigen::Vector2d& given = robot.phase_duration;
  return given == Robot().phase_duration ? Eigen::Vector2d(similarity.time * given) : given;
}

}  // namespace mcplan
