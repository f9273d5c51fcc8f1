#pragma once

#include <string>

#include "mcplan/plan/report.hpp"

namespace mcplan {

/// Where a violation is and its amount: "reach at left_foot in phase 0 (t = 0 s): 0.021 m".
std::string excess_text(const Violation& violation);

}  // namespace mcplan
