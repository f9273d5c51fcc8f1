#include "planar/sip/polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "mcplan/base/error.hpp"

namespace mcplan::sip {
namespace {

using Row = std::array<double, max_degree + 1>;
constexpr double kRoundoff = std::numeric_limits<double>::epsilon();

/// C(n, k): an integer below 2^53 for n <= max_degree, so exact.
double binomial(int n, int k) {
  if (k < 0 || k > n) return 0.0;
  double out = 1.0;
  for (int i = 1; i <= k; ++i) out = out * (n - k + i) / i;  // C(n - k + i, i): whole at every step
  return out;
}

/// M_ik = sum_j C(i, j) C(n - i, k - j) (-1)^(k - j) / C(n, k): the blossom of s^k at i times 1 and n - i times -1.
Eigen::MatrixXd build_bernstein_matrix(int n) {
  Eigen::MatrixXd m(n + 1, n + 1);
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= n; ++k) {
      double sum = 0.0;
      for (int j = 0; j <= k; ++j) sum += binomial(i, j) * binomial(n - i, k - j) * ((k - j) % 2 ? -1.0 : 1.0);
      m(i, k) = sum / binomial(n, k);
    }
  return m;
}

void halve(const double* b, int n, double* left, double* right) {
  Row work{};
  std::copy(b, b + n + 1, work.begin());
  left[0] = work[0];
  for (int level = 1; level <= n; ++level) {
    for (int i = 0; i <= n - level; ++i) work[i] = 0.5 * (work[i] + work[i + 1]);
    left[level] = work[0];
  }
  std::copy(work.begin(), work.begin() + n + 1, right);
}

int sign_variations(const Row& b, int n, double zero) {
  int variations = 0;
  double last = 0.0;
  for (int i = 0; i <= n; ++i) {
    if (std::abs(b[i]) <= zero) continue;
    if (last * b[i] < 0.0) ++variations;
    last = b[i];
  }
  return variations;
}

double horner(const double* a, int n, double s) {
  double value = a[n];
  for (int k = n - 1; k >= 0; --k) value = value * s + a[k];
  return value;
}

/// The one root in (low, high), where the polynomial has the sign of `rising` after the root.
double refine(const double* a, int n, double low, double high, bool rising) {
  double s = 0.5 * (low + high);
  for (int iteration = 0; iteration < 80 && high - low > 2.0 * kRoundoff; ++iteration) {
    double value = a[n], slope = 0.0;
    for (int k = n - 1; k >= 0; --k) {
      slope = slope * s + value;
      value = value * s + a[k];
    }
    if (value == 0.0) return s;
    ((value > 0.0) == rising ? high : low) = s;
    const double newton = s - value / slope;
    if (std::abs(newton - s) <= kRoundoff) return std::clamp(newton, low, high);
    // Newton where it stays inside; every fourth step is a halving, so that the bracket shrinks whatever happens.
    s = newton > low && newton < high && iteration % 4 != 3 ? newton : 0.5 * (low + high);
  }
  return s;
}

void add(Places& places, double s) {
  if (places.count < static_cast<int>(places.s.size())) places.s[places.count++] = s;
}

}  // namespace

double evaluate(const ConstPolynomial& a, double s) { return horner(a.data(), static_cast<int>(a.size()) - 1, s); }

Eigen::VectorXd derivative(const ConstPolynomial& a) {
  if (a.size() <= 1) return Eigen::VectorXd::Zero(1);
  Eigen::VectorXd out(a.size() - 1);
  for (Eigen::Index k = 1; k < a.size(); ++k) out[k - 1] = k * a[k];
  return out;
}

Eigen::VectorXd integral(const ConstPolynomial& a) {
  Eigen::VectorXd out(a.size() + 1);
  out[0] = 0.0;
  for (Eigen::Index k = 0; k < a.size(); ++k) out[k + 1] = a[k] / (k + 1.0);
  return out;
}

Eigen::VectorXd restricted(const ConstPolynomial& a, double middle, double half_width) {
  Eigen::VectorXd out = a;
  const Eigen::Index n = a.size() - 1;
  for (Eigen::Index i = 0; i < n; ++i)  // repeated synthetic division: Taylor coefficients at `middle`
    for (Eigen::Index k = n - 1; k >= i; --k) out[k] += middle * out[k + 1];
  double power = 1.0;
  for (Eigen::Index k = 0; k <= n; ++k, power *= half_width) out[k] *= power;
  return out;
}

