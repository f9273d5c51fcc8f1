#include "ddp/moment_limits.hpp"

#include "costs/check_rows.hpp"

namespace {

using namespace support;

enum { before, after, right_pad, left_pad, slope };

}  // namespace

TEST_CASE("a sole twists with its half width for a lever; points and what is held are not judged by one") {
  const ddp::Problem problem = workshop();
  CHECK(torsion_arm(problem, 1, before) == doctest::Approx((0.7 - 0.02) * 0.05 / 0.7));
  CHECK(std::isinf(torsion_arm(problem, 2, right_pad)));
  CHECK(std::isinf(torsion_arm(problem, 2, before)));
}

TEST_CASE("moments that contact wrenches can have are about the surface's normal") {
  for (ddp::Model model : kModels) {
    const ddp::Problem problem = workshop(phases(6, model));
    for (const ddp::Layout::Moment& moment : problem.layout.moments()) {
      const bool vertical = moment.direction_W == Eigen::Vector3d::UnitZ();
      CHECK(about_normal(problem, moment, before) == (model == ddp::Model::lipm || vertical));
      CHECK(about_normal(problem, moment, slope) == (model == ddp::Model::lipm));
    }
  }
}
