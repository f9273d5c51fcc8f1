#pragma once

#include <Eigen/Core>
#include <random>
#include <utility>
#include <variant>

#include "mcplan/plan/plan_files.hpp"
#include "point_fixtures.hpp"
#include "wrench_fixtures.hpp"

/// A plan of each force law: one that has none does not compile.
namespace fixtures {

inline mcplan::Plan plan_under(mcplan::laws::Pendulum /*law*/) { return walk(); }

inline mcplan::Plan plan_under(mcplan::laws::Wrench /*law*/) { return wrench_walk(); }

inline mcplan::Plan plan_under(mcplan::laws::Linear /*law*/) {
  mcplan::Plan plan = step_on_corners();
  plan.phases.resize(2);
  plan.knots.resize(3);
  plan.final_contacts = {ground, ground, -1, -1};
  mcplan::choose_swings(plan);
  return plan;
}

/// The last phase of the step.
inline mcplan::Plan plan_under(mcplan::laws::Held /*law*/) {
  mcplan::Plan plan = step_on_corners();
  plan.phases.erase(plan.phases.begin(), plan.phases.begin() + 2);
  plan.knots.erase(plan.knots.begin(), plan.knots.begin() + 2);
  plan.measured_start = true;
  mcplan::choose_swings(plan);
  return plan;
}

/// use(law) for each law that there is.
template <class Use, std::size_t... I>
void for_each_law(const Use& use, std::index_sequence<I...>) {
  (use(std::variant_alternative_t<I, mcplan::ForceLaw>()), ...);
}
template <class Use>
void for_each_law(const Use& use) {
  for_each_law(use, std::make_index_sequence<std::variant_size_v<mcplan::ForceLaw>>());
}

}  // namespace fixtures
