#include "check_rows.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

/// Level ground and a tread of 0.2 m from x = 0.5 m on.
ddp::Problem with_tread() {
  mcplan::Scene scene = scenes::made_of(
      "tread", {scenes::rectangle("ground", -1, 0.5, -1, 1, 0), scenes::rectangle("tread", 0.5, 2, -1, 1, 0.2)},
      "ground", "tread", {1.0, 0.0, 0.2});
  for (mcplan::Surface& surface : scene.surfaces) surface.thickness = 0.2;
  return ddp::Problem(scene, scenes::humanoid44(), phases(6));
}

About swinging() {
  About about{2, 1, ddp::kFree, 100.0, 3.0};
  about.clear_swings = true;
  return about;
}

}  // namespace

TEST_CASE("a swing lifts off far enough from a riser for its toe, and lands far enough behind it for its heel") {
  const ddp::Problem problem = with_tread();
  const ddp::Layout& at = problem.layout;
  const auto price = [&](double from, double to, bool asked = true) {
    About about = swinging();
    about.clear_swings = asked;
    const Writer path = term(problem, "swing_path", about);
    VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
    x.segment<3>(at.com()) = Vector3d(0.4, 0.0, 0.9) / 0.7;
    x.segment<3>(at.end(1)) = Vector3d(from, 0.1, 0.0) / 0.7;
    u.segment<3>(at.stride(1)) = Vector3d(to - from, 0.0, 0.2) / 0.7;
    u[at.duration()] = 1e-3;  // the CoM does not fall
    return cost(problem, path, x, u);
  };
  CHECK(price(0.35, 0.7) == 0.0);
  CHECK(price(0.45, 0.7) > 1e-3);  // the toe is 5 cm under the tread when it begins to rise
  CHECK(price(0.48, 0.7) > price(0.45, 0.7));
  CHECK(price(0.45, 0.7, false) == 0.0);
  CHECK(price(0.1, 0.3) == 0.0);  // nothing lies between
}

TEST_CASE("a swing that the reach box keeps low asks the CoM to rise") {
  const ddp::Problem problem = with_tread();
  const ddp::Layout& at = problem.layout;
  const Writer path = term(problem, "swing_path", swinging());
  VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
  x.segment<3>(at.end(1)) = Vector3d(0.3, 0.1, 0.0) / 0.7;
  u.segment<3>(at.stride(1)) = Vector3d(0.55, 0.0, 0.2) / 0.7;
  u[at.duration()] = 1e-3;
  const auto at_height = [&](double height) {
    x.segment<3>(at.com()) = Vector3d(0.5, 0.0, height) / 0.7;
    return cost(problem, path, x, u);
  };
  // The foot comes up to 0.55 m below the CoM: 0.2 m with the CoM at 0.75 m.
  CHECK(at_height(0.72) > at_height(0.74));
  CHECK(at_height(0.74) > 0.0);
  CHECK(at_height(0.95) == 0.0);
}

TEST_CASE("a swing from one side of a fence to the other asks the CoM to rise, however thin the fence is") {
  mcplan::Scene scene = scenes::made_of(
      "fence", {scenes::rectangle("ground", -1, 3, -1, 1, 0), scenes::rectangle("fence", 0.5, 0.53, -1, 1, 0.19)},
      "ground", "ground", {1.0, 0.0, 0.0});
  scene.surfaces[1].thickness = 0.19;
  const ddp::Problem problem(scene, scenes::humanoid44(), phases(6));
  const ddp::Layout& at = problem.layout;
  const Writer path = term(problem, "swing_path", swinging());
  VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
  x.segment<3>(at.end(1)) = Vector3d(0.25, 0.1, 0.0) / 0.7;
  u.segment<3>(at.stride(1)) = Vector3d(0.53, 0.0, 0.0) / 0.7;
  u[at.duration()] = 1e-3;
  const auto at_height = [&](double height) {
    x.segment<3>(at.com()) = Vector3d(0.5, 0.0, height) / 0.7;
    return cost(problem, path, x, u);
  };
  CHECK(at_height(0.68) > at_height(0.70));
  CHECK(at_height(0.70) > at_height(0.73));
  CHECK(at_height(0.76) == 0.0);
  check_rows(problem, path, 5, 0.4, 10);
}

