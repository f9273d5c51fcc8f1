#include "planar/sip/rows.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "planar/sip/polynomial.hpp"

using namespace mcplan::sip;

namespace {

constexpr int kSamples = 2001;

/// A graph whose one node is a polynomial, each coefficient a parameter of its own.
struct One {
  explicit One(int order) : graph(order + 1) {
    std::vector<int> columns(order + 1);
    for (int i = 0; i <= order; ++i) columns[i] = i;
    node = graph.input(order, columns);
    graph.input_of(node).tangents.setIdentity();
  }
  void set(const Eigen::VectorXd& a) {
    graph.input_of(node).coefficients = a;
    graph.evaluate(work, true);
  }

  TaylorGraph graph;
  TaylorGraph::Node node;
  TaylorGraph::Workspace work;
};

Eigen::VectorXd random_polynomial(std::mt19937& random, int order) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd a(order + 1);
  for (double& x : a) x = normal(random);
  return a;
}

Options with(Continuous continuous) {
  Options options;
  options.continuous = continuous;
  return options;
}

Limited between(TaylorGraph::Node node, double lower, double upper) {
  Limited out;
  out.name = "limit";
  out.node = node;
  out.lower = lower;
  out.upper = upper;
  return out;
}

Eigen::VectorXd values_of(const Rows& rows, const TaylorGraph::Workspace& work) {
  Eigen::VectorXd f(rows.count());
  rows.values(work, f);
  return f;
}

std::pair<double, double> sampled_range(const Eigen::VectorXd& a) {
  std::pair<double, double> out(INFINITY, -INFINITY);
  for (int i = 0; i < kSamples; ++i) {
    const double value = evaluate(a, -1.0 + 2.0 * i / (kSamples - 1));
    out = {std::min(out.first, value), std::max(out.second, value)};
  }
  return out;
}

}  // namespace

TEST_CASE("rows of the hull contain the polynomial") {
  std::mt19937 random(1);
  for (int order = 1; order <= 14; ++order) {
    One one(order);
    const Rows rows(one.graph, {between(one.node, -1.0, 2.0)}, with(Continuous::hull));
    CHECK(rows.count() == order + 1);
    CHECK(rows.lower() == Eigen::VectorXd::Constant(order + 1, -1.0));
    CHECK(rows.upper() == Eigen::VectorXd::Constant(order + 1, 2.0));
    for (int draw = 0; draw < 20; ++draw) {
      const Eigen::VectorXd a = random_polynomial(random, order);
      one.set(a);
      const Eigen::VectorXd f = values_of(rows, one.work);
      const auto [least, most] = sampled_range(a);
      CHECK(f.minCoeff() <= least + 1e-12);
      CHECK(f.maxCoeff() >= most - 1e-12);
    }
  }
}

TEST_CASE("rows of extrema are the least and the largest value, one for each finite limit") {
  std::mt19937 random(2);
  for (int order = 1; order <= 10; ++order) {
    One one(order);
    const Rows both(one.graph, {between(one.node, -1.0, 2.0)}, with(Continuous::extremum));
    const Rows below(one.graph, {between(one.node, -INFINITY, 2.0)}, with(Continuous::extremum));
    const Rows above(one.graph, {between(one.node, -1.0, INFINITY)}, with(Continuous::extremum));
    REQUIRE(both.count() == 2);
    REQUIRE(below.count() == 1);
    REQUIRE(above.count() == 1);
    CHECK(both.entries_come_and_go());
    CHECK(both.lower() == Eigen::Vector2d(-1.0, -INFINITY));
    CHECK(both.upper() == Eigen::Vector2d(INFINITY, 2.0));
    for (int draw = 0; draw < 20; ++draw) {
      const Eigen::VectorXd a = random_polynomial(random, order);
      one.set(a);
      const Eigen::VectorXd f = values_of(both, one.work);
      const auto [least, most] = sampled_range(a);
      // A sample is at most half a spacing away from the extremum, where the slope is zero.
      CHECK(f[0] <= least + 1e-12);
      CHECK(f[0] >= least - 1e-4);
      CHECK(f[1] >= most - 1e-12);
      CHECK(f[1] <= most + 1e-4);
      CHECK(values_of(below, one.work)[0] == doctest::Approx(f[1]));
      CHECK(values_of(above, one.work)[0] == doctest::Approx(f[0]));

      Eigen::MatrixXd J = Eigen::MatrixXd::Zero(2, order + 1);
      Eigen::VectorXd again(2);
      both.jacobian(one.work, again, J);
      CHECK(again == f);
      for (int k = 0; k <= order; ++k) {
        const double step = 1e-6;
        Eigen::VectorXd up = a, down = a;
        up[k] += step;
        down[k] -= step;
        one.set(up);
        Eigen::VectorXd slope = values_of(both, one.work);
        one.set(down);
        slope = (slope - values_of(both, one.work)) / (2.0 * step);
        CHECK((J.col(k) - slope).cwiseAbs().maxCoeff() < 1e-4);
      }
    }
  }
}

