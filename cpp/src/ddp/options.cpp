#include "mcplan/ddp/options.hpp"

#include "ddp/cost_terms.hpp"
#include "mcplan/base/error.hpp"
#include "model/read.hpp"
#include "options_fields.hpp"

namespace mcplan::ddp {
namespace {

void require_own_weight(const std::string& name) {
  std::string names;
  for (const CostTerm* term : cost_terms()) {
    if (!term->has_own_weight()) continue;
    if (term->name() == name) return;
    names += (names.empty() ? "" : ", ") + std::string(term->name());
  }
  throw InvalidOptions("weights." + name, "must be the weight of one term: " + names, name);
}

/// Options that the published algorithm does not have: at their default, or at the value that says so. Its model is
/// lipm, with the three base axes and all end-effectors, whatever Options::model says.
void require_of_paper(const Options& options, model::Findings& found) {
  const Options usual;
  const auto require = [&](const char* name, bool fits, const std::string& shown) {
    if (!fits) found.add(name, "must be left at its default: Method::paper does not have it", shown);
  };
  const auto number = [&](const char* name, auto value, auto unset, auto off) {
    require(name, value == unset || value == off, text(value));
  };
  number("restarts", options.restarts, usual.restarts, 0);
  number("interior_points", options.interior_points, usual.interior_points, 0);
  number("friction_sides", options.friction_sides, usual.friction_sides, 0);
  number("friction_ratio", options.friction_ratio, usual.friction_ratio, 1.0);
  number("load_ratio", options.load_ratio, usual.load_ratio, 0.0);
  number("reach_margin_m", options.reach_margin_m, usual.reach_margin_m, 0.0);
  number("sole_inside", options.sole_inside, usual.sole_inside, 0.0);
  const Weights &weights = options.weights, standard;
  const auto weight = [&](const char* name, double Weights::*member) {
    number(name, weights.*member, standard.*member, standard.*member);
  };
  weight("weights.angle", &Weights::angle);
  weight("weights.momentum", &Weights::momentum);
  weight("weights.center_of_pressure", &Weights::center_of_pressure);
  weight("weights.force_line", &Weights::force_line);
  number("weights.overshoot_factor", weights.overshoot_factor, standard.overshoot_factor, 1.0);
  for (const auto& [name, value] : weights.own) number(("weights." + name).c_str(), value, 0.0, 0.0);
}

/// What is wrong beyond the ranges of the fields.
void relations(const Options& options, model::Findings& found) {
  const auto& [min, max] = std::pair(options.duration_min_s, options.duration_max_s);
  if (found.sound("duration_min_s") && found.sound("duration_max_s") && max != 0.0 && max < min)
    found.add("duration_max_s", "must be 0 (the robot's) or at least duration_min_s (" + text(min) + ")", text(max));
  if (const int sides = options.friction_sides; sides != 0 && (sides < 3 || sides > 64))
    found.add("friction_sides", "must be 0 (the cone) or lie in [3, 64]", text(sides));
  const Weights& weights = options.weights;
  if (found.sound("weights.contact_min") && found.sound("weights.contact_max") &&
      weights.contact_max < weights.contact_min)
    found.add("weights.contact_max", "must be at least weights.contact_min (" + text(weights.contact_min) + ")",
              text(weights.contact_max));
  for (const auto& [name, weight] : weights.own)
    found.check({"weights." + name}, [&, &own = name] { require_own_weight(own); });
  if (options.method == Method::paper) require_of_paper(options, found);
}

}  // namespace

void Options::validate() const {
  model::Findings found;
  model::check_struct(*this, model::Place(), found);
  relations(*this, found);
  found.raise<InvalidOptions>();
}

}  // namespace mcplan::ddp