TEST_CASE("the rows of swings have the derivatives of their values") {
  const ddp::Problem problem = with_tread();
  check_rows(problem, term(problem, "swing_path", swinging()), 5, 0.4, 10);
}

TEST_CASE("the rows of swings have the derivatives of their values where faces cut the reach box") {
  mcplan::Robot robot = scenes::humanoid44_cut();
  for (int l : {0, 1}) robot.end_effectors[l].reach_cut.b = robot.end_effectors[l].reach_cut.b.array() - 0.05;
  const ddp::Problem box = with_tread();
  const ddp::Problem cut(box.scene, robot, phases(6));
  check_rows(cut, term(cut, "swing_path", swinging()), 5, 0.4, 40);

  // Faces hold feet lower than the box alone: the CoM has to rise farther.
  const ddp::Layout& at = box.layout;
  VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
  x.segment<3>(at.com()) = Vector3d(0.5, 0.0, 0.75) / 0.7;
  x.segment<3>(at.end(1)) = Vector3d(0.3, 0.1, 0.0) / 0.7;
  u.segment<3>(at.stride(1)) = Vector3d(0.55, 0.0, 0.2) / 0.7;
  u[at.duration()] = 1e-3;
  CHECK(cost(cut, term(cut, "swing_path", swinging()), x, u) > cost(box, term(box, "swing_path", swinging()), x, u));
}

TEST_CASE("the rows of a swing of several phases have the derivatives of their values, and know the whole arc") {
  const ddp::Problem problem = with_tread();
  const ddp::Layout& at = problem.layout;
  ddp::SwingArc arc;
  arc.known = true;
  arc.before = arc.duration = arc.duration_before = arc.duration_after = 1.2;
  arc.after = 2.4;
  arc.stride_before = {0.2, 0.0, 0.1};
  arc.stride_after = {0.3, 0.1, 0.1};
  arc.land_normal = Vector3d(-0.2, 0.1, 1.0).normalized();
  About about = swinging();
  about.arc = &arc;
  const Writer path = term(problem, "swing_path", about);
  check_rows(problem, path, 7, 0.4, 40);

  // The second of four phases begins a quarter of the arc up, where a swing of its own would begin on the ground.
  VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
  x.segment<3>(at.com()) = Vector3d(0.45, 0.0, 1.2) / 0.7;
  x.segment<3>(at.end(1)) = Vector3d(0.42, 0.1, 0.0) / 0.7;
  u.segment<3>(at.stride(1)) = Vector3d(0.3, 0.0, 0.2) / 0.7;
  u[at.duration()] = arc.duration;
  u[at.stiffness(0)] = 0.7 / 1.2;  // the CoM stays up
  CHECK(cost(problem, term(problem, "swing_path", swinging()), x, u) > 1e-3);
  CHECK(cost(problem, path, x, u) == 0.0);
}

TEST_CASE("a swing does not dive through the thin floor that it leaves") {
  const ddp::Problem problem = with_tread();
  const ddp::Layout& at = problem.layout;
  ddp::SwingArc arc;  // the first of two phases
  arc.known = true;
  arc.duration = arc.after = arc.duration_after = 1.2;
  arc.stride_after = {0.1, 0.0, 0.6};
  About about = swinging();
  about.arc = &arc;
  const auto price = [&](double down) {
    VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
    x.segment<3>(at.com()) = Vector3d(0.0, 0.0, 0.7) / 0.7;
    x.segment<3>(at.end(1)) = Vector3d(-0.2, 0.1, 0.0) / 0.7;
    u.segment<3>(at.stride(1)) = Vector3d(0.1, 0.0, -down) / 0.7;
    u[at.duration()] = arc.duration;
    u[at.stiffness(0)] = 1.0;
    return cost(problem, term(problem, "swing_path", about), x, u);
  };
  CHECK(price(0.0) == 0.0);
  CHECK(price(0.7) > 1e-3);  // below the slab of 0.2 m
  CHECK(price(0.8) > price(0.7));
}
