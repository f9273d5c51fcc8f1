#pragma once

#include <string>

#include "mcplan/planar/plan.hpp"

namespace mcplan {

/// A planar plan that PlanarPlan::save() or Python wrote as JSON. Throws InvalidPlan with all that is wrong.
PlanarPlan load_planar_plan(const std::string& path);

/// A planar plan as JSON; numbers read back as the same doubles. Throws InvalidPlan, InvalidPlanarTask and InvalidRobot
/// when it is not valid, and InvalidPlan where it is too large to be read again.
std::string planar_plan_to_json(const PlanarPlan& plan);

/// The planar plan of a JSON text. Throws InvalidPlan.
PlanarPlan planar_plan_from_json(const std::string& text);

/// Whether two planar plans are the same, number by number, their tasks too.
bool operator==(const PlanarPlan& a, const PlanarPlan& b);
inline bool operator!=(const PlanarPlan& a, const PlanarPlan& b) { return !(a == b); }

}  // namespace mcplan
