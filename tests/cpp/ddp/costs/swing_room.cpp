#include "check_rows.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

}  // namespace

TEST_CASE("a swing passes beside what is too high to be stepped over, with room for its sole, and over what is not") {
  mcplan::Scene scene = scenes::flat();
  mcplan::Surface post = scenes::rectangle("post", 0.9, 1.0, 0.05, 0.15, 1.4, "hand");
  post.thickness = 1.4;
  mcplan::Surface kerb = scenes::rectangle("kerb", 0.9, 1.0, -0.2, -0.1, 0.1, "hand");
  kerb.thickness = 0.1;
  scene.surfaces.push_back(post);
  scene.surfaces.push_back(kerb);
  const ddp::Problem problem(scene, scenes::humanoid44(), phases(6));
  const ddp::Layout& at = problem.layout;
  const Writer room = term(problem, "swing_room", {2, 1, ddp::kFree, 100.0, 3.0});
  const auto price = [&](double y) {  // of a swing from x = 0.75 to 1.15 whose middle alone is next to the post
    VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
    x.segment<3>(at.end(1)) = Vector3d(0.75, y, 0.0) / 0.7;
    u.segment<3>(at.stride(1)) = Vector3d(0.4, 0.0, 0.0) / 0.7;
    u[at.duration()] = 1.0;
    return cost(problem, room, x, u);
  };
  const auto beside = [](double distance) {  // of the three points: 0.85, 0.95, 1.05 along the way
    const double needed = 0.1 + 0.02 * 0.7, ends = std::hypot(distance, 0.05);
    double sum = 0.0;
    for (double d : {distance, ends, ends}) sum += d < needed ? (d - needed) * (d - needed) : 0.0;
    return 0.5 * 9.0 * sum / (0.7 * 0.7);
  };
  CHECK(price(-0.07) == 0.0);
  CHECK(price(0.0) == doctest::Approx(beside(0.05)));
  CHECK(price(0.03) == doctest::Approx(beside(0.02)));
  CHECK(price(-0.15) == 0.0);  // over the kerb
  check_rows(problem, room, 5, 0.4, 10);
}
