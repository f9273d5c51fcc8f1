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
}

}  // namespace

void Options::validate() const {
  model::Findings found;
  model::check_struct(*this, model::Place(), found);
  relations(*this, found);
  found.raise<InvalidOptions>();
}

}  // namespace mcplan::ddp
