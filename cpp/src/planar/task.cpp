#include "mcplan/planar/task.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "model/read.hpp"
#include "task_fields.hpp"

namespace mcplan {
namespace {

using Eigen::Vector2d;

constexpr double kPlace = 1e-6;  // [m], [rad] of a contact off its surface

std::string indexed(const std::string& field, std::size_t i) { return field + "[" + std::to_string(i) + "]"; }

void require_index(const std::string& field, int value, std::size_t count, const std::string& of_what) {
  if (value < 0 || value >= static_cast<int>(count))
    throw InvalidPlanarTask(field, "must be the index of " + of_what + " (below " + std::to_string(count) + ")",
                            text(value));
}

void require_extent(const PlanarSurface& surface, const std::string& field) {
  if (!(surface.from < surface.to))
    throw InvalidPlanarTask(field + ".to", "must exceed from", text(surface.from) + " to " + text(surface.to));
}

/// On its surface, with all points within its extent, and not turned against it (whole turns aside).
void validate_contact(const PlanarTask& task, const PlanarContact& contact, const std::string& field) {
  require_index(field + ".end_effector", contact.end_effector, task.robot.end_effectors.size(), "an end-effector");
  require_index(field + ".surface", contact.surface, task.surfaces.size(), "a surface");

  const PlanarSurface& surface = task.surfaces[contact.surface];
  const std::string where = "surface " + text(surface.name);
  const Vector2d from_origin_W = contact.position_W - surface.origin_W;
  const double height = from_origin_W.dot(surface.normal_W());
  if (std::abs(height) > kPlace)
    throw InvalidPlanarTask(field + ".position", "must lie on " + where, text(height) + " m off it");
  const double turned = std::remainder(contact.angle - surface.angle, 2.0 * M_PI);
  if (std::abs(turned) > kPlace)
    throw InvalidPlanarTask(field + ".angle", "must be that of " + where + ", " + text(surface.angle) + ", up to turns",
                            text(contact.angle));
  for (double point : task.robot.end_effectors[contact.end_effector].points) {
    const double along = from_origin_W.dot(surface.tangent_W()) + point;
    if (along < surface.from - kPlace || along > surface.to + kPlace)
      throw InvalidPlanarTask(field + ".position",
                              "must keep all points within the extent of " + where + ", " + text(surface.from) +
                                  " to " + text(surface.to) + " m",
                              text(along));
  }
}

/// Points of the chain from an end-effector's frame up to an ancestor's child, as lengths; `end_P` is where the chain
/// meets the ancestor, in the ancestor's frame.
double chain_length(const PlanarRobot& robot, int end_effector, int ancestor, Vector2d& end_P) {
  end_P = robot.end_effectors[end_effector].position_B;
  double length = 0.0;
  for (int b = robot.end_effectors[end_effector].body; b != ancestor; b = robot.bodies[b].parent) {
    length += end_P.norm();
    end_P = robot.bodies[b].joint_P;
  }
  return length;
}

/// Largest distance between two end-effectors' frames, whatever the joints do.
double longest_stretch(const PlanarRobot& robot, int first, int second) {
  std::set<int> ancestors{0};
  for (int b = robot.end_effectors[first].body; b > 0; b = robot.bodies[b].parent) ancestors.insert(b);
  int common = robot.end_effectors[second].body;
  while (!ancestors.count(common)) common = robot.bodies[common].parent;
  Vector2d from_P, to_P;
  const double length = chain_length(robot, first, common, from_P) + chain_length(robot, second, common, to_P);
  return length + (from_P - to_P).norm();
}

void require_reachable(const PlanarTask& task, const PlanarContact& a, const PlanarContact& b,
                       const std::string& field) {
  const auto& end_effectors = task.robot.end_effectors;
  if (a.end_effector == b.end_effector) {
    if ((a.position_W - b.position_W).norm() > kPlace || std::abs(a.angle - b.angle) > kPlace)
      throw InvalidPlanarTask(field + ".position",
                              "must be where " + text(end_effectors[a.end_effector].name) +
                                  " stands in the phase before, which it does not leave",
                              text(b.position_W) + " rad " + text(b.angle));
    return;
  }
  const double distance = (a.position_W - b.position_W).norm();
  const double stretch = longest_stretch(task.robot, a.end_effector, b.end_effector);
  if (distance > stretch + kPlace)
    throw InvalidPlanarTask(field + ".position",
                            "must be within " + text(stretch) + " m of " + text(end_effectors[a.end_effector].name) +
                                ", all that the limbs between them can stretch",
                            text(distance) + " m");
}

void validate_clearance(const PlanarTask& task, const PlanarPhase& phase, const PlanarClearance& clearance,
                        const std::string& field) {
  require_index(field + ".end_effector", clearance.end_effector, task.robot.end_effectors.size(), "an end-effector");
  require_index(field + ".surface", clearance.surface, task.surfaces.size(), "a surface");
  for (const PlanarContact& contact : phase.contacts)
    if (contact.end_effector == clearance.end_effector)
      throw InvalidPlanarTask(field + ".end_effector", "must not be in contact in this phase",
                              text(task.robot.end_effectors[clearance.end_effector].name));
  if (clearance.first_interval < 0 || clearance.first_interval >= phase.intervals)
    throw InvalidPlanarTask(field + ".first_interval",
                            "must be an interval of the phase (below " + text(phase.intervals) + ")",
                            text(clearance.first_interval));
  if (clearance.end_interval != -1 &&
      (clearance.end_interval <= clearance.first_interval || clearance.end_interval > phase.intervals))
    throw InvalidPlanarTask(
        field + ".end_interval",
        "must be -1 or lie in [" + text(clearance.first_interval + 1) + ", " + text(phase.intervals) + "]",
        text(clearance.end_interval));
  if (!(clearance.middle_height < std::numeric_limits<double>::infinity()))
    throw InvalidPlanarTask(field + ".middle_height", "must be a number below infinity", text(clearance.middle_height));
}

void require_asked(const PlanarTask& task, const PlanarClearance& clearance, const std::string& field) {
  if (task.keeps_clear(clearance.end_effector, clearance.surface)) return;
  throw InvalidPlanarTask(
      field + ".surface",
      "must not be in no_clearance together with " + text(task.robot.end_effectors[clearance.end_effector].name),
      text(task.surfaces[clearance.surface].name));
}

void validate_no_clearance(const PlanarTask& task, std::size_t i) {
  const PlanarNoClearance& pair = task.no_clearance[i];
  const std::string field = indexed("no_clearance", i);
  require_index(field + ".end_effector", pair.end_effector, task.robot.end_effectors.size(), "an end-effector");
  require_index(field + ".surface", pair.surface, task.surfaces.size(), "a surface");
  for (std::size_t other = 0; other < i; ++other)
    if (model::equal(task.no_clearance[other], pair))
      throw InvalidPlanarTask(field + ".surface", "must not be there twice with the same end-effector",
                              text(task.surfaces[pair.surface].name));
}

void validate_pose(const PlanarTask& task, const PlanarPose& pose, const std::string& field) {
  require_index(field + ".body", pose.body, task.robot.bodies.size(), "a body");
  const char* components[] = {"x", "y", "angle"};
  for (int i = 0; i < 3; ++i)
    if (!(pose.min[i] <= pose.max[i]))
      throw InvalidPlanarTask(field + ".max", std::string("must not be below min in ") + components[i],
                              text(pose.min[i]) + " to " + text(pose.max[i]));
}

void validate_contacts(const PlanarTask& task, const PlanarPhase& phase, const std::string& field) {
  std::set<int> standing;
  for (std::size_t i = 0; i < phase.contacts.size(); ++i) {
    const std::string contact = indexed(field + ".contacts", i);
    validate_contact(task, phase.contacts[i], contact);
    if (!standing.insert(phase.contacts[i].end_effector).second)
      throw InvalidPlanarTask(contact + ".end_effector", "must not be in contact twice in a phase",
                              text(task.robot.end_effectors[phase.contacts[i].end_effector].name));
    for (std::size_t other = 0; other < i; ++other)
      require_reachable(task, phase.contacts[other], phase.contacts[i], contact);
  }
}

void require_duration(const PlanarPhase& phase, const std::string& field) {
  if (phase.max_duration < phase.min_duration)
    throw InvalidPlanarTask(field + ".max_duration", "must be positive and not below min_duration",
                            text(phase.min_duration) + " to " + text(phase.max_duration));
}

/// Whether a contact of a phase stands as it did in the phase before.
bool shares_contact(const PlanarPhase& before, const PlanarPhase& phase) {
  return std::any_of(phase.contacts.begin(), phase.contacts.end(), [&](const PlanarContact& contact) {
    return std::any_of(before.contacts.begin(), before.contacts.end(),
                       [&](const PlanarContact& other) { return model::equal(contact, other); });
  });
}

}  // namespace

Vector2d PlanarSurface::tangent_W() const { return {std::cos(angle), std::sin(angle)}; }

Vector2d PlanarSurface::normal_W() const { return {-std::sin(angle), std::cos(angle)}; }

int PlanarTask::interval_count() const { return first_interval(static_cast<int>(phases.size())); }

int PlanarTask::first_interval(int phase) const {
  int first = 0;
  for (int k = 0; k < phase; ++k) first += phases[k].intervals;
  return first;
}

int PlanarTask::phase_of(int interval) const {
  int phase = 0;
  for (int end = phases[0].intervals; interval >= end && phase + 1 < static_cast<int>(phases.size());)
    end += phases[++phase].intervals;
  return phase;
}

bool PlanarTask::keeps_clear(int end_effector, int surface) const {
  return std::none_of(no_clearance.begin(), no_clearance.end(), [&](const PlanarNoClearance& pair) {
    return pair.end_effector == end_effector && pair.surface == surface;
  });
}

void PlanarTask::validate() const {
  robot.validate();
  model::Findings found;
  model::check_struct(*this, model::Place(), found);
  model::relations(*this, found);
  found.raise<InvalidPlanarTask>();
}

void model::relations(const PlanarTask& task, Findings& found, const InTheFile& in_the_file) {
  const auto check = [&](const auto& each) {
    try {
      each();
      return true;
    } catch (const InvalidPlanarTask& wrong) {
      found.add(in_the_file ? in_the_file(wrong) : wrong);
      return false;
    }
  };
  std::set<std::string> names;
  for (std::size_t i = 0; i < task.surfaces.size(); ++i) {
    const PlanarSurface& surface = task.surfaces[i];
    const std::string field = indexed("surfaces", i);
    found.check({field + ".name"}, [&] {
      if (!names.insert(surface.name).second)
        throw InvalidPlanarTask(field + ".name", "must be unique", text(surface.name));
    });
    if (found.sound(field + ".extent") && found.sound(field + ".from") && found.sound(field + ".to"))
      check([&] { require_extent(surface, field); });
  }
  if (!found.sound("surfaces") || !found.sound("robot")) return;  // contacts lie on surfaces
  if (found.sound("no_clearance"))
    for (std::size_t i = 0; i < task.no_clearance.size(); ++i) check([&] { validate_no_clearance(task, i); });
  bool before_sound = false;
  for (std::size_t k = 0; k < task.phases.size(); ++k) {
    const std::string field = indexed("phases", k);
    const PlanarPhase& phase = task.phases[k];
    if (!found.sound(field)) {
      before_sound = false;
      continue;
    }
    check([&] { require_duration(phase, field); });
    for (std::size_t i = 0; i < phase.clearances.size(); ++i)
      check([&] {
        const std::string clearance = indexed(field + ".clearances", i);
        validate_clearance(task, phase, phase.clearances[i], clearance);
        if (found.sound("no_clearance")) require_asked(task, phase.clearances[i], clearance);
      });
    for (std::size_t i = 0; i < phase.poses.size(); ++i)
      check([&] { validate_pose(task, phase.poses[i], indexed(field + ".poses", i)); });
    // What was said of a contact in the phase before need not be said again.
    const bool said = k > 0 && !before_sound && shares_contact(task.phases[k - 1], phase);
    const bool sound = !said && check([&] { validate_contacts(task, phase, field); });
    // Nothing jumps: at the instant between two phases the contacts of both hold.
    if (sound && before_sound)
      check([&] {
        for (std::size_t i = 0; i < phase.contacts.size(); ++i)
          for (const PlanarContact& before : task.phases[k - 1].contacts)
            require_reachable(task, before, phase.contacts[i], indexed(field + ".contacts", i));
      });
    before_sound = sound;
  }
}

}  // namespace mcplan
