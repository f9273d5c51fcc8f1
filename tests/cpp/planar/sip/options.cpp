#include "mcplan/planar/sip/options.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "mcplan/base/error.hpp"

using mcplan::sip::Options;

namespace {

std::string field(const std::function<void(Options&)>& mutate) {
  Options options;
  mutate(options);
  try {
    options.validate();
  } catch (const mcplan::InvalidOptions& error) {
    return error.field();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("the default options are valid, and so are their edges") {
  CHECK(field([](Options&) {}) == "accepted");
  CHECK(field([](Options& o) {
          o.torque_weight = o.duration_weight = o.jerk_weight = 0.0;
          o.order = 3;
          o.neq = 3;
          o.grid_points = 2;
          o.margin = 0.0;
          o.phase_duration_s = {1.0, 1.0};
          o.max_iterations = 1;
        }) == "accepted");
  CHECK(field([](Options& o) { o.order = 12; }) == "accepted");
  CHECK(field([](Options& o) { o.clearance_m = 0.05; }) == "accepted");
}

TEST_CASE("each field out of its range is named") {
  for (double bad : {-1.0, static_cast<double>(INFINITY), static_cast<double>(NAN)}) {
    CAPTURE(bad);
    CHECK(field([bad](Options& o) { o.torque_weight = bad; }) == "torque_weight");
    CHECK(field([bad](Options& o) { o.duration_weight = bad; }) == "duration_weight");
    CHECK(field([bad](Options& o) { o.jerk_weight = bad; }) == "jerk_weight");
    CHECK(field([bad](Options& o) { o.tube_m = bad; }) == "tube_m");
    CHECK(field([bad](Options& o) { o.tube_rad = bad; }) == "tube_rad");
    CHECK(field([bad](Options& o) { o.min_normal_force = bad; }) == "min_normal_force");
    CHECK(field([bad](Options& o) { o.margin = bad; }) == "margin");
    CHECK(field([bad](Options& o) { o.log_weight_max = bad; }) == "log_weight_max");
    CHECK(field([bad](Options& o) { o.tolerance = bad; }) == "tolerance");
    CHECK(field([bad](Options& o) { o.constraint_tolerance = bad; }) == "constraint_tolerance");
    CHECK(field([bad](Options& o) { o.phase_duration_s.min = bad; }) == "phase_duration_s");
    CHECK(field([bad](Options& o) { o.phase_duration_s.max = bad; }) == "phase_duration_s");
    CHECK(field([bad](Options& o) { o.total_duration_s.min = bad; }) == "total_duration_s");
    CHECK(field([bad](Options& o) { o.total_duration_s.max = bad; }) == "total_duration_s");
  }
  for (double bad : {0.0, -1.0, static_cast<double>(NAN)})
    CHECK(field([bad](Options& o) { o.time_limit_s = bad; }) == "time_limit_s");
  CHECK(field([](Options& o) { o.tube_m = 0.0; }) == "tube_m");
  CHECK(field([](Options& o) { o.tube_rad = 0.0; }) == "tube_rad");
  CHECK(field([](Options& o) { o.log_weight_max = 0.0; }) == "log_weight_max");
  CHECK(field([](Options& o) { o.margin = 0.5; }) == "margin");
  CHECK(field([](Options& o) { o.clearance_m = INFINITY; }) == "clearance_m");
  CHECK(field([](Options& o) { o.phase_duration_s = {2.0, 1.0}; }) == "phase_duration_s");
  CHECK(field([](Options& o) { o.total_duration_s = {0.0, 1.0}; }) == "total_duration_s");
  for (int bad : {-1, 0, 2, 13}) CHECK(field([bad](Options& o) { o.order = bad; }) == "order");
  CHECK(field([](Options& o) { o.neq = -1; }) == "neq");
  CHECK(field([](Options& o) { o.neq = o.order + 1; }) == "neq");
  CHECK(field([](Options& o) { o.grid_points = 1; }) == "grid_points");
  CHECK(field([](Options& o) { o.grid_points = 1001; }) == "grid_points");
  CHECK(field([](Options& o) { o.max_iterations = 0; }) == "max_iterations");
}

TEST_CASE("there is a cost where a weight is not zero") {
  Options options;
  CHECK(options.has_cost());
  options.torque_weight = 0.0;
  CHECK(!options.has_cost());
  options.duration_weight = 0.1;
  CHECK(options.has_cost());
  options.duration_weight = 0.0;
  options.jerk_weight = 0.1;
  CHECK(options.has_cost());
}
