#include "mcplan/plan/report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "report_text.hpp"

namespace mcplan {
namespace {

/// Amounts between these are written without a prefix: 0.0278 m, not 27.8 mm.
constexpr double kPlainMin = 1e-3, kPlainMax = 1e3;

struct Prefix {
  const char* letters;
  double factor;
};

/// The prefix with which an amount in this unit is written with few digits before the point: 431 kN, 0.43 mm, 21 um.
/// Robots of millimetres and of hundreds of tonnes have amounts that say nothing in metres and newtons.
Prefix prefix_of(double amount, const std::string& unit) {
  constexpr Prefix none{"", 1.0};
  constexpr std::array<Prefix, 7> prefixes{
      {{"G", 1e9}, {"M", 1e6}, {"k", 1e3}, {"", 1.0}, {"m", 1e-3}, {"u", 1e-6}, {"n", 1e-9}}};
  constexpr std::array<const char*, 7> prefixable{"m", "m/s", "N", "N m", "s", "rad", "rad/s"};
  const bool plain = amount >= kPlainMin && amount < kPlainMax;
  if (plain || std::find(prefixable.begin(), prefixable.end(), unit) == prefixable.end()) return none;
  const double min_shown = amount < kPlainMin ? 0.1 : 1.0;
  for (const Prefix& p : prefixes)
    if (amount >= min_shown * p.factor && amount < 1e3 * min_shown * p.factor) return p;
  return none;
}

/// "over the limit (tolerance 5 mm)": in the amount's prefix where that suits the tolerance, else in its own; the unit
/// is said where there is a prefix.
void write_tolerance(std::ostringstream& out, double tolerance, Prefix prefix, const std::string& unit) {
  const double shared = tolerance / prefix.factor;
  if (shared != 0.0 && !(shared >= kPlainMin && shared < kPlainMax)) {
    const bool told = prefix.factor != 1.0;
    prefix = prefix_of(tolerance, unit);
    out << tolerance / prefix.factor;
    if (told || prefix.factor != 1.0) out << " " << prefix.letters << unit;
    return;
  }
  out << shared;
  if (shared != 0.0 && prefix.factor != 1.0) out << " " << prefix.letters << unit;
}

void write_place(std::ostringstream& out, const Violation& v) {
  out << v.name;
  if (!v.end_effector.empty()) out << " at " << v.end_effector;
  if (v.phase >= 0) out << " in phase " << v.phase << " (t = " << v.time_s << " s)";
  if (!v.surface.empty()) out << " in the solid of '" << v.surface << "'";
  out << ": ";
}

/// Returns the prefix of the unit.
Prefix write_amount(std::ostringstream& out, const Violation& v) {
  const double amount = std::abs(v.value);
  const Prefix prefix = prefix_of(amount, v.unit);
  out << amount / prefix.factor;
  if (!v.unit.empty() && v.unit != "-") out << " " << prefix.letters << v.unit;
  return prefix;
}

}  // namespace

std::string excess_text(const Violation& violation) {
  std::ostringstream out;
  out.precision(3);
  write_place(out, violation);
  write_amount(out, violation);
  return out.str();
}

std::string Violation::to_string() const {
  std::ostringstream out;
  out.precision(3);
  write_place(out, *this);
  if (value == 0.0) {
    out << "at the limit";
    return out.str();
  }
  const Prefix prefix = write_amount(out, *this);
  if (value < 0.0) {
    out << " below the limit";
    return out.str();
  }
  out << (value > tolerance ? " over the limit (tolerance " : ", within tolerance (");
  write_tolerance(out, tolerance, prefix, unit);
  out << ")";
  return out.str();
}

}  // namespace mcplan
