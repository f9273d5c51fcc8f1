#include "planar/sip/polynomial.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "mcplan/base/error.hpp"

using namespace mcplan::sip;

namespace {

Eigen::VectorXd random_polynomial(std::mt19937& random, int degree) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd a(degree + 1);
  for (double& x : a) x = normal(random);
  return a;
}

/// Product of (s - root), times `scale`.
Eigen::VectorXd from_roots(const std::vector<double>& roots, double scale) {
  Eigen::VectorXd a = Eigen::VectorXd::Constant(1, scale);
  for (double root : roots) {
    Eigen::VectorXd next = Eigen::VectorXd::Zero(a.size() + 1);
    next.tail(a.size()) = a;
    next.head(a.size()) -= root * a;
    a = next;
  }
  return a;
}

}  // namespace

TEST_CASE("Bernstein coefficients describe the same polynomial") {
  std::mt19937 random(1);
  for (int degree = 0; degree <= 14; ++degree) {
    const Eigen::VectorXd a = random_polynomial(random, degree);
    const Eigen::VectorXd b = bernstein_matrix(degree) * a;
    for (double s : {-1.0, -0.83, -0.2, 0.0, 0.41, 0.99, 1.0}) {
      const double u = 0.5 * (s + 1.0);
      double value = 0.0;
      for (int i = 0; i <= degree; ++i)
        value += b[i] * std::tgamma(degree + 1) / (std::tgamma(i + 1) * std::tgamma(degree - i + 1)) * std::pow(u, i) *
                 std::pow(1.0 - u, degree - i);
      CAPTURE(degree);
      CHECK(value == doctest::Approx(evaluate(a, s)).epsilon(1e-11));
    }
  }
  CHECK_THROWS_AS(bernstein_matrix(-1), mcplan::InvalidInput);
  CHECK_THROWS_AS(bernstein_matrix(max_degree + 1), mcplan::InvalidInput);
}

TEST_CASE("the hull holds the polynomial, and its excess over the maximum shrinks by four at each halving") {
  std::mt19937 random(2);
  for (int draw = 0; draw < 100; ++draw) {
    const int degree = 3 + draw % 9;
    const Eigen::VectorXd a = random_polynomial(random, degree);
    const Extrema truth = extrema(a);
    std::vector<Eigen::VectorXd> pieces{bernstein_matrix(degree) * a};
    // Distance of Bernstein coefficients from their polynomial: at most degree / 8 times the largest second difference.
    const Eigen::VectorXd& b = pieces[0];
    double bound =
        degree / 8.0 * (b.tail(degree - 1) - 2.0 * b.segment(1, degree - 1) + b.head(degree - 1)).cwiseAbs().maxCoeff();
    for (int depth = 0; depth < 7; ++depth, bound *= 0.25) {
      double hull = -1e300;
      std::vector<Eigen::VectorXd> halves;
      for (auto& piece : pieces) {
        hull = std::max(hull, piece.maxCoeff());
        Eigen::VectorXd left(piece.size());
        halve_bernstein(piece, left, piece);
        halves.push_back(left);
        halves.push_back(piece);
      }
      CAPTURE(depth);
      CHECK(hull >= truth.max - 1e-13);
      CHECK(hull <= truth.max + bound + 1e-13);
      pieces = halves;
    }
  }
}

TEST_CASE("restriction, derivative and integral are those of the function") {
  std::mt19937 random(3);
  for (int draw = 0; draw < 50; ++draw) {
    const Eigen::VectorXd a = random_polynomial(random, draw % 13);
    const Eigen::VectorXd part = restricted(a, 0.3, 0.25);
    for (double s : {-1.0, -0.3, 0.7, 1.0})
      CHECK(evaluate(part, s) == doctest::Approx(evaluate(a, 0.3 + 0.25 * s)).epsilon(1e-12));
    CHECK((derivative(integral(a)) - a).norm() < 1e-14 * (1.0 + a.norm()));
    CHECK(definite_integral(a) == doctest::Approx(evaluate(integral(a), 1.0) - evaluate(integral(a), -1.0)));
    Eigen::VectorXd square = Eigen::VectorXd::Zero(2 * a.size() - 1);
    for (int i = 0; i < a.size(); ++i) square.segment(i, a.size()) += a[i] * a;
    CHECK(definite_integral_of_square(a) == doctest::Approx(definite_integral(square)).epsilon(1e-12));
  }
  CHECK(derivative(Eigen::VectorXd::Ones(1)) == Eigen::VectorXd::Zero(1));
}

TEST_CASE("roots are found where they were put") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1.3, 1.3);
  for (int draw = 0; draw < 2000; ++draw) {
    std::vector<double> put(1 + draw % 9);
    for (double& x : put) x = uniform(random);
    std::sort(put.begin(), put.end());
    double gap = 1.0;
    for (std::size_t i = 1; i < put.size(); ++i) gap = std::min(gap, put[i] - put[i - 1]);
    for (double x : put) gap = std::min(gap, std::abs(std::abs(x) - 1.0));
    if (gap < 0.02) continue;  // closer roots are ill-conditioned in their coefficients
    std::vector<double> inside;
    for (double x : put)
      if (std::abs(x) < 1.0) inside.push_back(x);
    const Places found = roots(from_roots(put, 3.7));
    CAPTURE(draw);
    REQUIRE(found.count == static_cast<int>(inside.size()));
    for (int i = 0; i < found.count; ++i) CHECK(found.s[i] == doctest::Approx(inside[i]).epsilon(1e-7));
  }
}

TEST_CASE("roots on places of halving, none of a constant or of zero") {
  for (const auto& put : std::vector<std::vector<double>>{{0.0}, {-0.5, 0.0, 0.5}, {-0.75, 0.0, 0.25, 0.9}}) {
    const Places found = roots(from_roots(put, 1.0));
    REQUIRE(found.count == static_cast<int>(put.size()));
    for (int i = 0; i < found.count; ++i) CHECK(found.s[i] == doctest::Approx(put[i]).epsilon(1e-12));
  }
  CHECK(roots(Eigen::VectorXd::Zero(6)).count == 0);
  CHECK(roots(Eigen::VectorXd::Ones(1)).count == 0);
}

TEST_CASE("extrema are those of a fine grid, or a little beyond") {
  std::mt19937 random(5);
  for (int draw = 0; draw < 300; ++draw) {
    const Eigen::VectorXd a = random_polynomial(random, draw % 15);
    const Extrema found = extrema(a);
    CHECK(evaluate(a, found.at_max) == found.max);
    CHECK(evaluate(a, found.at_min) == found.min);
    double low = 1e300, high = -1e300;
    for (int i = 0; i <= 4000; ++i) {
      const double value = evaluate(a, -1.0 + i / 2000.0);
      low = std::min(low, value);
      high = std::max(high, value);
    }
    CAPTURE(draw);
    CHECK(found.max >= high - 1e-13);
    CHECK(found.min <= low + 1e-13);
    CHECK(found.max <= high + 1e-4);
    CHECK(found.min >= low - 1e-4);
  }
  // A double root of the derivative is no extremum: s^3, and its shift.
  CHECK(extrema(Eigen::Vector4d(0, 0, 0, 1)).at_max == 1.0);
  CHECK(extrema(from_roots({0.3, 0.3, 0.3}, 1.0)).at_min == -1.0);
}
