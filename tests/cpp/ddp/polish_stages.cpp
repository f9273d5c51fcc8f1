#include <doctest/doctest.h>

#include "ddp/support.hpp"
#include "mcplan/ddp/plan.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;

mcplan::PlanResult planned(const mcplan::Scene& scene, Polish polish, int threads) {
  Options options;
  options.polish = polish;
  options.threads = threads;
  return plan(scene, scenes::humanoid44(), options);
}

}  // namespace

TEST_CASE("with the interior point stairs are planned at no higher cost, the same for any number of threads") {
  const mcplan::PlanResult penalty = planned(scenes::stairs(), Polish::penalty, 1);
  const mcplan::PlanResult one = planned(scenes::stairs(), Polish::interior_point, 1);
  const mcplan::PlanResult two = planned(scenes::stairs(), Polish::interior_point, 2);
  CHECK(one.report.status == mcplan::Status::solved);
  CHECK(one.report.cost <= penalty.report.cost);
  REQUIRE(one.plan.knots.size() == two.plan.knots.size());
  for (std::size_t k = 0; k < one.plan.knots.size(); ++k) {
    CHECK(one.plan.knots[k].com_W == two.plan.knots[k].com_W);
    CHECK(one.plan.knots[k].angular_momentum_W == two.plan.knots[k].angular_momentum_W);
  }
}
