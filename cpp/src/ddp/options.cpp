#include "mcplan/ddp/options.hpp"

#include <cmath>

#include "mcplan/base/error.hpp"
#include "mcplan/ddp/cost_terms.hpp"

namespace mcplan::ddp {
namespace {

void require_at_least(const char* field, int value, int least) {
  if (value < least) throw InvalidOptions(field, "must be at least " + text(least), text(value));
}

void require_positive(const char* field, double value) {
  if (!(std::isfinite(value) && value > 0.0)) throw InvalidOptions(field, "must be a positive number", text(value));
}

void require_weight(const char* field, double value) {
  if (!(std::isfinite(value) && value >= 0.0)) throw InvalidOptions(field, "must be a number >= 0", text(value));
}

void require_own_weight(const std::string& name) {
  std::string names;
  for (const CostTerm* term : cost_terms()) {
    if (!term->has_own_weight()) continue;
    if (term->name() == name) return;
    names += (names.empty() ? "" : ", ") + std::string(term->name());
  }
  throw InvalidOptions("weights." + name, "must be the weight of one term: " + names, name);
}

}  // namespace

void Options::validate() const {
  require_at_least("phases", phases, 0);
  if (phases > 2000) throw InvalidOptions("phases", "must be 2000 at most", text(phases));
  if (!(std::isfinite(duration_min_s) && duration_min_s >= 0.0))
    throw InvalidOptions("duration_min_s", "must be at least 0 (0: the robot's)", text(duration_min_s));
  require_positive("flight_duration_min_s", flight_duration_min_s);
  if (!(std::isfinite(duration_initial_s) && duration_initial_s >= 0.0))
    throw InvalidOptions("duration_initial_s", "must be at least 0 (0: the middle of the box)",
                         text(duration_initial_s));
  if (!(std::isfinite(duration_max_s) && (duration_max_s == 0.0 || duration_max_s >= duration_min_s)))
    throw InvalidOptions("duration_max_s",
                         "must be 0 (the robot's) or at least duration_min_s (" + text(duration_min_s) + ")",
                         text(duration_max_s));
  require_positive("proximal_weight", proximal_weight);
  require_at_least("interior_points", interior_points, 0);
  if (interior_points > 20) throw InvalidOptions("interior_points", "must be 20 at most", text(interior_points));
  if (friction_sides != 0 && (friction_sides < 3 || friction_sides > 64))
    throw InvalidOptions("friction_sides", "must be 0 (the cone) or lie in [3, 64]", text(friction_sides));
  require_weight("reach_margin_m", reach_margin_m);
  if (!(sole_inside <= 2.0)) throw InvalidOptions("sole_inside", "must be 2 at most", text(sole_inside));
  require_at_least("restarts", restarts, 0);
  require_at_least("max_iterations", max_iterations, 1);
  if (!(time_limit_s > 0.0)) throw InvalidOptions("time_limit_s", "must be a positive number", text(time_limit_s));
  require_at_least("threads", threads, 1);
  if (threads > 256) throw InvalidOptions("threads", "must be 256 at most", text(threads));
  require_weight("weights.com", weights.com);
  require_weight("weights.com_end", weights.com_end);
  require_weight("weights.velocity", weights.velocity);
  require_weight("weights.velocity_end", weights.velocity_end);
  require_weight("weights.rotation", weights.rotation);
  require_weight("weights.rotation_end", weights.rotation_end);
  require_weight("weights.angle", weights.angle);
  require_weight("weights.momentum", weights.momentum);
  require_positive("weights.center_of_pressure", weights.center_of_pressure);
  require_positive("weights.force_line", weights.force_line);
  require_weight("weights.end_effector", weights.end_effector);
  require_weight("weights.end_effector_end", weights.end_effector_end);
  require_weight("weights.stride", weights.stride);
  require_weight("weights.stiffness", weights.stiffness);
  require_weight("weights.moment", weights.moment);
  require_weight("weights.limit", weights.limit);
  require_weight("weights.duration", weights.duration);
  require_positive("weights.contact_min", weights.contact_min);
  require_positive("weights.contact_max", weights.contact_max);
  if (weights.contact_max < weights.contact_min)
    throw InvalidOptions("weights.contact_max",
                         "must be at least weights.contact_min (" + text(weights.contact_min) + ")",
                         text(weights.contact_max));
  for (const auto& [name, weight] : weights.own) {
    require_own_weight(name);
    require_weight(("weights." + name).c_str(), weight);
  }
  if (!(weights.contact_growth > 1.0 && std::isfinite(weights.contact_growth)))
    throw InvalidOptions("weights.contact_growth", "must be above 1", text(weights.contact_growth));
  if (!(weights.overshoot_factor >= 1.0 && std::isfinite(weights.overshoot_factor)))
    throw InvalidOptions("weights.overshoot_factor", "must be at least 1", text(weights.overshoot_factor));
}

}  // namespace mcplan::ddp
