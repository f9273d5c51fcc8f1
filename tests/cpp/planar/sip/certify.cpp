#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>

#include "mcplan/planar/checker.hpp"
#include "mcplan/planar/sip/certificate.hpp"
#include "planar/robots.hpp"

using namespace mcplan;
using sip::Certificate;
using sip::certify;
using sip::Proof;
using sip::ProvedConstraint;

namespace {

const ProvedConstraint& find(const Certificate& certificate, const std::string& name) {
  for (const ProvedConstraint& c : certificate.constraints)
    if (c.name == name) return c;
  throw std::runtime_error("no constraint " + name);
}

std::map<std::string, double> sampled(const PlanarPlan& plan, double sample_s) {
  PlanarTolerances tolerances;
  tolerances.sample_s = sample_s;
  std::map<std::string, double> out;
  for (const Violation& v : check(plan, tolerances, true).constraints) out[v.name] = v.value;
  return out;
}

/// A plan that moves, feasible or not: the point is that bounds hold.
PlanarPlan random_plan(int seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  PlanarPlan plan = planar::standing_plan();
  const double size = std::pow(10.0, -3.0 * uniform(random));
  for (double& duration : plan.durations) duration = 0.15 + 0.6 * uniform(random);
  for (double& c : plan.control_points.reshaped()) c += size * normal(random);
  for (Eigen::VectorXd& w : plan.weights)
    for (double& x : w) x = std::exp(normal(random));
  plan.task.phases[1].contacts.pop_back();
  plan.weights[1].conservativeResize(2);
  PlanarSurface wall;
  wall.name = "wall";
  wall.origin_W = {0.1, 0.7};
  wall.angle = 1.9;
  wall.from = -0.4;
  wall.to = 0.5;
  plan.task.surfaces.push_back(wall);
  plan.task.phases[0].clearances.push_back({planar::hand, 1, 0, -1, -std::numeric_limits<double>::infinity()});
  const int intervals = plan.task.interval_count();
  if (seed % 3 == 0) {
    plan.base_control_points = Eigen::MatrixXd::Zero(3, intervals + 3);
    plan.base_control_points.row(1).setConstant(planar::hip_height());
    for (double& c : plan.base_control_points.reshaped()) c += size * normal(random);
  }
  if (seed % 2 == 0) {
    plan.force_law = planar_laws::Polynomial();
    for (int i = 0; i < intervals; ++i) {
      const int points = plan.task.phase_of(i) == 1 ? 2 : 4;
      Eigen::MatrixXd forces(4, 2 * points);
      for (double& f : forces.reshaped()) f = 50.0 * normal(random);
      plan.force_polynomials.push_back(forces);
    }
    plan.weights.clear();
  }
  return plan;
}

}  // namespace

TEST_CASE("a robot at rest is certified") {
  const Certificate certificate = certify(planar::standing_plan());
  CAPTURE(certificate.to_string());
  CHECK(certificate.proved());
  CHECK(certificate.rounding < 1e-6);
  CHECK(find(certificate, "torque").bound == doctest::Approx(sampled(planar::standing_plan(), 0.1)["torque"]));
}

TEST_CASE("no sample of exact kinematics and dynamics is beyond a bound") {
  for (int seed = 0; seed < 60; ++seed) {
    const PlanarPlan plan = random_plan(seed);
    const Certificate certificate = certify(plan, {{}, 3 + seed % 10, 6, true});
    for (const auto& sample : sampled(plan, 0.004)) {
      const std::string& name = sample.first;
      const double value = sample.second;
      if (name == "finite") continue;
      const ProvedConstraint& c = find(certificate, name);
      CAPTURE(seed);
      CAPTURE(name);
      if (c.phase < 0) continue;
      CHECK(value <= c.bound + 1e-12 * std::abs(value));
      CHECK(c.reached <= c.bound);
      CHECK((c.proof == Proof::violated) == (c.reached > c.tolerance));
      if (value > c.tolerance + 1e-9) CHECK(c.proof != Proof::proved);
      // Two halvings at least: what is proved is not far above what is there.
      CHECK(c.reached >= value - 0.05 * std::abs(value) - 0.05);
    }
  }
}

TEST_CASE("a violation is one: the exact state at its place is beyond the tolerance by what is stated") {
  int violations = 0;
  for (int seed = 1; seed < 40; seed += 2) {
    const PlanarPlan plan = random_plan(seed);
    const Certificate certificate = certify(plan);
    const ProvedConstraint &torque = find(certificate, "torque"), &drift = find(certificate, "drift");
    // The two sides of a boundary differ; shift to the side that the phase says.
    const auto at = [&](const ProvedConstraint& c) {
      const double start = plan.knot_times()[c.phase];
      return plan.at_phase(c.phase, std::min(std::max(c.time_s - start, 0.0), plan.durations[c.phase]));
    };
    CAPTURE(seed);
    if (torque.proof == Proof::violated) {
      ++violations;
      const int body = plan.task.robot.body_index(torque.where);
      const double value = std::abs(at(torque).torque[body - 1]) / plan.task.robot.bodies[body].torque_max - 1.0;
      CHECK(value >= torque.reached - 1e-9);
      CHECK(value <= torque.bound);
    }
    if (drift.proof == Proof::violated) {
      ++violations;
      double value = 0.0;
      for (const Eigen::Vector3d& error : at(drift).contact_error) value = std::max(value, error.head<2>().norm());
      CHECK(value >= drift.reached - 1e-9);
      CHECK(value <= drift.bound);
    }
  }
  CHECK(violations > 10);
}

