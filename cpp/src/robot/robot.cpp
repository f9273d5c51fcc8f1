#include "mcplan/robot/robot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "mcplan/base/error.hpp"
#include "mcplan/base/rotation.hpp"
#include "mcplan/scene/polygon.hpp"
#include "model/read.hpp"
#include "robot/ground_plane.hpp"
#include "robot_fields.hpp"

namespace mcplan {
namespace {

using Eigen::Vector3d;

/// The nominal point must lie in the box, and the box must be one.
void require_box(const EndEffector& e, const std::string& field) {
  const char axes[] = "xyz";
  for (int i = 0; i < 3; ++i) {
    if (!(e.reach_min_B[i] < e.reach_max_B[i]))
      throw InvalidRobot(field + ".reach_max", std::string("must exceed reach_min in ") + axes[i],
                         text(e.reach_min_B[i]) + " to " + text(e.reach_max_B[i]));
    if (e.nominal_B[i] < e.reach_min_B[i] || e.nominal_B[i] > e.reach_max_B[i])
      throw InvalidRobot(
          field + ".nominal", std::string("must lie in the reach box in ") + axes[i],
          text(e.nominal_B[i]) + " outside [" + text(e.reach_min_B[i]) + ", " + text(e.reach_max_B[i]) + "]");
  }
}

void require_yaw_range(const EndEffector& e, const std::string& field) {
  if (!(e.yaw_range[0] <= 0.0 && e.yaw_range[1] >= 0.0))
    throw InvalidRobot(field + ".yaw_range", "must be two finite numbers, the first <= 0, the second >= 0, or +-inf",
                       text(e.yaw_range));
}

void require_usual_reach(const EndEffector& e, const std::string& field) {
  const double x = e.nominal_B.x();
  if (!(e.usual_reach[0] < x && x < e.usual_reach[1]))
    throw InvalidRobot(field + ".usual_reach", "must be two numbers about the nominal x, " + text(x),
                       text(e.usual_reach));
}

/// `nominal`: the point of the nominal stance that the set must hold.
void validate_polytope(const Polytope& set, const Vector3d& nominal, const std::string& field) {
  constexpr double unit_tolerance = 1e-3, inside_tolerance_m = 1e-6;
  if (set.A.rows() != set.b.size())
    throw InvalidRobot(field + ".b", "must have a number for each row of A",
                       text(static_cast<int>(set.b.size())) + " for " + text(static_cast<int>(set.A.rows())) + " rows");
  for (int i = 0; i < set.A.rows(); ++i) {
    const std::string row = "[" + std::to_string(i) + "]";
    const Vector3d normal = set.A.row(i);
    if (!(normal.allFinite() && std::isfinite(set.b[i])))
      throw InvalidRobot(field + (normal.allFinite() ? ".b" : ".A") + row, "must be finite numbers",
                         normal.allFinite() ? text(set.b[i]) : text(normal));
    if (std::abs(normal.norm() - 1.0) > unit_tolerance)
      throw InvalidRobot(field + ".A" + row, "must have length 1 within 0.001", text(normal.norm()));
    const double outside = normal.dot(nominal) - set.b[i];
    if (outside > inside_tolerance_m)
      throw InvalidRobot(field, "must hold the nominal stance",
                         text(nominal) + ", " + text(outside) + " m outside row " + std::to_string(i));
  }
}

/// Faces through the reach box: few, and none where polytopes say it finer.
void validate_cut(const EndEffector& e, const std::string& field) {
  if (e.reach_cut.A.rows() > kReachCuts)
    throw InvalidRobot(field + ".A", "must have at most " + std::to_string(kReachCuts) + " rows",
                       text(static_cast<int>(e.reach_cut.A.rows())));
  if (e.reach_cut.given() && e.com_reach.given())
    throw InvalidRobot(field, "must be left out beside com_reach, which says where the CoM may be",
                       text(static_cast<int>(e.reach_cut.A.rows())) + " rows");
  validate_polytope(e.reach_cut, e.nominal_B, field);
}

void require_durations(const Eigen::Vector2d& range) {
  if (!(range[1] >= range[0]))
    throw InvalidRobot("phase_duration", "must be two positive numbers, the shorter first", text(range));
}

void validate_reach(const Robot& robot, const EndEffector& e, const std::string& field) {
  validate_cut(e, field + ".reach_cut");
  validate_polytope(e.com_reach, -e.nominal_B, field + ".com_reach");
  for (const auto& [partner, reach] : e.partner_reach) {
    const int other = robot.end_effector_index(partner);
    if (other < 0 || partner == e.name)
      throw InvalidRobot(field + ".partner_reach." + partner, "must name another end-effector", text(partner));
    validate_polytope(reach, robot.end_effectors[other].nominal_B - e.nominal_B, field + ".partner_reach." + partner);
  }
}

/// The nominal stance must bend the knee, by more than the margin.
void require_limb(const EndEffector& e, const std::string& field) {
  const LimbLimits& limb = e.limb;
  const bool has_sole = e.half_size.maxCoeff() > 0.0;
  if (!has_sole && !limb.ankle.isZero(0.0))
    throw InvalidRobot(field + ".ankle", "must be zero for an end-effector without a sole", text(limb.ankle));
  const double length = (limb.hip_B - e.nominal_B - limb.ankle).norm();
  const double min = std::abs(limb.upper - limb.lower) + limb.margin, max = limb.upper + limb.lower - limb.margin;
  if (!(length > min && length < max))
    throw InvalidRobot(field,
                       "must be a leg that is bent in the nominal stance, " + text(min) + " to " + text(max) + " m",
                       text(length) + " m from hip to ankle");
  const double thickest = 0.5 * (limb.upper + limb.lower);
  if (!(limb.radius <= thickest))
    throw InvalidRobot(field + ".radius", "must be at most half of upper + lower", text(limb.radius));
  if (!(std::abs(limb.beside) <= thickest))
    throw InvalidRobot(field + ".beside", "must be at most half of upper + lower, left or right", text(limb.beside));
}

void require_trunk(const Robot& robot, const TrunkPart& part, const std::string& field) {
  constexpr double kFar = 10.0;
  const double lowest = robot.com_height + std::min(part.from_B.z(), part.to_B.z()) - part.radius;
  const double farthest = std::max(part.from_B.norm(), part.to_B.norm()) + part.radius;
  if (!(farthest <= kFar * robot.com_height))
    throw InvalidRobot(field, "must lie within " + text(kFar) + " com_heights of the CoM", text(farthest) + " m");
  if (!(lowest > 0.0))
    throw InvalidRobot(field,
                       "must lie above the ground in the nominal stance: com_height + min(from.z, to.z) > radius",
                       text(lowest) + " m above it");
}

}  // namespace

Eigen::AlignedBox3d EndEffector::usual_box() const {
  Eigen::AlignedBox3d out(reach_min_B, reach_max_B);
  out.min().x() = std::max(out.min().x(), usual_reach[0]);
  out.max().x() = std::min(out.max().x(), usual_reach[1]);
  return out;
}

int Robot::end_effector_index(const std::string& end_effector_name) const {
  for (std::size_t l = 0; l < end_effectors.size(); ++l)
    if (end_effectors[l].name == end_effector_name) return static_cast<int>(l);
  return -1;
}

void Robot::validate() const {
  model::Findings found;
  model::check_struct(*this, model::Place(), found);
  model::relations(*this, found);
  found.raise<InvalidRobot>();
}

void model::relations(const Robot& robot, Findings& found) {
  found.check({"phase_duration"}, [&] { require_durations(robot.phase_duration); });
  for (std::size_t i = 0; i < robot.trunk.size(); ++i) {
    const std::string field = "trunk[" + std::to_string(i) + "]";
    found.check({field, "com_height"}, [&] { require_trunk(robot, robot.trunk[i], field); });
  }
  std::set<std::string> names;
  const auto field_of = [](std::size_t l) { return "end_effectors[" + std::to_string(l) + "]"; };
  for (std::size_t l = 0; l < robot.end_effectors.size(); ++l) {
    const EndEffector& e = robot.end_effectors[l];
    const std::string field = field_of(l);
    found.check({field + ".nominal", field + ".reach_min", field + ".reach_max"}, [&] { require_box(e, field); });
    found.check({field + ".usual_reach", field + ".nominal"}, [&] { require_usual_reach(e, field); });
    found.check({field + ".yaw_range"}, [&] { require_yaw_range(e, field); });
    if (e.limb.given())
      found.check({field + ".limb", field + ".half_size", field + ".nominal"},
                  [&] { require_limb(e, field + ".limb"); });
    found.check({field + ".name"}, [&] {
      if (!names.insert(e.name).second) throw InvalidRobot(field + ".name", "must be unique", text(e.name));
    });
  }
  // What is wrong with the robot itself says nothing of its end-effectors, but names and nominal points must be right.
  const bool sound = found.sound("end_effectors");
  for (std::size_t l = 0; sound && l < robot.end_effectors.size(); ++l)
    found.check({}, [&] { validate_reach(robot, robot.end_effectors[l], field_of(l)); });
}

bool addresses(const std::string& who, const EndEffector& end_effector) {
  return who == end_effector.name || who == end_effector.kind;
}

bool may_touch(const Surface& surface, const EndEffector& end_effector) {
  return surface.end_effectors.empty() ||
         std::any_of(surface.end_effectors.begin(), surface.end_effectors.end(),
                     [&](const std::string& who) { return addresses(who, end_effector); });
}

namespace {

/// Room that feet keep to the sides of their reach box where the height of a stance is chosen by it, in CoM heights.
/// Chosen: what searches keep inside of the box is 3 mm of a robot of human size.
constexpr double kReachRoom = 0.005;

/// A trunk that is as long as its legs does not stay level on a slope: on three feet and more it is parallel to it.
Vector3d along_ground(const Robot& robot, const ResolvedStance& stance) {
  std::vector<Vector3d> feet_W;
  for (std::size_t l = 0; l < robot.end_effectors.size(); ++l)
    if (stance.contacts[l] >= 0 && robot.end_effectors[l].kind == "foot") feet_W.push_back(stance.end_effectors_W[l]);
  return rpy_along_ground(feet_W, stance.yaw);
}

/// By how much a level base is raised, or lowered where that is negative, so that all feet in contact are within their
/// reach boxes: on ground that falls off sideways the lower leg does not reach down from the usual height. Feet keep
/// kReachRoom inside where there is that much. No more than the ground differs in height below them, since no more is
/// due to it, and nothing where no height will do.
double height_within_reach(const Robot& robot, const ResolvedStance& stance) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kLeaning = 1e-3;  // faces that stand upright say nothing of the height
  const Eigen::Matrix3d to_base = rotation_from_rpy(stance.base_rpy).transpose();
  double low = -kInfinity, high = kInfinity, ground_min = kInfinity, ground_max = -kInfinity;
  for (std::size_t l = 0; l < robot.end_effectors.size(); ++l) {
    const EndEffector& end = robot.end_effectors[l];
    if (stance.contacts[l] < 0 || end.kind != "foot" || end.com_reach.given()) continue;
    const double place = stance.end_effectors_W[l].z() - stance.com_W.z();
    low = std::max(low, place - end.reach_max_B.z());
    high = std::min(high, place - end.reach_min_B.z());
    const Vector3d relative_B = to_base * (stance.end_effectors_W[l] - stance.com_W);
    for (int i = 0; i < end.reach_cut.A.rows(); ++i) {
      const Vector3d normal = end.reach_cut.A.row(i);
      if (normal.z() > kLeaning) low = std::max(low, (normal.dot(relative_B) - end.reach_cut.b[i]) / normal.z());
      if (normal.z() < -kLeaning) high = std::min(high, (normal.dot(relative_B) - end.reach_cut.b[i]) / normal.z());
    }
    ground_min = std::min(ground_min, place - end.nominal_B.z());
    ground_max = std::max(ground_max, place - end.nominal_B.z());
  }
  if (!(low <= high) || (low <= 0.0 && 0.0 <= high)) return 0.0;
  const double room = std::min(kReachRoom * robot.com_height, 0.5 * (high - low));
  const double raised = high < 0.0 ? high - room : low + room;
  return std::abs(raised) <= ground_max - ground_min ? raised : 0.0;
}

}  // namespace

