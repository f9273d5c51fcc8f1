#pragma once

#include <string>

#include "mcplan/plan/plan.hpp"

namespace mcplan {

/// A plan that Plan::save() or Python wrote as JSON. Throws InvalidPlan with all that is wrong.
Plan load_plan(const std::string& path);

/// A plan as JSON, on one line for each knot and phase; numbers read back as the same doubles. Throws InvalidPlan when
/// sizes do not fit together, or it is too large to be read again.
std::string plan_to_json(const Plan& plan);

/// The plan of a JSON text. Throws InvalidPlan.
Plan plan_from_json(const std::string& text);

/// Whether two plans are the same, number by number, their scenes and robots too.
bool operator==(const Plan& a, const Plan& b);
inline bool operator!=(const Plan& a, const Plan& b) { return !(a == b); }

}  // namespace mcplan
