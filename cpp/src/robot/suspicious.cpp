#include "model/suspicious.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "mcplan/robot/robot_files.hpp"
#include "model/text.hpp"

namespace mcplan {
namespace {

using model::digits;

constexpr double long_over_com = 50.0;      // lengths over the CoM's height: above, taken to be millimetres
constexpr double large_angle = 2.0 * M_PI;  // taken to be degrees
constexpr double long_over_fall = 100.0;    // durations over sqrt(h / g), in which a pendulum falls: milliseconds
constexpr double heavy_density = 16e3;      // [kg/m^3] of the cube of a robot's size, twice that of steel: grams

/// Distance of a polytope's farthest face from the origin [m]: its normals have length 1.
double farthest_face(const Polytope& polytope) { return polytope.given() ? polytope.b.cwiseAbs().maxCoeff() : 0.0; }

void suspect_lengths(const Robot& robot, std::vector<Suspicion>& out) {
  const auto look = [&](const std::string& field, double longest) {
    if (longest > long_over_com * robot.com_height)
      out.push_back({field, "lengths are in metres, and this looks like millimetres",
                     digits(longest, "%g") + " m beside a com_height of " + digits(robot.com_height, "%g") + " m"});
  };
  look("swing_height", std::abs(robot.swing_height));
  for (std::size_t i = 0; i < robot.trunk.size(); ++i) {
    const std::string field = "trunk[" + std::to_string(i) + "].";
    look(field + "from", robot.trunk[i].from_B.cwiseAbs().maxCoeff());
    look(field + "to", robot.trunk[i].to_B.cwiseAbs().maxCoeff());
    look(field + "radius", robot.trunk[i].radius);
  }
  for (std::size_t l = 0; l < robot.end_effectors.size(); ++l) {
    const EndEffector& end = robot.end_effectors[l];
    const std::string field = "end_effectors[" + std::to_string(l) + "].";
    look(field + "half_size", end.half_size.cwiseAbs().maxCoeff());
    look(field + "nominal", end.nominal_B.cwiseAbs().maxCoeff());
    look(field + "reach_min", end.reach_min_B.cwiseAbs().maxCoeff());
    look(field + "reach_max", end.reach_max_B.cwiseAbs().maxCoeff());
    look(field + "com_reach.b", farthest_face(end.com_reach));
    look(field + "reach_cut.b", farthest_face(end.reach_cut));
    look(field + "frame_offset", end.frame_offset.cwiseAbs().maxCoeff());
  }
}

void suspect_angles(const Robot& robot, std::vector<Suspicion>& out) {
  for (std::size_t l = 0; l < robot.end_effectors.size(); ++l) {
    const Eigen::Vector2d& range = robot.end_effectors[l].yaw_range;
    if (range.allFinite() && range.cwiseAbs().maxCoeff() > large_angle)
      out.push_back({"end_effectors[" + std::to_string(l) + "].yaw_range",
                     "angles are in radians, and these look like degrees", digits(range, "%.4g")});
  }
}

/// Length of the diagonal of the box around the CoM and all nominal positions [m], or the CoM's height.
double size_of(const Robot& robot) {
  Eigen::AlignedBox3d box(Eigen::Vector3d::Zero());
  for (const EndEffector& end : robot.end_effectors) box.extend(end.nominal_B);
  return std::max(box.diagonal().norm(), robot.com_height);
}

}  // namespace

std::vector<Suspicion> suspicious_geometry(const Robot& robot) {
  robot.validate();
  std::vector<Suspicion> out;
  const std::string height = digits(robot.com_height, "%g") + " m";
  if (robot.com_height > model::high_com_m)
    return {{"com_height", "lengths are in metres, and this looks like millimetres", height}};
  suspect_lengths(robot, out);
  suspect_angles(robot, out);
  if (robot.phase_duration[0] > long_over_fall * std::sqrt(robot.com_height / 9.81))
    out.push_back({"phase_duration", "durations are in seconds, and these look like milliseconds",
                   digits(robot.phase_duration, "%.4g") + " at a com_height of " + height});
  const double size = size_of(robot);
  if (robot.mass > heavy_density * size * size * size)
    out.push_back({"mass", "must be in kilograms, and this looks like grams",
                   digits(robot.mass, "%g") + " kg in a robot of " + digits(size, "%.3g") + " m"});
  const double largest = robot.inertia.maxCoeff();
  if (largest > (1.0 + 1e-6) * (robot.inertia.sum() - largest))
    out.push_back({"inertia", "of a body, no moment is above the sum of the other two", digits(robot.inertia, "%.4g")});
  return out;
}

}  // namespace mcplan
