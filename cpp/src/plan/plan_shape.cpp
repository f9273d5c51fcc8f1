#include "plan_shape.hpp"

#include <algorithm>
#include <cmath>

#include "mcplan/base/error.hpp"

namespace mcplan {
namespace {

std::string indexed(const char* list, std::size_t i) { return list + ("[" + std::to_string(i) + "]"); }

void require_count(const std::string& field, std::size_t count, std::size_t wanted, const char* what) {
  if (count != wanted)
    throw InvalidPlan(field, "must be " + std::string(what) + " (" + std::to_string(wanted) + ")",
                      std::to_string(count));
}

void require_surface(const std::string& field, int surface, std::size_t surfaces) {
  if (surface < -1 || surface >= static_cast<int>(surfaces))
    throw InvalidPlan(field, "must be -1 or the index of a surface (below " + std::to_string(surfaces) + ")",
                      text(surface));
}

void require_swing(const Swing& swing, const std::string& field, std::size_t ends, std::size_t phases) {
  if (swing.end_effector < 0 || swing.end_effector >= static_cast<int>(ends) || swing.first_phase < 0 ||
      swing.end_phase <= swing.first_phase || swing.end_phase > static_cast<int>(phases))
    throw InvalidPlan(field, "must name an end-effector and a range of phases",
                      "end-effector " + text(swing.end_effector) + ", phases " + text(swing.first_phase) + " to " +
                          text(swing.end_phase));
}

}  // namespace

void require_shape(const Plan& plan, std::size_t surfaces, bool with_swings) {
  const std::size_t n = plan.phases.size(), ends = plan.robot.end_effectors.size();
  const char* each = "one per end-effector";
  if (n == 0) throw InvalidPlan("phases", "needs at least one phase", "none");
  require_count("knots", plan.knots.size(), n + 1, "one more than the phases");
  for (std::size_t k = 0; k <= n; ++k) {
    require_count(indexed("knots", k) + ".end_effectors", plan.knots[k].end_effectors_W.size(), ends, each);
    require_count(indexed("knots", k) + ".end_effector_velocities", plan.knots[k].end_effector_velocities_W.size(),
                  ends, each);
  }
  for (std::size_t k = 0; k < n; ++k) {
    const std::string field = indexed("phases", k) + ".contacts";
    require_count(field, plan.phases[k].contacts.size(), ends, each);
    for (const Contact& contact : plan.phases[k].contacts) require_surface(field, contact.surface, surfaces);
  }
  require_count("final_contacts", plan.final_contacts.size(), ends, each);
  for (int surface : plan.final_contacts) require_surface("final_contacts", surface, surfaces);
  for (std::size_t i = 0; with_swings && i < plan.swings.size(); ++i)
    require_swing(plan.swings[i], indexed("swings", i), ends, n);
}

int samples_of(const Phase& phase, double sample_s) {
  if (!(phase.duration > 0.0 && std::isfinite(phase.duration))) return 0;
  constexpr double kMost = 1e7;
  const double samples = std::ceil(phase.duration / sample_s);
  if (!(sample_s > 0.0 && samples <= kMost))
    throw InvalidInput("sample_s", "must be positive and cut a phase into at most 1e7 samples", text(sample_s));
  return std::max(1, static_cast<int>(samples));
}

}  // namespace mcplan
