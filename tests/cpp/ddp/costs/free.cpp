#include "check_rows.hpp"

namespace {

using namespace support;

}  // namespace

TEST_CASE("free: gradients") {
  for (ddp::Model model : kModels) {
    const ddp::Problem problem = workshop(phases(6, model));
    check_rows(problem, term(problem, "free"), 47, 0.5, 10);
  }
}

TEST_CASE("free: no stiffness and no moment of this end-effector, whatever the others do") {
  for (ddp::Model model : kModels) {
    const ddp::Problem problem = workshop(phases(6, model));
    const ddp::Layout& at = problem.layout;
    VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Ones(at.nu());
    Rows rows(at.nz(), true);
    const Writer free = term(problem, "free");
    free(x, u, rows);
    CHECK(rows.cost() == doctest::Approx(0.5 * 9.0 * 4));  // one stiffness, three moments
    u[at.stiffness(1)] = 0.0;
    for (int i = 0; i < at.moment_count(); ++i)
      if (at.moments()[i].end_effector == 1) u[at.moment(i)] = 0.0;
    rows.clear();
    free(x, u, rows);
    CHECK(rows.cost() == 0.0);
  }
}
