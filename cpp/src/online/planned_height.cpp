#include "mcplan/online/planned_height.hpp"

#include <algorithm>
#include <cmath>

namespace mcplan::online {

Knot with_planned_height(Knot measured, const Plan& plan, double t, double margin_m) {
  const PlanState planned = plan.at(std::clamp(t, 0.0, plan.duration()));
  const auto touches = [](const EndEffectorState& end) { return end.surface >= 0; };
  // In flight no controller leads it back to the planned height.
  if (std::none_of(planned.end_effectors.begin(), planned.end_effectors.end(), touches)) return measured;
  const double planned_rate = t > plan.duration() ? 0.0 : planned.com_velocity_W.z();
  const double off_m = measured.com_W.z() - planned.com_W.z();
  const double off_m_s = measured.com_velocity_W.z() - planned_rate;
  const double swing_s = std::sqrt(plan.robot.com_height / plan.scene.gravity);
  if (std::abs(off_m) < margin_m && std::abs(off_m + swing_s * off_m_s) < margin_m) {
    measured.com_W.z() = planned.com_W.z();
    measured.com_velocity_W.z() = planned_rate;
  }
  return measured;
}

}  // namespace mcplan::online
