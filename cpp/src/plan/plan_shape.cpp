#include "plan_shape.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "mcplan/base/error.hpp"

namespace mcplan {
namespace {

constexpr const char* kEach = "one per end-effector";

std::string indexed(const char* list, std::size_t i) { return list + ("[" + std::to_string(i) + "]"); }

void require_count(const std::string& field, std::size_t count, std::size_t expected, const char* what) {
  if (count != expected)
    throw InvalidPlan(field, "must be " + std::string(what) + " (" + std::to_string(expected) + ")",
                      std::to_string(count));
}

void require_surface(const std::string& field, int surface, std::size_t surfaces) {
  if (surface < -1 || surface >= static_cast<int>(surfaces))
    throw InvalidPlan(field, "must be -1 or the index of a surface (below " + std::to_string(surfaces) + ")",
                      text(surface));
}

void require_swing(const Plan& plan, std::size_t i, std::size_t end_effectors, std::size_t phases) {
  const Swing& swing = plan.swings[i];
  if (swing.end_effector < 0 || swing.end_effector >= static_cast<int>(end_effectors) || swing.first_phase < 0 ||
      swing.end_phase <= swing.first_phase || swing.end_phase > static_cast<int>(phases))
    throw InvalidPlan(indexed("swings", i), "must name an end-effector and a range of phases",
                      "end-effector " + text(swing.end_effector) + ", phases " + text(swing.first_phase) + " to " +
                          text(swing.end_phase));
}

void require_knot(const Plan& plan, int k, std::size_t end_effectors) {
  const Knot& knot = plan.knots[k];
  if (knot.end_effectors_W.size() == end_effectors && knot.end_effector_velocities_W.size() == end_effectors) return;
  require_count(indexed("knots", k) + ".end_effectors", knot.end_effectors_W.size(), end_effectors, kEach);
  require_count(indexed("knots", k) + ".end_effector_velocities", knot.end_effector_velocities_W.size(), end_effectors,
                kEach);
}

}  // namespace

void require_queryable(const Plan& plan, int k, double since_start) {
  const int n = static_cast<int>(plan.phases.size());
  if (n == 0) throw InvalidPlan("phases", "needs at least one phase", "none");
  if (k < 0 || k >= n) throw InvalidInput("phase", "must lie in [0, " + text(n - 1) + "]", text(k));
  if (plan.knots.size() != plan.phases.size() + 1)
    throw InvalidPlan("knots", "must be one more than the phases (" + text(n + 1) + ")",
                      std::to_string(plan.knots.size()));
  const Phase& phase = plan.phases[k];
  const std::size_t end_effectors = plan.robot.end_effectors.size();
  if (phase.contacts.size() != end_effectors)
    require_count(indexed("phases", k) + ".contacts", phase.contacts.size(), end_effectors, kEach);
  require_knot(plan, k, end_effectors);
  require_knot(plan, k + 1, end_effectors);
  if (!(phase.duration > 0.0 && std::isfinite(phase.duration)))
    throw InvalidPlan(indexed("phases", k) + ".duration", "must be a positive number", text(phase.duration));
  constexpr double kRounding = 1e-9;
  if (!(since_start >= -kRounding && since_start <= phase.duration + kRounding))
    throw InvalidInput("since_start", "must lie in [0, " + text(phase.duration) + "] s", text(since_start));
  std::visit([&](auto law) { law.require_queryable(phase, k); }, phase.law);
  for (std::size_t i = 0; i < plan.swings.size(); ++i) {
    const Swing& swing = plan.swings[i];
    if (k < swing.first_phase || k >= swing.end_phase) continue;
    if (swing.first_phase < 0 || swing.end_phase > n)
      throw InvalidPlan("swings[" + std::to_string(i) + "]", "must be a range of phases (0 to " + text(n) + ")",
                        text(swing.first_phase) + " to " + text(swing.end_phase));
    if (swing.end_effector < 0 || swing.end_effector >= static_cast<int>(end_effectors))
      throw InvalidPlan("swings[" + std::to_string(i) + "].end_effector",
                        "must be the index of an end-effector (below " + std::to_string(end_effectors) + ")",
                        text(swing.end_effector));
    // Both ends, between which the box of reach is widened.
    require_knot(plan, swing.first_phase, end_effectors);
    require_knot(plan, swing.end_phase, end_effectors);
  }
}

void require_shape(const Plan& plan, std::size_t surfaces, bool with_swings) {
  const std::size_t n = plan.phases.size(), end_effectors = plan.robot.end_effectors.size();
  if (n == 0) throw InvalidPlan("phases", "needs at least one phase", "none");
  require_count("knots", plan.knots.size(), n + 1, "one more than the phases");
  for (std::size_t k = 0; k <= n; ++k) require_knot(plan, static_cast<int>(k), end_effectors);
  for (std::size_t k = 0; k < n; ++k) {
    const std::vector<Contact>& contacts = plan.phases[k].contacts;
    const bool fits =
        contacts.size() == end_effectors && std::all_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
          return c.surface >= -1 && c.surface < static_cast<int>(surfaces);
        });
    if (fits) continue;  // names of fields take longer than all the rest
    const std::string field = indexed("phases", k) + ".contacts";
    require_count(field, contacts.size(), end_effectors, kEach);
    for (const Contact& contact : contacts) require_surface(field, contact.surface, surfaces);
  }
  require_count("final_contacts", plan.final_contacts.size(), end_effectors, kEach);
  for (int surface : plan.final_contacts) require_surface("final_contacts", surface, surfaces);
  for (std::size_t i = 0; with_swings && i < plan.swings.size(); ++i) require_swing(plan, i, end_effectors, n);
}

int samples_of(const Phase& phase, double sample_s) {
  if (!(phase.duration > 0.0 && std::isfinite(phase.duration))) return 0;
  constexpr double kMax = 1e7;
  const double samples = std::ceil(phase.duration / sample_s);
  if (!(sample_s > 0.0 && samples <= kMax))
    throw InvalidInput("sample_s", "must be positive and cut a phase into at most 1e7 samples", text(sample_s));
  return std::max(1, static_cast<int>(samples));
}

void require_start_slack(const Plan& plan) {
  const double slack_s = plan.start_slack_s;
  if (!(std::isfinite(slack_s) && slack_s >= 0.0))
    throw InvalidPlan("start_slack_s", "must lie in [0, inf) s", text(slack_s));
  if (slack_s > 0.0 && !plan.measured_start)
    throw InvalidPlan("start_slack_s", "must be 0 without measured_start", text(slack_s));
}

}  // namespace mcplan
