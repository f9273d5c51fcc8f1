#pragma once

#include <Eigen/Core>
#include <cmath>
#include <random>
#include <string>

#include "rhp/horizon.hpp"

/// A start as in the experiments of Wang et al.: every variable uniform between its bounds. Those that have none here
/// are drawn from the paper's boxes (CoM and footholds up to `far_m` ahead), accelerations within 10 m/s^2, forces up
/// to 100 N along each direction of their variables.
inline Eigen::VectorXd random_start(const mcplan::rhp::Horizon& horizon, unsigned seed, double far_m = 30.0) {
  std::mt19937 engine(seed);
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); };
  const mcplan::nlp::Problem& problem = horizon.problem;
  Eigen::VectorXd x(problem.variable_count());
  for (int i = 0; i < x.size(); ++i) {
    const double low = problem.variable_lower()[i], high = problem.variable_upper()[i];
    const std::string name = problem.variable_name(i);  // "com[1] at stage 7"
    const char axis = name[name.find('[') + 1];
    if (std::isfinite(low) && std::isfinite(high))
      x[i] = in(low, high);
    else if (name.rfind("com", 0) == 0)
      x[i] = axis == '0' ? in(0.0, far_m) - horizon.shift_W.x() : axis == '1' ? in(-1.0, 1.0) : in(0.7, 0.8);
    else if (name.rfind("foothold", 0) == 0)
      x[i] = axis == '0' ? in(-1.0, far_m) : in(-1.0, 1.0);
    else if (name.rfind("force", 0) == 0)
      x[i] = in(0.0, 1.0);
    else
      x[i] = in(-10.0, 10.0);
  }
  return x;
}
