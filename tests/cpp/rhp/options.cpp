#include "mcplan/rhp/options.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "mcplan/base/error.hpp"

namespace mcplan::rhp::tests {

TEST_CASE("options out of their range are refused by the name of their field") {
  CHECK_NOTHROW(Options().validate());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<std::string, std::function<void(Options&)>>> wrong = {
      {"lookahead", [](Options& o) { o.lookahead = 0; }},
      {"lookahead", [](Options& o) { o.lookahead = 11; }},
      {"cycles", [](Options& o) { o.cycles = 0; }},
      {"intervals", [](Options& o) { o.intervals = 1; }},
      {"double_support_s",
       [](Options& o) {
         o.double_support_s = {0.3, 0.1};
       }},
      {"single_support_s",
       [](Options& o) {
         o.single_support_s = {0.0, 0.1};
       }},
      {"com_height",
       [&](Options& o) {
         o.com_height = {nan, 1.0};
       }},
      {"landing_s", [](Options& o) { o.landing_s = -0.1; }},
      {"predicted_double_support_s", [](Options& o) { o.predicted_double_support_s = 0.0; }},
      {"predicted_single_support_s", [&](Options& o) { o.predicted_single_support_s = nan; }},
      {"com_velocity_max", [](Options& o) { o.com_velocity_max = -1.0; }},
      {"momentum_max", [](Options& o) { o.momentum_max = 0.0; }},
      {"momentum_rate_max", [](Options& o) { o.momentum_rate_max = 0.0; }},
      {"foothold_margin_m", [](Options& o) { o.foothold_margin_m = -0.01; }},
      {"sole_ratio", [](Options& o) { o.sole_ratio = 0.0; }},
      {"sole_ratio", [](Options& o) { o.sole_ratio = 1.01; }},
      {"sole_ratio", [&](Options& o) { o.sole_ratio = nan; }},
      {"friction_ratio", [](Options& o) { o.friction_ratio = 0.0; }},
      {"friction_ratio", [](Options& o) { o.friction_ratio = 1.01; }},
      {"psi_max", [](Options& o) { o.psi_max = 0.0; }},
      {"goal_weight", [](Options& o) { o.goal_weight = -1.0; }},
      {"friction_sides", [](Options& o) { o.friction_sides = 2; }},
      {"tolerance", [](Options& o) { o.tolerance = 0.0; }},
      {"constraint_tolerance", [&](Options& o) { o.constraint_tolerance = nan; }},
      {"max_iterations", [](Options& o) { o.max_iterations = 0; }},
      {"time_limit_s", [](Options& o) { o.time_limit_s = 0.0; }},
      {"time_limit_s", [&](Options& o) { o.time_limit_s = nan; }}};
  for (const auto& [name, spoil] : wrong) {
    const std::string& field = name;  // Clang's lambdas, as CAPTURE makes one, hold no structured bindings
    CAPTURE(field);
    Options options;
    spoil(options);
    std::string named;
    try {
      options.validate();
    } catch (const InvalidOptions& error) {
      named = error.field();
    }
    CHECK(named == field);
  }
}

}  // namespace mcplan::rhp::tests
