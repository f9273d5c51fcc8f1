#include "check_rows.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

}  // namespace

TEST_CASE("a free end-effector is kept out of the solids, at their outline and down to twice their thickness") {
  const ddp::Problem problem = workshop();
  const ddp::Layout& at = problem.layout;
  const Writer keep_out = term(problem, "keep_out", {2, 1, ddp::kFree, 100.0, 3.0});
  check_rows(problem, keep_out, 52, 0.3, 10);
  const auto price = [&](const Vector3d& position_W) {
    VectorXd x = VectorXd::Zero(at.nx());
    x.segment<3>(at.end(1)) = position_W / 0.7;
    return cost(problem, keep_out, x, VectorXd()) / (0.5 * 3.0 * 3.0);
  };
  CHECK(price({0.0, 0.0, 0.01}) == 0.0);
  CHECK(price({0.0, 0.0, -0.07}) == doctest::Approx(0.01));
  CHECK(price({0.0, 0.0, -0.11}) == 0.0);  // below the solid
  CHECK(price({0.9, 0.0, -0.07}) == 0.0);  // in the gap
  // A foothold put onto the edge of the tread below is beside the next one, inside by rounding or not.
  const mcplan::Polygon& floor = problem.polygons[0];
  Vector3d edge = 0.7 * 0.5 * (floor.vertices_W()[0] + floor.vertices_W()[1]), inward = 0.7 * floor.centroid_W() - edge;
  edge.z() = -0.07;
  CHECK(price(edge) == 0.0);
  CHECK(price(edge + 1e-5 * inward.normalized()) == 0.0);
  CHECK(price(edge + 0.01 * inward.normalized()) == doctest::Approx(0.01));
  CHECK(price({0.9, -0.4, 0.43}) == doctest::Approx(0.01));  // a foot in a pad
}