double definite_integral(const ConstPolynomial& a) {
  double sum = 0.0;
  for (Eigen::Index k = 0; k < a.size(); k += 2) sum += 2.0 * a[k] / (k + 1.0);
  return sum;
}

double definite_integral_of_square(const ConstPolynomial& a) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < a.size(); ++i)
    for (Eigen::Index k = i % 2; k < a.size(); k += 2) sum += 2.0 * a[i] * a[k] / (i + k + 1.0);
  return sum;
}

const Eigen::MatrixXd& bernstein_matrix(int degree) {
  if (degree < 0 || degree > max_degree)
    throw InvalidInput("degree", "must be in 0.." + text(max_degree), text(degree));
  static const std::vector<Eigen::MatrixXd> matrices = [] {
    std::vector<Eigen::MatrixXd> out;
    for (int n = 0; n <= max_degree; ++n) out.push_back(build_bernstein_matrix(n));
    return out;
  }();
  return matrices[degree];
}

void halve_bernstein(const ConstPolynomial& b, Eigen::Ref<Eigen::VectorXd> left, Eigen::Ref<Eigen::VectorXd> right) {
  Row out_left, out_right;
  const Eigen::Index size = b.size();
  halve(b.data(), static_cast<int>(size) - 1, out_left.data(), out_right.data());
  left = Eigen::Map<const Eigen::VectorXd>(out_left.data(), size);
  right = Eigen::Map<const Eigen::VectorXd>(out_right.data(), size);
}

Places roots(const ConstPolynomial& a) {
  const int n = static_cast<int>(a.size()) - 1;
  Places places;
  if (n < 1) return places;
  const double zero = 4.0 * (n + 1) * kRoundoff * a.cwiseAbs().sum();

  struct Piece {
    double low, high;
    Row b;
  };
  constexpr int deepest = 32;  // pieces of width 2^-31: what varies inside is below rounding
  std::array<Piece, deepest + 2> stack;
  int top = 0;
  stack[0].low = -1.0;
  stack[0].high = 1.0;
  Eigen::Map<Eigen::VectorXd>(stack[0].b.data(), n + 1).noalias() = bernstein_matrix(n).lazyProduct(a);
  while (top >= 0) {
    Piece& piece = stack[top];
    const int variations = sign_variations(piece.b, n, zero);
    if (variations == 0) {
      --top;
    } else if (variations == 1) {
      double last = 0.0;
      for (int i = 0; i <= n; ++i)
        if (std::abs(piece.b[i]) > zero) last = piece.b[i];
      add(places, refine(a.data(), n, piece.low, piece.high, last > 0.0));
      --top;
    } else if (piece.high - piece.low < 4.0 / (1ULL << deepest)) {
      add(places, 0.5 * (piece.low + piece.high));
      --top;
    } else {
      // The left half goes on top: places come in ascending order, but for the middle, which is sorted in below.
      const double middle = 0.5 * (piece.low + piece.high);
      Piece& next = stack[top + 1];
      next.low = piece.low;
      next.high = middle;
      halve(piece.b.data(), n, next.b.data(), piece.b.data());
      piece.low = middle;
      if (std::abs(piece.b[0]) <= zero) add(places, middle);
      ++top;
    }
  }
  std::sort(places.s.begin(), places.s.begin() + places.count);
  return places;
}

Extrema extrema(const ConstPolynomial& a) {
  const int n = static_cast<int>(a.size()) - 1;
  Extrema out;
  out.min = out.max = horner(a.data(), n, -1.0);
  const auto look = [&](double s) {
    const double value = horner(a.data(), n, s);
    if (value < out.min) {
      out.min = value;
      out.at_min = s;
    }
    if (value > out.max) {
      out.max = value;
      out.at_max = s;
    }
  };
  look(1.0);
  if (n < 2) return out;
  Row slope;
  for (int k = 1; k <= n; ++k) slope[k - 1] = k * a[k];
  const Places stationary = roots(Eigen::Map<const Eigen::VectorXd>(slope.data(), n));
  for (int i = 0; i < stationary.count; ++i) look(stationary.s[i]);
  return out;
}

}  // namespace mcplan::sip
