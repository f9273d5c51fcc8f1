#include "planar/sip/interval_model.hpp"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "interval.hpp"

using namespace mcplan::sip;
using mcplan::PlanarTask;

namespace {

Options with(Forces forces, bool free_durations = true) {
  Options options;
  options.forces = forces;
  options.free_durations = free_durations;
  options.torque_weight = 1e-3;
  options.jerk_weight = 1e-6;
  return options;
}

/// An interval's model with its parameters.
struct Model {
  Model(const PlanarTask& of, const Options& with, int k, unsigned seed)
      : at(of, with, k, gentle(of, with, seed)),
        model(at.task, at.options, at.layout, k, std::make_shared<TaylorGraph::Workspace>()),
        x(model.local().count()) {
    for (int i = 0; i < x.size(); ++i) x[i] = at.x[model.local().variables[i]];
  }

  static Eigen::VectorXd gentle(const PlanarTask& task, const Options& options, unsigned seed) {
    Eigen::VectorXd x = random_parameters(task, options, seed);
    x.head(Layout(task, options).first_duration) *= 0.3;
    return x;
  }

  IntervalAt at;
  IntervalModel model;
  Eigen::VectorXd x;
};

/// Integral over the interval by Simpson's rule.
template <class Function>
double integral(const IntervalAt& at, const Function& f) {
  constexpr int kPieces = 40;
  double sum = 0.0;
  for (int i = 0; i <= 2 * kPieces; ++i)
    sum += (i == 0 || i == 2 * kPieces ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * f(-1.0 + i / static_cast<double>(kPieces));
  return 0.5 * at.plan.interval_lengths()[at.motion.local.interval] * sum / (3.0 * kPieces);
}

}  // namespace

TEST_CASE("costs are integrals of exact torques and jerks") {
  for (int number : {1, 2, 3})
    for (bool free : {false, true}) {
      Options options = with(Forces::per_point, free);
      options.order = 12;
      for (int k : {0, 4, 7}) {
        Model m(planar_tasks::paper_task(number), options, k, 3);
        const double torque = integral(m.at, [&](double s) { return m.at.exact(s).torque.squaredNorm(); });
        CHECK(m.model.cost_term(m.x, false) == doctest::Approx(torque).epsilon(1e-5));
        // The jerk of a cubic is constant: the slope of its acceleration.
        const double length = m.at.plan.interval_lengths()[k];
        const Eigen::VectorXd jerk =
            (m.at.exact(1.0).configuration.acceleration - m.at.exact(-1.0).configuration.acceleration) / length;
        CHECK(m.model.cost_term(m.x, true) == doctest::Approx(length * jerk.squaredNorm()).epsilon(1e-6));
        CHECK(m.model.cost(m.x) ==
              doctest::Approx(1e-3 * m.model.cost_term(m.x, false) + 1e-6 * m.model.cost_term(m.x, true)));
      }
    }
}

TEST_CASE("the Gauss-Newton part is positive semidefinite and what is left of the Hessian where residuals are linear") {
  for (int number : {1, 2, 3}) {
    Model m(planar_tasks::paper_task(number), with(Forces::per_point), 4, 5);
    const int n = static_cast<int>(m.x.size());
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(n, n);
    m.model.add_cost_hessian(m.x, 1.0, false, H);
    CHECK((H - H.transpose()).norm() <= 1e-12 * H.norm());
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(H).eigenvalues();
    CHECK(values.maxCoeff() > 0.0);
    CHECK(values.minCoeff() >= -1e-10 * values.maxCoeff());
  }
  // Jerks alone are linear in the control points: there the two Hessians agree.
  Options jerk = with(Forces::uniform);
  jerk.torque_weight = 0.0;
  Model m(planar_tasks::cartwheel(), jerk, 4, 6);
  const int n = static_cast<int>(m.x.size()), controls = m.model.local().duration_column(0);
  Eigen::MatrixXd exact = Eigen::MatrixXd::Zero(n, n), gauss_newton = exact;
  m.model.add_cost_hessian(m.x, 1.0, true, exact);
  m.model.add_cost_hessian(m.x, 1.0, false, gauss_newton);
  CHECK((exact - gauss_newton).topLeftCorner(controls, controls).norm() <= 1e-12 * exact.norm());
}

TEST_CASE("Hessians are added to what is there") {
  Model m(planar_tasks::cartwheel(), with(Forces::per_body), 2, 7);
  const int n = static_cast<int>(m.x.size());
  const Eigen::VectorXd weights = Eigen::VectorXd::LinSpaced(m.model.rows().count(), -1.0, 1.0);
  Eigen::MatrixXd once = Eigen::MatrixXd::Zero(n, n), on_top = Eigen::MatrixXd::Ones(n, n);
  m.model.add_row_hessian(m.x, weights, once);
  m.model.add_row_hessian(m.x, weights, on_top);
  CHECK((on_top - once - Eigen::MatrixXd::Ones(n, n)).norm() <= 1e-12 * once.norm());
  once.setZero();
  on_top.setOnes();
  m.model.add_cost_hessian(m.x, 0.5, true, once);
  m.model.add_cost_hessian(m.x, 0.5, true, on_top);
  CHECK((on_top - once - Eigen::MatrixXd::Ones(n, n)).norm() <= 1e-12 * once.norm());
}

TEST_CASE("what is remembered of a point is that point's, in whatever order it is asked") {
  const Options options = with(Forces::per_point);
  const auto shared = std::make_shared<TaylorGraph::Workspace>();
  Model m(planar_tasks::cartwheel(), options, 5, 8);
  IntervalModel other(m.at.task, m.at.options, m.at.layout, 1, shared),
      same(m.at.task, m.at.options, m.at.layout, 5, shared);
  const Eigen::VectorXd y = 1.1 * m.x, z = Eigen::VectorXd::Constant(other.local().count(), 0.3);
  const Eigen::VectorXd rows_x = m.model.row_values(m.x), rows_y = m.model.row_values(y);
  const Eigen::MatrixXd jacobian_x = m.model.row_jacobian(m.x);
  const double cost_x = m.model.cost(m.x), cost_y = m.model.cost(y);

  CHECK(same.cost(y) == cost_y);
  other.row_jacobian(z);  // in the same workspace
  CHECK(same.row_values(y) == rows_y);
  CHECK((same.row_jacobian(m.x) - jacobian_x).norm() <= 1e-12 * jacobian_x.norm());
  other.cost(z);
  CHECK((same.row_values(m.x) - rows_x).norm() <= 1e-12 * rows_x.norm());
  CHECK(same.cost(m.x) == doctest::Approx(cost_x).epsilon(1e-12));
  same.cost_term(y, false);
  CHECK((same.row_jacobian(m.x) - jacobian_x).norm() <= 1e-12 * jacobian_x.norm());
}
