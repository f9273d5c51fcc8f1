#include <doctest/doctest.h>

#include <Eigen/Core>
#include <limits>
#include <random>
#include <string>

#include "mcplan/base/error.hpp"
#include "mcplan/wb/solver.hpp"

using namespace mcplan::wb;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr double kWeight = 50.0;  // [N]

/// The base with two joints, of which the second carries a sole that is in contact at all of six nodes.
Problem standing() {
  Problem out;
  for (int i = 0; i < 8; ++i) {
    Link link;
    link.joint = "joint " + std::to_string(i);
    link.parent = i - 1;
    link.prismatic = i < 3;
    link.axis = Vector3d::Unit(i < 3 ? i : (i < 6 ? 5 - i : 1));
    link.position = i < 6 ? Vector3d(Vector3d::Zero()) : Vector3d(0.0, 0.0, -0.3);
    link.mass = i < 5 ? 0.0 : 1.0;
    link.position_min = -1.0;
    link.position_max = 1.0;
    link.velocity_max = 5.0;
    link.torque_max = 40.0;
    out.links.push_back(link);
  }
  Eigen::Matrix3Xd corners(3, 4);
  corners << 0.1, 0.1, -0.1, -0.1, 0.05, -0.05, -0.05, 0.05, 0.0, 0.0, 0.0, 0.0;
  EndEffector sole;
  sole.name = "sole";
  sole.link = 7;
  sole.points_S = corners;
  out.end_effectors.push_back(sole);
  out.posture = VectorXd::Zero(2);
  out.weight_N = kWeight;
  for (int k = 0; k < 6; ++k) {
    Node node;
    node.time_s = 0.1 * k;
    Contact contact;
    contact.carries = k > 0;  // as if it were made at the first node
    contact.friction = 0.5;
    contact.wrench_S << 1.0, 2.0, 30.0, 0.1, 0.2, 0.3;
    contact.points_S = corners;
    node.contacts.push_back(contact);
    out.nodes.push_back(node);
  }
  return out;
}

/// A solver whose generalised forces, for tests of costs and rows, are the accelerations.
struct Case {
  explicit Case(const Problem& problem) : solver(problem, [this](bool derivatives) { fill(derivatives); }) {}

  void fill(bool derivatives) {
    Dynamics& d = solver.dynamics();
    d.tau = d.a;
    if (!derivatives) return;
    const Eigen::Index nv = d.a.cols();
    d.dq.setZero();
    d.dv.setZero();
    for (Eigen::Index k = 0; k < d.a.rows(); ++k) d.da.middleRows(k * nv, nv).setIdentity();
  }

  Solver solver;
};

/// Some unknowns: splines that bend, and forces inside of their pyramids.
VectorXd somewhere(Solver& solver, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  const int nodes = solver.problem().node_count(), nv = solver.problem().velocity_count();
  Dynamics::Rows coefficients(nodes + 2, nv), forces(nodes, 12);
  coefficients = coefficients.unaryExpr([&](double) { return 0.2 * draw(random); });
  for (int k = 0; k < nodes; ++k)
    for (int p = 0; p < 4; ++p) {
      const double normal = 10.0 + 5.0 * draw(random);
      forces.row(k).segment<3>(3 * p) << 0.2 * normal * draw(random), 0.2 * normal * draw(random), normal;
    }
  return solver.unknowns(coefficients, forces);
}

double load(Solver& solver, const VectorXd& x, int k) {
  const Dynamics::Rows forces = solver.forces(x);
  return forces(k, 2) + forces(k, 5) + forces(k, 8) + forces(k, 11);
}

}  // namespace

TEST_CASE("a node's factors multiply its costs of accelerations and torques, and no other node's") {
  const Problem plain = standing();
  Problem weighted = plain;
  weighted.nodes[2].acceleration = 5.0;
  weighted.nodes[3].torque = 10.0;
  Case one(plain), other(weighted);
  const VectorXd x = somewhere(one.solver, 3);
  const double before = one.solver.values(x).cost, after = other.solver.values(x).cost;
  const Dynamics& d = one.solver.dynamics();
  const double of_a_node = 0.5 * plain.weights.rate * 0.1;
  const VectorXd torques = d.tau.row(3).tail(2).transpose() / 40.0;
  const double expected = of_a_node * (4.0 * plain.weights.acceleration * d.a.row(2).squaredNorm() +
                                       9.0 * plain.weights.torque * torques.squaredNorm());
  CHECK(expected > 0.0);
  CHECK(after - before == doctest::Approx(expected).epsilon(1e-9));
}

TEST_CASE("a load that is limited is a row: normal force off the plan's over weight, elastic, no limit of the robot") {
  const Problem free = standing();
  Problem limited = free;
  limited.nodes[0].contacts[0].load_max = 20.0;  // which does not carry
  limited.nodes[1].contacts[0].load_max = 20.0;
  limited.nodes[4].contacts[0].load_max = 200.0;
  Case one(free), other(limited);
  CHECK(other.solver.rows() == one.solver.rows() + 2);
  CHECK(other.solver.variables() == one.solver.variables() + 4);
  const VectorXd x = somewhere(other.solver, 4);
  const VectorXd rows = other.solver.values(x).inequalities;
  const int of_a_node = 3 * 2;  // positions, velocities, torques
  for (const auto& [k, row, most] : {std::tuple{1, 2 * of_a_node, 20.0}, std::tuple{4, 5 * of_a_node + 1, 200.0}}) {
    const double off = (load(other.solver, x, k) - 30.0) / kWeight, beyond = (most - 30.0) / kWeight;
    CHECK(rows[row] == doctest::Approx(std::min(off, beyond)).epsilon(1e-9));  // elastic variables make up for it
  }
  CHECK(load(other.solver, x, 1) > 20.0);
  CHECK(other.solver.usage(x).cols() == of_a_node);
}

TEST_CASE("factors of weights and limits of loads that make no sense are refused by name") {
  const double infinite = std::numeric_limits<double>::infinity(), none = std::numeric_limits<double>::quiet_NaN();
  for (const double wrong : {-1.0, infinite, none}) {
    Problem problem = standing();
    problem.nodes[1].acceleration = wrong;
    CHECK_THROWS_WITH_AS(problem.validate(), doctest::Contains("nodes[1].acceleration"), mcplan::InvalidInput);
    problem = standing();
    problem.nodes[2].torque = wrong;
    CHECK_THROWS_WITH_AS(problem.validate(), doctest::Contains("nodes[2].torque"), mcplan::InvalidInput);
  }
  for (const double wrong : {0.0, 0.01 * kWeight, none}) {
    Problem problem = standing();
    problem.nodes[3].contacts[0].load_max = wrong;
    CHECK_THROWS_WITH_AS(problem.validate(), doctest::Contains("nodes[3].contacts.load_max"), mcplan::InvalidInput);
  }
  Problem problem = standing();
  problem.nodes[3].contacts[0].load_max = infinite;
  CHECK_NOTHROW(problem.validate());
}
