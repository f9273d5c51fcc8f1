#include "stances.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "model/text.hpp"

namespace mcplan::planar {
namespace {

using Eigen::Vector2d;
using model::PlanarContactKeys;
using model::PlanarPhaseKeys;

constexpr double full_turn = 2.0 * M_PI;

/// Products are rounded before they are added, whatever the instruction set: plans are the same everywhere.
Vector2d point_on(const PlanarSurface& surface, double at) {
  const volatile double along_x = at * std::cos(surface.angle), along_y = at * std::sin(surface.angle);
  return {surface.origin_W.x() + along_x, surface.origin_W.y() + along_y};
}

double turned_by(const PlanarSurface& surface, int turns) {
  const volatile double angle = full_turn * turns;
  return surface.angle + angle;
}

/// To twelve digits after the point.
double rounded(double value) {
  char text[400];
  std::snprintf(text, sizeof text, "%.12f", value);
  return std::strtod(text, nullptr);
}

std::string phase_field(std::size_t k) { return "phases[" + std::to_string(k) + "]"; }

std::string item_of(const std::string& list, std::size_t i) { return list + "[" + std::to_string(i) + "]"; }

/// The number in brackets after a word of a field, or -1.
int index_after(const std::string& field, const std::string& word) {
  const std::size_t at = field.find(word + "[");
  return at == field.npos ? -1 : std::atoi(field.c_str() + at + word.size() + 1);
}

}  // namespace

std::vector<PlanarContact> Stances::next(const PlanarPhaseKeys& keys) {
  const std::string field = phase_field(phases_.size());
  bool right = found_.sound(field);
  if (right && !keys.contacts.empty()) {
    current_.clear();
    is_known_ = true;
    const std::string alone = "may not stand beside contacts, which say it all";
    if (!keys.lift.empty()) right = wrong(field + ".lift", alone);
    if (!keys.place.empty()) right = wrong(field + ".place", alone);
    right = place(keys.contacts, field + ".contacts", false) && right;
  } else if (right) {
    right = change(keys, field);
  }
  if (!right) found_.lacks(field);
  is_known_ = right;
  phases_.emplace_back();
  std::vector<PlanarContact> out;
  if (!right) return out;
  for (const auto& [end, written] : current_) {
    phases_.back().push_back(written);
    out.push_back(written.contact);
  }
  return out;
}

bool Stances::change(const PlanarPhaseKeys& keys, const std::string& field) {
  const bool first = phases_.empty();
  if (keys.lift.empty() && keys.place.empty())
    return wrong(field + ".contacts", std::string("is required") + (first ? "" : ", or lift or place"));
  if (first) return wrong(field + ".contacts", "is required of the first phase");
  if (!is_known_) return false;
  bool right = true;
  for (std::size_t i = 0; i < keys.lift.size(); ++i) right = lift(keys.lift[i], item_of(field + ".lift", i)) && right;
  right = place(keys.place, field + ".place", true) && right;
  if (right && current_.empty()) return wrong(field + ".lift", "must leave one contact at least");
  return right;
}

bool Stances::lift(int end_effector, const std::string& field) {
  if (current_.erase(end_effector) > 0) return true;
  return wrong(field, "must be in contact in the phase before",
               model::shown(task_.robot.end_effectors[static_cast<std::size_t>(end_effector)].name));
}

bool Stances::place(const std::vector<model::InFile<PlanarContact>>& contacts, const std::string& field, bool is_new) {
  bool right = true;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    Written written{contacts[i].value, item_of(field, i), contacts[i].keys.at.has_value()};
    if (!work_out(contacts[i], written.where, written.contact)) {
      right = false;
      continue;
    }
    const int end = written.contact.end_effector;
    const std::string rule = std::string("is in contact already") + (is_new ? ": lift it first" : "");
    if (current_.count(end) > 0)
      right = wrong(written.where + ".end_effector", rule,
                    model::shown(task_.robot.end_effectors[static_cast<std::size_t>(end)].name));
    current_.insert_or_assign(end, written);
  }
  return right;
}

bool Stances::work_out(const model::InFile<PlanarContact>& entry, const std::string& field, PlanarContact& out) {
  const PlanarContactKeys& keys = entry.keys;
  bool right = true;
  if (keys.at.has_value() == keys.position.has_value())
    right = wrong(field + ".at", keys.at ? "may not stand beside position" : "is required, or position");
  if (keys.turns && keys.angle) right = wrong(field + ".turns", "may not stand beside angle");
  if (!right) return false;
  const PlanarSurface& surface = task_.surfaces[static_cast<std::size_t>(entry.value.surface)];
  out.position_W = keys.position ? *keys.position : point_on(surface, *keys.at);
  out.angle = keys.angle ? *keys.angle : turned_by(surface, keys.turns.value_or(0));
  return true;
}

bool Stances::wrong(const std::string& field, const std::string& rule, const std::string& value) {
  found_.add(field, rule, value);
  return false;
}

InvalidPlanarTask Stances::located(const InvalidPlanarTask& found) const {
  const int k = index_after(found.field(), "phases"), i = index_after(found.field(), ".contacts");
  const auto phase = static_cast<std::size_t>(k), contact = static_cast<std::size_t>(i);
  if (k < 0 || i < 0 || phase >= phases_.size() || contact >= phases_[phase].size()) return found;
  const Written& written = phases_[phase][contact];
  const auto end = static_cast<std::size_t>(written.contact.end_effector);
  if (written.where.rfind(phase_field(phase) + ".", 0) != 0)
    return {phase_field(phase) + ".place", task_.robot.end_effectors[end].name + " " + found.rule(), found.value()};
  std::string attribute = found.field().substr(found.field().rfind('.') + 1);
  if (written.by_at && attribute == "position") attribute = "at";
  return {written.where + "." + attribute, found.rule(), found.value()};
}

PlanarContactKeys contact_keys(const PlanarContact& contact, const PlanarSurface& surface) {
  PlanarContactKeys keys;
  const auto is_at = [&](double at) { return point_on(surface, at) == contact.position_W; };
  const double at = surface.tangent_W().dot(contact.position_W - surface.origin_W);
  if (is_at(rounded(at)))
    keys.at = rounded(at);
  else if (is_at(at))
    keys.at = at;
  else
    keys.position = contact.position_W;
  const double turns = std::nearbyint((contact.angle - surface.angle) / full_turn);
  if (!(std::abs(turns) <= 1000.0) || turned_by(surface, static_cast<int>(turns)) != contact.angle)
    keys.angle = contact.angle;
  else if (turns != 0.0)
    keys.turns = static_cast<int>(turns);
  return keys;
}

}  // namespace mcplan::planar
