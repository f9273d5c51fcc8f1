#include "mcplan/plan/report.hpp"

#include <cmath>
#include <sstream>

namespace mcplan {

std::string Violation::to_string() const {
  std::ostringstream out;
  out << name;
  if (!end_effector.empty()) out << " at " << end_effector;
  if (phase >= 0) {
    out << " in phase " << phase << " (t = ";
    out.precision(3);
    out << time_s << " s)";
  }
  out.precision(3);
  out << ": " << std::abs(value) << (unit.empty() ? "" : " ") << unit;
  if (value >= 0.0)
    out << " over the limit (tolerance " << tolerance << ")";
  else
    out << " below the limit";
  return out.str();
}

}  // namespace mcplan
