#include "mcplan/ddp/options.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <string>

#include "mcplan/base/error.hpp"

namespace {

using mcplan::ddp::Options;
using mcplan::ddp::Weights;

/// Name of the field that is refused, or "accepted".
std::string refused(const std::function<void(Options&)>& change) {
  Options options;
  change(options);
  try {
    options.validate();
  } catch (const mcplan::InvalidOptions& error) {
    CHECK_FALSE(error.rule().empty());
    CHECK_FALSE(error.value().empty());
    return error.field();
  }
  return "accepted";
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("the defaults are accepted") {
  CHECK(refused([](Options&) {}) == "accepted");
}

TEST_CASE("counts are refused outside their range and accepted at its ends") {
  struct Count {
    int Options::*member;
    const char* name;
    int least, most;
  };
  const Count counts[] = {{&Options::phases, "phases", 0, 2000},
                          {&Options::interior_points, "interior_points", 0, 20},
                          {&Options::restarts, "restarts", 0, 1000000},
                          {&Options::max_iterations, "max_iterations", 1, 1000000},
                          {&Options::threads, "threads", 1, 256}};
  for (const Count& c : counts) {
    CHECK(refused([&](Options& o) { o.*c.member = c.least - 1; }) == c.name);
    CHECK(refused([&](Options& o) { o.*c.member = -1000; }) == c.name);
    CHECK(refused([&](Options& o) { o.*c.member = c.least; }) == "accepted");
    CHECK(refused([&](Options& o) { o.*c.member = c.most; }) == "accepted");
    if (c.most < 1000000) CHECK(refused([&](Options& o) { o.*c.member = c.most + 1; }) == c.name);
  }
}

TEST_CASE("every weight must be a number that is not negative") {
  struct Weight {
    double Weights::*member;
    const char* name;
  };
  const Weight weights[] = {{&Weights::com, "com"},
                            {&Weights::com_end, "com_end"},
                            {&Weights::velocity, "velocity"},
                            {&Weights::velocity_end, "velocity_end"},
                            {&Weights::rotation, "rotation"},
                            {&Weights::rotation_end, "rotation_end"},
                            {&Weights::angle, "angle"},
                            {&Weights::momentum, "momentum"},
                            {&Weights::end_effector, "end_effector"},
                            {&Weights::end_effector_end, "end_effector_end"},
                            {&Weights::stride, "stride"},
                            {&Weights::stiffness, "stiffness"},
                            {&Weights::moment, "moment"},
                            {&Weights::limit, "limit"},
                            {&Weights::duration, "duration"}};
  for (const Weight& w : weights) {
    for (double bad : {-1.0, kNan, kInf})
      CHECK(refused([&](Options& o) { o.weights.*w.member = bad; }) == std::string("weights.") + w.name);
    CHECK(refused([&](Options& o) { o.weights.*w.member = 0.0; }) == "accepted");
  }
  for (const char* name : {"flight", "contact_change"}) {
    for (double bad : {-1.0, kNan, kInf})
      CHECK(refused([&](Options& o) { o.weights.own[name] = bad; }) == std::string("weights.") + name);
    CHECK(refused([&](Options& o) { o.weights.own[name] = 0.0; }) == "accepted");
  }
  // No term, and a term whose weights are shared.
  for (const char* name : {"flite", "friction"})
    CHECK(refused([&](Options& o) { o.weights.own[name] = 1.0; }) == std::string("weights.") + name);
}

TEST_CASE("numbers with a range of their own") {
  for (double bad : {0.0, -1.0, kNan, kInf}) {
    CHECK(refused([&](Options& o) { o.proximal_weight = bad; }) == "proximal_weight");
    CHECK(refused([&](Options& o) { o.weights.contact_min = bad; }) == "weights.contact_min");
    CHECK(refused([&](Options& o) { o.weights.contact_max = bad; }) == "weights.contact_max");
    // Without a weight of their own nothing would determine them where a contact carries nothing.
    CHECK(refused([&](Options& o) { o.weights.center_of_pressure = bad; }) == "weights.center_of_pressure");
    CHECK(refused([&](Options& o) { o.weights.force_line = bad; }) == "weights.force_line");
  }
  for (double bad : {-1.0, kNan, kInf}) {
    CHECK(refused([&](Options& o) { o.duration_min_s = bad; }) == "duration_min_s");
    CHECK(refused([&](Options& o) { o.duration_initial_s = bad; }) == "duration_initial_s");
  }
  for (double middle : {0.0, 0.3}) CHECK(refused([&](Options& o) { o.duration_initial_s = middle; }) == "accepted");
  for (double bad : {0.1, -1.0, kNan, kInf})
    CHECK(refused([&](Options& o) { o.duration_min_s = 0.2, o.duration_max_s = bad; }) == "duration_max_s");
  for (double robots : {0.0, 0.3}) CHECK(refused([&](Options& o) { o.duration_min_s = robots; }) == "accepted");
  for (double bad : {1.0, 0.0, kNan, kInf})
    CHECK(refused([&](Options& o) { o.weights.contact_growth = bad; }) == "weights.contact_growth");
  for (double bad : {0.99, kNan, kInf})
    CHECK(refused([&](Options& o) { o.weights.overshoot_factor = bad; }) == "weights.overshoot_factor");
  for (double bad : {-0.001, kNan, kInf})
    CHECK(refused([&](Options& o) { o.reach_margin_m = bad; }) == "reach_margin_m");
  for (double bad : {2.001, kNan, kInf}) CHECK(refused([&](Options& o) { o.sole_inside = bad; }) == "sole_inside");
  for (double bad : {0.0, -1.0, kNan}) CHECK(refused([&](Options& o) { o.time_limit_s = bad; }) == "time_limit_s");
  CHECK(refused([](Options& o) { o.time_limit_s = kInf; }) == "accepted");
  CHECK(refused([](Options& o) { o.weights.overshoot_factor = 1.0; }) == "accepted");
  CHECK(refused([](Options& o) { o.duration_max_s = o.duration_min_s; }) == "accepted");
}

TEST_CASE("a friction pyramid has three sides at least; none stands for the cone") {
  for (int bad : {-1, 1, 2, 65}) CHECK(refused([&](Options& o) { o.friction_sides = bad; }) == "friction_sides");
  for (int good : {0, 3, 4, 64}) CHECK(refused([&](Options& o) { o.friction_sides = good; }) == "accepted");
}

TEST_CASE("the model is that of contact wrenches, but for the paper's method") {
  using namespace mcplan::ddp;
  Options options;
  CHECK(options.effective_model() == Model::wrench);
  options.model = Model::lipm;
  CHECK(options.effective_model() == Model::lipm);
  for (Model model : {Model::wrench, Model::lipm}) {
    options.model = model;
    options.method = Method::paper;
    CHECK(options.effective_model() == Model::lipm);
  }
}

TEST_CASE("contact weights that fall instead of growing are refused") {
  CHECK(refused([](Options& o) { o.weights.contact_min = 10.0, o.weights.contact_max = 1.0; }) ==
        "weights.contact_max");
}