TEST_CASE("a tolerance just below the maximum is violated, one just above is proved") {
  for (int seed : {5, 7, 11, 13}) {
    const PlanarPlan plan = random_plan(seed);
    std::map<std::string, double> most = sampled(plan, 2e-5);
    const auto with = [&](double change) {
      sip::CertifyOptions options;
      options.max_depth = 20;
      options.tolerances.limit = most["torque"] + change * (1.0 + std::abs(most["torque"]));
      options.tolerances.drift = most["drift"] * (1.0 + change);
      options.tolerances.friction = most["friction"] + change * (1.0 + std::abs(most["friction"]));
      return certify(plan, options);
    };
    const Certificate below = with(-1e-5), above = with(1e-5);
    CAPTURE(seed);
    CAPTURE(above.to_string());
    for (const char* name : {"torque", "drift", "friction"}) {
      CAPTURE(name);
      CHECK(find(below, name).proof == Proof::violated);
      CHECK(find(above, name).proof == Proof::proved);
    }
  }
}

TEST_CASE("a higher order needs fewer pieces") {
  const PlanarPlan plan = random_plan(7);
  sip::CertifyOptions options;
  options.tolerances.limit = 1.01 * sampled(plan, 1e-3)["torque"] + 0.01;
  options.order = 2;
  const Certificate low = certify(plan, options);
  options.order = 10;
  const Certificate high = certify(plan, options);
  CHECK(find(low, "torque").proof == Proof::proved);
  CHECK(find(high, "torque").proof == Proof::proved);
  CHECK(high.subdivisions < low.subdivisions);
}

TEST_CASE("what cannot be decided in the halvings allowed is not proved") {
  const PlanarPlan plan = random_plan(7);
  sip::CertifyOptions options;
  options.max_depth = 1;
  options.order = 2;
  options.tolerances.moment = sampled(plan, 1e-3)["moment"] * 1.0001;
  const ProvedConstraint moment = find(certify(plan, options), "moment");
  CHECK(moment.proof == Proof::not_proved);
  CHECK(moment.bound > moment.tolerance);
}

TEST_CASE("limbs that pass through each other are named, limbs that pass each other are proved to") {
  PlanarPlan plan = planar::standing_plan();
  PlanarRobot& robot = plan.task.robot;
  // The arm hangs from 0.4 m above the hips and swings once about; leg and arm come within a few centimetres.
  robot.bodies[planar::arm].position_min = -7.0;
  robot.bodies[planar::arm].position_max = 7.0;
  for (Eigen::Index i = 0; i < plan.control_points.cols(); ++i)
    plan.control_points(planar::arm - 1, i) = -3.0 + 6.0 * i / (plan.control_points.cols() - 1.0);
  const double gap = 0.4 - 0.2 - 0.05 - 0.03;  // straight down, from the hip
  sip::CertifyOptions options;
  options.self_collision = true;
  options.tolerances.clearance = -gap + 1e-4;
  const ProvedConstraint past = find(certify(plan, options), "collision");
  CHECK(past.proof == Proof::proved);
  CHECK(past.bound == doctest::Approx(-gap).epsilon(1e-3));
  robot.bodies[planar::arm].capsules[0].to_B.y() = -0.5;
  options.tolerances.clearance = 0.0;
  const ProvedConstraint through = find(certify(plan, options), "collision");
  CHECK(through.proof == Proof::violated);
  CHECK(through.where == "left_leg and arm");
  CHECK(through.bound == doctest::Approx(0.05 + 0.03));
  CHECK_THROWS(find(certify(plan), "collision"));
}

TEST_CASE("options and plans out of range are refused") {
  const PlanarPlan plan = planar::standing_plan();
  CHECK_THROWS_AS(certify(plan, {{}, 1, 12}), InvalidOptions);
  CHECK_THROWS_AS(certify(plan, {{}, 13, 12}), InvalidOptions);
  CHECK_THROWS_AS(certify(plan, {{}, 8, 41}), InvalidOptions);
  PlanarPlan malformed = plan;
  malformed.durations[1] = -1.0;
  CHECK_THROWS_AS(certify(malformed), InvalidPlan);
}

TEST_CASE("a certificate reads as a list") {
  const std::string good = certify(planar::standing_plan()).to_string();
  CHECK(good.find("certified: every constraint holds at every instant") == 0);
  PlanarPlan plan = planar::standing_plan();
  plan.control_points(4, 8) = 9.0;
  const std::string bad = certify(plan).to_string();
  CHECK(bad.find("not certified: ") == 0);
  CHECK(bad.find("violated    position") != std::string::npos);
  CHECK(bad.find("arm, phase 1") != std::string::npos);
}
