#include "planar/sip/taylor_model.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "mcplan/base/error.hpp"

using namespace mcplan;
using sip::TaylorModel;
using sip::UncertainPolynomial;

namespace {

const long double kPlaces[] = {-1.0L, -0.77L, -0.31L, 0.0L, 0.12L, 0.5L, 0.93L, 1.0L};

UncertainPolynomial random_cubic(std::mt19937& random, double size) {
  std::normal_distribution<double> normal(0.0, size);
  UncertainPolynomial p;
  p.a = Eigen::Vector4d(3.0 * normal(random), normal(random), normal(random), normal(random));
  return p;
}

long double value(const Eigen::VectorXd& a, long double s) {
  long double out = 0.0L;
  for (Eigen::Index k = a.size() - 1; k >= 0; --k) out = out * s + a[k];
  return out;
}

/// Largest |f - p| - remainder over the places: above zero if the model is wrong.
template <class Function>
long double escape(const TaylorModel& model, const Function& f) {
  long double worst = -1.0L;
  for (long double s : kPlaces)
    worst = std::max(worst, std::abs(f(s) - value(model.coefficients(), s)) - model.remainder());
  return worst;
}

}  // namespace

TEST_CASE("a model holds sines, products, sums and integrals of cubics") {
  std::mt19937 random(11);
  for (int draw = 0; draw < 400; ++draw) {
    const int order = 2 + draw % 11;
    const UncertainPolynomial p = random_cubic(random, 0.4), q = random_cubic(random, 0.4);
    const auto P = TaylorModel::of(order, p), Q = TaylorModel::of(order, q);
    const auto sine = P.sine_cosine().sine, cosine = Q.sine_cosine().cosine;
    CAPTURE(order);
    CHECK(escape(sine, [&](long double s) { return std::sin(value(p.a, s)); }) <= 0.0L);
    CHECK(escape(cosine, [&](long double s) { return std::cos(value(q.a, s)); }) <= 0.0L);
    CHECK(escape(sine * cosine, [&](long double s) { return std::sin(value(p.a, s)) * std::cos(value(q.a, s)); }) <=
          0.0L);
    CHECK(escape(P - Q * sine,
                 [&](long double s) { return value(p.a, s) - value(q.a, s) * std::sin(value(p.a, s)); }) <= 0.0L);
    const auto I = P.integral();
    CHECK(escape(I, [&](long double s) {
            return s * (p.a[0] + s * (p.a[1] / 2.0L + s * (p.a[2] / 3.0L + s * p.a[3] / 4.0L)));
          }) <= 0.0L);
  }
}

TEST_CASE("the truncation of a sine is the majorant's tail, and shrinks by 2^-(n+1) when the angle's range halves") {
  UncertainPolynomial p;
  p.a = Eigen::Vector2d(0.4, 0.5);
  for (int order = 2; order <= 12; ++order) {
    // E(s) = exp(0.5 s): sum_{k>n} 0.5^k / k!, whose first terms are enough here.
    long double tail = 0.0L, term = 1.0L;
    for (int k = 1; k < 40; ++k) {
      term *= 0.5L / k;
      if (k > order) tail += term;
    }
    const double found = TaylorModel::of(order, p).sine_cosine().sine.truncation();
    CAPTURE(order);
    CHECK(found >= tail);
    CHECK(found <= 1.01L * tail);
    const double half = TaylorModel::of(order, p.restricted(0.5, 0.5)).sine_cosine().sine.truncation();
    CHECK(half < 1.01 * std::pow(0.5, order + 1) * found);
  }
}

TEST_CASE("a sine of a large angle range is bounded by one, not by the exponential of the range") {
  UncertainPolynomial p;
  p.a = Eigen::Vector4d(0.1, 1e3, 0.0, -4e5);
  const auto [sine, cosine] = TaylorModel::of(8, p).sine_cosine();
  CHECK(sine.range().min >= -1.0000001);
  CHECK(cosine.range().max <= 1.0000001);
  CHECK(escape(sine, [&](long double s) { return std::sin(value(p.a, s)); }) <= 0.0L);
}

TEST_CASE("range and value at a place hold the function, errors of coefficients included") {
  std::mt19937 random(12);
  for (int draw = 0; draw < 200; ++draw) {
    UncertainPolynomial p = random_cubic(random, 0.7), truth = p;
    p.error = 1e-3;
    truth.a[draw % 4] += 1e-3;  // within the error
    const UncertainPolynomial part = p.restricted(-0.25, 0.5), slope = p.derivative().restricted(-0.25, 0.5);
    const TaylorModel sine = TaylorModel::of(9, part).sine_cosine().sine;
    for (long double s : kPlaces) {
      const double place = static_cast<double>(s);
      const long double x = -0.25L + 0.5L * place;
      const long double angle = value(truth.a, x);
      const long double rate = truth.a[1] + x * (2 * truth.a[2] + x * 3 * truth.a[3]);
      CHECK(part.range().min <= angle);
      CHECK(part.range().max >= angle);
      CHECK(slope.range().min <= rate);
      CHECK(slope.range().max >= rate);
      CHECK(part.at(place).min <= angle);
      CHECK(part.at(place).max >= angle);
      CHECK(sine.range().min <= std::sin(angle));
      CHECK(sine.range().max >= std::sin(angle));
      CHECK(sine.at(place).max >= std::sin(angle));
      CHECK(sine.at(place).max - sine.at(place).min < 0.2);
    }
  }
}

TEST_CASE("rounding stays small: a sum of a thousand terms that cancel") {
  const TaylorModel x = TaylorModel::constant(8, 0.1);
  TaylorModel sum = TaylorModel::constant(8, 0.0);
  for (int i = 0; i < 1000; ++i) sum += x;
  sum -= TaylorModel::constant(8, 1000.0).scaled(0.1);
  // 1000 times the double next to 0.1, against itself: exactly zero.
  CHECK(std::abs(sum.coefficients()[0]) <= sum.rounding());
  CHECK(sum.rounding() < 1e-10);
  CHECK(sum.truncation() < 1e-280);
}

TEST_CASE("numbers that are not finite are not bounded") {
  UncertainPolynomial p;
  p.a = Eigen::Vector2d(0.0, std::numeric_limits<double>::quiet_NaN());
  const sip::Range range = (TaylorModel::of(3, p) * TaylorModel::constant(3, 2.0)).range();
  CHECK_FALSE(range.max <= 1e300);
  CHECK_FALSE(range.min >= -1e300);
}

TEST_CASE("orders out of range or that differ are refused") {
  CHECK_THROWS_AS(TaylorModel::constant(13, 1.0), InvalidOptions);
  CHECK_THROWS_AS(TaylorModel::constant(-1, 1.0), InvalidOptions);
  CHECK_THROWS_AS(TaylorModel::constant(3, 1.0) + TaylorModel::constant(4, 1.0), InvalidInput);
  CHECK_THROWS_AS(TaylorModel::constant(3, 1.0) * TaylorModel::constant(4, 1.0), InvalidInput);
}
