#include "check_rows.hpp"

namespace {

using namespace support;

Writer task_at(const ddp::Problem& problem, int k) {
  return [&problem, k](const VectorXd& x, const VectorXd& u, Rows& rows) {
    task_cost(problem, k, x, k == problem.steps ? nullptr : &u, rows);
  };
}

}  // namespace

TEST_CASE("task cost: gradients") {
  const ddp::Problem problem = workshop();
  for (int k : {0, 3, problem.steps}) check_rows(problem, task_at(problem, k), 41, 0.3, 30);
}

TEST_CASE("task cost is Table I's weights on the distance to the reference") {
  ddp::Options options = phases(6);
  ddp::Weights& w = options.weights;
  w.com = 2, w.com_end = 3, w.velocity = 5, w.velocity_end = 7, w.rotation = 11, w.rotation_end = 13;
  w.end_effector = 17, w.end_effector_end = 19, w.stride = 23, w.stiffness = 29, w.moment = 31;
  for (ddp::Method method : {ddp::Method::standard, ddp::Method::paper}) {
    options.method = method;
    const ddp::Problem problem = workshop(options);
    const ddp::Layout& at = problem.layout;
    const VectorXd u0 = VectorXd::Zero(at.nu());
    for (int k : {0, 3, 6}) {
      const bool end = k == 0 || k == 6;
      const auto price = [&](int i) {
        VectorXd x = problem.reference.x[k];
        x[i] += 0.1;
        return cost(problem, task_at(problem, k), x, u0) / (0.5 * 0.1 * 0.1);
      };
      // The start is a fact, not a wish, but for the paper and for the CoM, which must fall to begin a walk.
      const bool pinned = k == 0 && method == ddp::Method::standard;
      const auto squared = [&](double inside, double at_end) { return std::pow(end ? at_end : inside, 2); };
      CHECK(price(at.com() + 2) == doctest::Approx(squared(2, 3)));
      CHECK(price(at.velocity()) == doctest::Approx(pinned ? 1e6 : squared(5, 7)));
      CHECK(price(at.angle(1)) == doctest::Approx(pinned ? 1e6 : squared(11, 13)));
      CHECK(price(at.rate(2)) == doctest::Approx(pinned ? 1e6 : squared(11, 13)));
      CHECK(price(at.end(1) + 1) == doctest::Approx(pinned ? 1e6 : squared(17, 19)));
      CHECK(cost(problem, task_at(problem, k), problem.reference.x[k], u0) == 0.0);
      if (k == 6) continue;
      const auto input = [&](int i) {
        VectorXd u = u0;
        u[i] = 0.1;
        return cost(problem, task_at(problem, k), problem.reference.x[k], u) / (0.5 * 0.1 * 0.1);
      };
      CHECK(input(at.stride(1)) == doctest::Approx(23 * 23));
      CHECK(input(at.stiffness(1)) == doctest::Approx(29 * 29));
      CHECK(input(at.moment(1)) == doctest::Approx(31 * 31));
      CHECK(input(at.duration()) == 0.0);
    }
  }
}
