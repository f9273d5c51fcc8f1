#include "planar/sip/attempts.hpp"

#include <doctest/doctest.h>

#include <string>

#include "mcplan/base/error.hpp"
#include "mcplan/planar/plan_files.hpp"
#include "mcplan/planar/sip/certificate.hpp"
#include "mcplan/planar/sip/planner.hpp"
#include "tasks.hpp"

using namespace mcplan::sip;
using mcplan::Status;
using mcplan::nlp::Solver;

namespace {

Options with(Solver solver, Forces forces, bool cost) {
  Options options;
  options.solver = solver;
  options.forces = forces;
  if (!cost) options.torque_weight = 0.0;
  return options;
}

}  // namespace

TEST_CASE("Ipopt comes alone, the kernel alone, and after it where both may be asked") {
  for (const bool cost : {false, true}) {
    Options options;
    CHECK(attempts_for(options, cost).front().solver == Solver::ipopt);
    options.solver = Solver::ipm;
    CHECK(attempts_for(options, cost).size() == 1);
    CHECK(attempts_for(options, cost).front().solver == Solver::ipm);
    options.solver = Solver::automatic;
    CHECK(attempts_for(options, cost).front().solver == Solver::ipm);
    CHECK(attempts_for(options, cost).back().solver == Solver::ipopt);
  }
}

TEST_CASE("the kernel finds motions within all constraints, whatever the weights of forces, and says that it did") {
  for (const Forces forces : {Forces::uniform, Forces::per_body, Forces::per_point}) {
    CAPTURE(static_cast<int>(forces));
    const Result result = Planner(planar_tasks::cartwheel(), with(Solver::ipm, forces, false)).solve();
    CHECK_MESSAGE(result.report.status == Status::solved, result.report.message);
    CHECK(result.solver == Solver::ipm);
    CHECK(check(result.plan).ok());
  }
}

TEST_CASE("the kernel's cheapest cartwheel costs what Ipopt's does, and is proved") {
  const Result reference = Planner(planar_tasks::cartwheel(), with(Solver::ipopt, Forces::per_point, true)).solve();
  const Result result = Planner(planar_tasks::cartwheel(), with(Solver::ipm, Forces::per_point, true)).solve();
  REQUIRE(reference.report.status == Status::solved);
  CHECK_MESSAGE(result.report.status == Status::solved, result.report.message);
  CHECK(reference.solver == Solver::ipopt);
  CHECK(result.solver == Solver::ipm);
  CHECK(result.report.cost <= 1.01 * reference.report.cost);
  CHECK(certify(result.plan).proved());
  // The same bytes again, and with both allowed, since the kernel does not fail.
  CHECK(Planner(planar_tasks::cartwheel(), with(Solver::ipm, Forces::per_point, true)).solve().plan == result.plan);
  CHECK(Planner(planar_tasks::cartwheel(), with(Solver::automatic, Forces::per_point, true)).solve().plan ==
        result.plan);
}

TEST_CASE("second derivatives may be chosen for the kernel, but it has no history of them") {
  Options options = with(Solver::ipm, Forces::uniform, true);
  for (const HessianChoice hessian : {HessianChoice::exact, HessianChoice::gauss_newton}) {
    options.hessian = hessian;
    CHECK_NOTHROW(options.validate());
    CHECK(attempts_for(options, true).front().hessian == hessian);
    CHECK_FALSE(attempts_for(options, true).front().kernel.blend_hessians);
  }
  options.hessian = HessianChoice::limited_memory;
  std::string field;
  try {
    options.validate();
  } catch (const mcplan::InvalidOptions& error) {
    field = error.field();
  }
  CHECK(field == "hessian");
}
