#include "mcplan/rhp/walk.hpp"

#include <algorithm>
#include <cmath>

#include "mcplan/robot/standing.hpp"

namespace mcplan::rhp {

Walk walk(const Scene& scene, const Robot& robot, const Options& options) {
  require_standing(scene, robot);
  return RecedingHorizon(scene, robot, options).walk();
}

double Walk::distance_m() const {
  double total = 0.0;
  for (const Cycle& cycle : cycles) total += cycle.distance_m;
  return total;
}

double Walk::acc_per_m() const {
  double total = 0.0;
  for (const Cycle& cycle : cycles) total += cycle.acceleration_cost;
  return total / std::max(std::abs(distance_m()), 1e-9);
}

double Walk::momentum_per_m() const {
  double total = 0.0;
  for (const Cycle& cycle : cycles) total += cycle.momentum_cost;
  return total / std::max(std::abs(distance_m()), 1e-9);
}

double Walk::drift_com_m() const {
  double max_drift = 0.0;
  for (const Cycle& cycle : cycles) max_drift = std::max(max_drift, cycle.drift_com_m);
  return max_drift;
}

double Walk::drift_momentum() const {
  double max_drift = 0.0;
  for (const Cycle& cycle : cycles) max_drift = std::max(max_drift, cycle.drift_momentum);
  return max_drift;
}

}  // namespace mcplan::rhp