TEST_CASE("rows of a grid are values at equal distances, both ends included") {
  One one(4);
  Options options = with(Continuous::grid);
  options.grid_points = 5;
  const Rows rows(one.graph, {between(one.node, -1.0, 1.0)}, options);
  const Eigen::VectorXd a = Eigen::VectorXd::LinSpaced(5, 1.0, 3.0);
  one.set(a);
  const Eigen::VectorXd f = values_of(rows, one.work);
  REQUIRE(f.size() == 5);
  for (int i = 0; i < 5; ++i) CHECK(f[i] == doctest::Approx(evaluate(a, -1.0 + 0.5 * i)));
}

TEST_CASE("rows of coefficients and of an instant do not depend on how inequalities are kept") {
  for (Continuous continuous : {Continuous::hull, Continuous::extremum, Continuous::grid}) {
    One one(5);
    Limited band = between(one.node, -0.1, 0.1), instant = between(one.node, 0.0, INFINITY);
    band.when = Limited::When::coefficients;
    band.highest = 2;
    instant.when = Limited::When::instant;
    instant.at = 0.4;
    Limited all = band;
    all.highest = 9;  // beyond the order: there are no more
    const Rows rows(one.graph, {band, instant, all}, with(continuous));
    const Eigen::VectorXd a = Eigen::VectorXd::LinSpaced(6, -1.0, 1.0);
    one.set(a);
    const Eigen::VectorXd f = values_of(rows, one.work);
    REQUIRE(f.size() == 3 + 1 + 6);
    CHECK(f.head(3) == a.head(3));
    CHECK(f[3] == doctest::Approx(evaluate(a, 0.4)));
    CHECK(f.tail(6) == a);
    CHECK(!rows.entries_come_and_go());
  }
}

TEST_CASE("a scale turns rows and finite limits alike, and leaves infinite ones infinite") {
  One one(3);
  Limited limited = between(one.node, -INFINITY, 4.0);
  limited.scale = 1e-3;
  for (Continuous continuous : {Continuous::hull, Continuous::extremum, Continuous::grid}) {
    const Rows rows(one.graph, {limited}, with(continuous));
    one.set(Eigen::Vector4d(7.0, 0.0, 0.0, 0.0));
    const Eigen::VectorXd f = values_of(rows, one.work);
    for (int r = 0; r < f.size(); ++r) {
      CHECK(f[r] == doctest::Approx(7e-3));
      CHECK(rows.lower()[r] == -INFINITY);
      CHECK(rows.upper()[r] == doctest::Approx(4e-3));
      CHECK(rows.name(r) == "limit");
    }
  }
}

TEST_CASE("a limit that its scale makes infinite is no row, under extrema as well") {
  One one(3);
  one.set(Eigen::Vector4d(0.0, 1.0, 0.0, 0.0));
  Limited limited = between(one.node, -1e300, 1e-10);
  limited.scale = 1e10;
  const Rows rows(one.graph, {limited}, with(Continuous::extremum));
  REQUIRE(rows.count() == 1);
  CHECK(rows.upper()[0] == doctest::Approx(1.0));
  CHECK(values_of(rows, one.work)[0] == doctest::Approx(1e10));  // of the largest value, at s = 1
}

TEST_CASE("adjoints are the transposed rows") {
  One one(6);
  std::mt19937 random(5);
  Limited instant = between(one.node, 0.0, 1.0);
  instant.when = Limited::When::instant;
  instant.at = -0.3;
  for (Continuous continuous : {Continuous::hull, Continuous::extremum, Continuous::grid}) {
    const Rows rows(one.graph, {between(one.node, -1.0, 1.0), instant}, with(continuous));
    one.set(random_polynomial(random, 6));
    Eigen::VectorXd f(rows.count()), weights = random_polynomial(random, rows.count() - 1);
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(rows.count(), 7);
    rows.jacobian(one.work, f, J);
    one.graph.clear_adjoints(one.work);
    rows.add_adjoints(one.work, weights);
    const Eigen::VectorXd adjoints = one.graph.adjoints(one.work, one.node);
    CHECK((adjoints - J.transpose() * weights).norm() < 1e-12);
  }
}
