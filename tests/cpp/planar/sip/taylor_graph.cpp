#include "planar/sip/taylor_graph.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <random>

using mcplan::sip::TaylorGraph;
using Node = TaylorGraph::Node;

namespace {

using Series = std::vector<long double>;

/// Coefficients 0..n of the product of two series, each taken to be zero beyond its end.
Series product(const Series& a, const Series& b, int n) {
  Series out(n + 1, 0.0L);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      if (static_cast<int>(i + j) <= n) out[i + j] += a[i] * b[j];
  return out;
}

/// sin and cos of a polynomial to order n, by the series of exp(i x) of what remains without the constant.
std::pair<Series, Series> sine_cosine(const Series& angle, int n) {
  Series rest = angle;
  rest[0] = 0.0L;
  Series sine(n + 1, 0.0L), cosine(n + 1, 0.0L), power{1.0L};
  long double factor = 1.0L;
  for (int k = 0; k <= n; ++k) {  // rest^k starts with s^k
    Series& to = k % 2 == 0 ? cosine : sine;
    for (std::size_t i = 0; i < power.size(); ++i) to[i] += (k % 4 < 2 ? factor : -factor) * power[i];
    power = product(power, rest, n);
    factor /= k + 1;
  }
  const long double s = std::sin(angle[0]), c = std::cos(angle[0]);
  Series out_sine(n + 1), out_cosine(n + 1);
  for (int k = 0; k <= n; ++k) {
    out_sine[k] = s * cosine[k] + c * sine[k];
    out_cosine[k] = c * cosine[k] - s * sine[k];
  }
  return {out_sine, out_cosine};
}

Series random_series(std::mt19937& random, int order) {
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  Series out(order + 1);
  for (long double& a : out) a = draw(random);
  return out;
}

Node input(TaylorGraph& graph, const Series& a) {
  const Node node = graph.input(static_cast<int>(a.size()) - 1, {});
  for (std::size_t k = 0; k < a.size(); ++k)
    graph.input_of(node).coefficients[static_cast<int>(k)] = static_cast<double>(a[k]);
  return node;
}

void check_same(const TaylorGraph& graph, const TaylorGraph::Workspace& work, Node node, const Series& expected) {
  const auto a = graph.coefficients(work, node);
  REQUIRE(a.size() == static_cast<int>(expected.size()));
  for (int k = 0; k < a.size(); ++k) {
    CAPTURE(k);
    CHECK(a[k] == doctest::Approx(static_cast<double>(expected[k])).epsilon(1e-13).scale(1.0));
  }
}

constexpr int kParameters = 6;

/// A graph of random operations on inputs that are random quadratic functions of the parameters.
class RandomGraph {
 public:
  explicit RandomGraph(unsigned seed) : graph(kParameters), random_(seed) {
    for (int i = 0; i < 4; ++i) add_input(i);
    for (int i = 0; i < 16; ++i) add_operation();
    for (int k = 0; k < 3; ++k) outputs.push_back(graph.size() - 1 - k);
    outputs.push_back(pick());
  }

  void set(const Eigen::VectorXd& x) {
    for (const Quadratic& q : inputs_) {
      const std::vector<int>& columns = graph.columns(q.node);
      const int width = static_cast<int>(columns.size());
      Eigen::VectorXd local(width);
      for (int c = 0; c < width; ++c) local[c] = x[columns[c]];
      TaylorGraph::Input& in = graph.input_of(q.node);
      for (int k = 0; k <= graph.order(q.node); ++k) {
        in.coefficients[k] = q.constant[k] + q.linear.row(k) * local + 0.5 * local.dot(q.curvature[k] * local);
        in.tangents.row(k) = q.linear.row(k) + (q.curvature[k] * local).transpose();
      }
      in.curvature = q.curvature;
    }
  }

  TaylorGraph graph;
  std::vector<Node> outputs;

 private:
  struct Quadratic {
    Node node;
    Eigen::VectorXd constant;
    Eigen::MatrixXd linear;
    std::vector<Eigen::MatrixXd> curvature;
  };