ResolvedStance resolve_stance(const Scene& scene, const Robot& robot, const Stance& stance, const std::string& field) {
  const auto& end_effectors = robot.end_effectors;
  for (const auto& [who, surface] : stance.contacts)
    if (std::none_of(end_effectors.begin(), end_effectors.end(),
                     [&w = who](const EndEffector& e) { return addresses(w, e); })) {
      std::string names;
      for (const auto& e : end_effectors) names += (names.empty() ? "" : ", ") + e.name;
      throw InvalidScene(field + ".contacts",
                         "must name end-effectors of " + robot.name + " (" + names + ") or their kind", text(who));
    }

  ResolvedStance out;
  out.com_W = stance.position_W + robot.com_height * Vector3d::UnitZ();
  out.yaw = stance.yaw;
  out.base_rpy = {0.0, 0.0, stance.yaw};
  const auto resolve = [&](const EndEffector& e) {
    auto contact = stance.contacts.find(e.name);
    if (contact == stance.contacts.end()) contact = stance.contacts.find(e.kind);
    Vector3d position = out.com_W + rotation_from_rpy(out.base_rpy) * e.nominal_B;
    int surface = -1;
    if (contact != stance.contacts.end()) {
      surface = scene.surface_index(contact->second);
      if (surface < 0) throw InvalidScene(field + ".contacts." + e.name, "must name a surface", text(contact->second));
      if (!may_touch(scene.surfaces[surface], e))
        throw InvalidScene(field + ".contacts." + e.name,
                           "must be allowed on its surface (surfaces[" + std::to_string(surface) + "].end_effectors)",
                           text(contact->second));
      position = Polygon(scene.surfaces[surface].vertices_W).nearest(position);
    }
    return std::pair(surface, position);
  };
  for (const EndEffector& e : end_effectors) {
    const std::pair<int, Vector3d> resolved = resolve(e);
    out.contacts.push_back(resolved.first);
    out.end_effectors_W.push_back(resolved.second);
  }
  out.base_rpy = along_ground(robot, out);
  if (!out.base_rpy.head<2>().isZero(0.0)) {
    for (std::size_t l = 0; l < end_effectors.size(); ++l) out.end_effectors_W[l] = resolve(end_effectors[l]).second;
  } else if (const double raised = height_within_reach(robot, out); raised != 0.0) {
    out.com_W.z() += raised;
    for (std::size_t l = 0; l < end_effectors.size(); ++l)
      if (out.contacts[l] < 0) out.end_effectors_W[l].z() += raised;
  }
  return out;
}

}  // namespace mcplan