  double draw() { return std::uniform_real_distribution<double>(-0.7, 0.7)(random_); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
  Node pick() { return below(graph.size()); }

  void add_input(int i) {
    std::vector<int> columns;
    for (int c = kParameters - 1; c >= 0; --c)  // in descending order: the graph sorts them
      if (i == 0 || below(2) == 0) columns.push_back(c);
    const int order = below(4), width = static_cast<int>(columns.size());
    Quadratic q{graph.input(order, columns), Eigen::VectorXd(order + 1), Eigen::MatrixXd(order + 1, width), {}};
    for (double& a : q.constant) a = draw();
    for (double& a : q.linear.reshaped()) a = draw();
    for (int k = 0; k <= order; ++k) {
      Eigen::MatrixXd H(width, width);
      for (double& a : H.reshaped()) a = draw();
      q.curvature.push_back(H + H.transpose());
    }
    inputs_.push_back(q);
  }

  void add_operation() {
    const int order = 1 + below(9);
    switch (below(6)) {
      case 0:
        graph.linear({{draw(), pick()}, {draw(), pick()}, {draw(), pick()}}, draw(), below(2) == 0 ? -1 : order);
        break;
      case 1:
        graph.product(pick(), pick(), order);
        break;
      case 2: {
        const Node node = pick();
        graph.product(node, node, order);
        break;
      }
      case 3: {  // of something small: sines of large polynomials have huge coefficients
        const Node angle = graph.linear({{0.3, pick()}}, draw(), 3);
        graph.sin_cos(angle, order);
        break;
      }
      case 4:
        graph.derivative(pick(), 1 + below(2));
        break;
      default:
        graph.integral(pick(), order);
    }
  }

  std::mt19937 random_;
  std::vector<Quadratic> inputs_;
};

Eigen::VectorXd random_point(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> draw(-0.8, 0.8);
  Eigen::VectorXd x(kParameters);
  for (double& value : x) value = draw(random);
  return x;
}

}  // namespace

TEST_CASE("products, truncated or not, of factors of different orders") {
  std::mt19937 random(1);
  for (int trial = 0; trial < 60; ++trial) {
    const int n = trial % 7, m = trial % 5, order = trial % 13;
    const Series a = random_series(random, n), b = random_series(random, m);
    TaylorGraph graph(0);
    const Node left = input(graph, a), right = input(graph, b);
    const Node ab = graph.product(left, right, order), ba = graph.product(right, left, order);
    const Node aa = graph.product(left, left, order);
    TaylorGraph::Workspace work;
    graph.evaluate(work, false);
    CAPTURE(trial);
    check_same(graph, work, ab, product(a, b, std::min(order, n + m)));
    check_same(graph, work, ba, product(a, b, std::min(order, n + m)));
    check_same(graph, work, aa, product(a, a, std::min(order, 2 * n)));
  }
}

TEST_CASE("sine and cosine of a polynomial have the coefficients of the composed series") {
  std::mt19937 random(2);
  for (int order = 0; order <= TaylorGraph::kMaxOrder; ++order)
    for (int degree = 0; degree <= 5; ++degree) {
      const Series angle = random_series(random, degree);
      TaylorGraph graph(0);
      const auto [sine, cosine] = graph.sin_cos(input(graph, angle), order);
      TaylorGraph::Workspace work;
      graph.evaluate(work, false);
      const auto [expected_sine, expected_cosine] = sine_cosine(angle, order);
      CAPTURE(order);
      CAPTURE(degree);
      check_same(graph, work, sine, expected_sine);
      check_same(graph, work, cosine, expected_cosine);
    }
}

TEST_CASE("linear combinations, derivatives and integrals") {
  std::mt19937 random(3);
  const Series a = random_series(random, 6), b = random_series(random, 2);
  TaylorGraph graph(0);
  const Node p = input(graph, a), q = input(graph, b);
  const Node sum = graph.linear({{2.0, p}, {-3.0, q}, {0.0, p}}, 0.5),
             cut = graph.linear({{2.0, p}, {-3.0, q}}, 0.5, 4);
  const Node constant = graph.constant(7.0), nothing = graph.linear({{0.0, p}});
  const Node first = graph.derivative(p), third = graph.derivative(p, 3), gone = graph.derivative(q, 3);
  const Node integral = graph.integral(p, 20), short_integral = graph.integral(p, 4);
  TaylorGraph::Workspace work;
  graph.evaluate(work, true);

  Series expected = a;
  for (long double& x : expected) x *= 2.0L;
  for (int k = 0; k < 3; ++k) expected[k] -= 3.0L * b[k];
  expected[0] += 0.5L;
  check_same(graph, work, sum, expected);
  check_same(graph, work, cut, Series(expected.begin(), expected.begin() + 5));
  check_same(graph, work, constant, {7.0L});
  check_same(graph, work, nothing, {0.0L});
  check_same(graph, work, first, {a[1], 2 * a[2], 3 * a[3], 4 * a[4], 5 * a[5], 6 * a[6]});
  check_same(graph, work, third, {6 * a[3], 24 * a[4], 60 * a[5], 120 * a[6]});
  check_same(graph, work, gone, {0.0L});
  check_same(graph, work, integral, {0.0L, a[0], a[1] / 2, a[2] / 3, a[3] / 4, a[4] / 5, a[5] / 6, a[6] / 7});
  check_same(graph, work, short_integral, {0.0L, a[0], a[1] / 2, a[2] / 3, a[3] / 4});
}

TEST_CASE("a node's columns are those that its operands touch") {
  TaylorGraph graph(8);
  const Node a = graph.input(2, {5, 1}), b = graph.input(1, {3}), c = graph.constant(1.0);
  CHECK(graph.columns(a) == std::vector<int>{1, 5});
  CHECK(graph.columns(graph.product(a, b, 9)) == std::vector<int>{1, 3, 5});
  CHECK(graph.columns(graph.linear({{1.0, b}, {0.0, a}})) == std::vector<int>{3});
  CHECK(graph.columns(graph.sin_cos(b, 4).second) == std::vector<int>{3});
  CHECK(graph.columns(graph.product(c, b, 3)) == std::vector<int>{3});
  CHECK(graph.columns(c).empty());
}

TEST_CASE("derivatives of random graphs agree with central differences") {
  TaylorGraph::Workspace work;  // one for all graphs: what an earlier one left behind does not matter
  for (unsigned seed = 0; seed < 200; ++seed) {
    RandomGraph fuzz(seed);
    const TaylorGraph& graph = fuzz.graph;
    const Eigen::VectorXd x = random_point(seed);
    std::mt19937 random(seed + 1000);
    std::uniform_real_distribution<double> draw(-1.0, 1.0);
    std::vector<Eigen::VectorXd> weights;
    for (Node node : fuzz.outputs) {
      Eigen::VectorXd w(graph.order(node) + 1);
      for (double& value : w) value = draw(random);
      weights.push_back(w);
    }
    /// Gradient of the weighted sum of coefficients, from the tangents.
    const auto gradient = [&](const Eigen::VectorXd& at) {
      fuzz.set(at);
      graph.evaluate(work, true);
      Eigen::VectorXd out = Eigen::VectorXd::Zero(kParameters);
      for (std::size_t i = 0; i < weights.size(); ++i) {
        const Eigen::VectorXd local = graph.tangents(work, fuzz.outputs[i]).transpose() * weights[i];
        const std::vector<int>& columns = graph.columns(fuzz.outputs[i]);
        for (int c = 0; c < local.size(); ++c) out[columns[c]] += local[c];
      }
      return out;
    };
    const auto sum = [&](const Eigen::VectorXd& at) {
      fuzz.set(at);
      graph.evaluate(work, false);
      double out = 0.0;
      for (std::size_t i = 0; i < weights.size(); ++i) out += weights[i].dot(graph.coefficients(work, fuzz.outputs[i]));
      return out;
    };

    const Eigen::VectorXd slope = gradient(x);
    graph.clear_adjoints(work);
    for (std::size_t i = 0; i < weights.size(); ++i) graph.adjoints(work, fuzz.outputs[i]) += weights[i];
    Eigen::MatrixXd H(kParameters, kParameters);
    graph.hessian(work, H);
    CAPTURE(seed);
    CHECK((H - H.transpose()).cwiseAbs().maxCoeff() <= 1e-12 * (1.0 + H.cwiseAbs().maxCoeff()));
    const double step = 1e-5;
    for (int i = 0; i < kParameters; ++i) {
      CAPTURE(i);
      Eigen::VectorXd above = x, below = x;
      above[i] += step;
      below[i] -= step;
      CHECK(slope[i] == doctest::Approx((sum(above) - sum(below)) / (2.0 * step))
                            .epsilon(1e-6)
                            .scale(1.0 + slope.cwiseAbs().maxCoeff()));
      const Eigen::VectorXd bend = (gradient(above) - gradient(below)) / (2.0 * step);
      CHECK((H.col(i) - bend).cwiseAbs().maxCoeff() <= 1e-6 * (1.0 + H.cwiseAbs().maxCoeff()));
    }
  }
}
