#include "mcplan/ddp/problem.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "mcplan/base/error.hpp"
#include "support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;
using Eigen::Vector3d;

template <class Error, class Call>
std::string refused_field(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.field();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("in the planner's units gravity is one and so is the stiffness of standing") {
  const Problem problem(scenes::flat(), scenes::humanoid44(), phases(18));
  CHECK(problem.units.length == 0.7);
  CHECK(9.8 * problem.units.time * problem.units.time / problem.units.length == doctest::Approx(1.0));
  CHECK(problem.units.force() == doctest::Approx(44.0 * 9.8));
  CHECK(problem.units.stiffness() == doctest::Approx(9.8 / 0.7));
  CHECK(problem.limits[0].force_max == doctest::Approx(1750.0 / (44.0 * 9.8)));
  CHECK(problem.start[problem.layout.com() + 2] == doctest::Approx(1.0));
  CHECK(problem.inertia.x() == doctest::Approx(5.0 / (44.0 * 0.49)));
}

TEST_CASE("end-effectors that may touch nothing cost no variables, but the paper carries them") {
  Options options = phases(18);
  const Problem flat(scenes::flat(), scenes::humanoid44(), options);
  CHECK(flat.active == std::vector<int>{0, 1});
  CHECK(flat.layout.axes() == std::vector<int>{2});  // no contact moment drives roll and pitch
  CHECK(flat.layout.nx() == 6 + 2 + 6);
  const Problem rail(scenes::gap_with_rail(), scenes::humanoid44(), options);
  CHECK(rail.active == std::vector<int>{0, 1, 2, 3});
  CHECK(std::isinf(rail.friction[2]));
  CHECK(rail.rules.surfaces(2) == std::vector<int>{2});
  options.method = Method::paper;
  const Problem paper(scenes::flat(), scenes::humanoid44(), options);
  CHECK(paper.active.size() == 4);
  CHECK(paper.layout.axis_count() == 3);
}

TEST_CASE("left to the planner, the number of steps grows with the way; the paper's scenes have the paper's 18") {
  const auto steps = [](const mcplan::Scene& scene) { return Problem(scene, scenes::humanoid44(), Options{}).steps; };
  for (const mcplan::Scene& scene : scenes::all_four()) CHECK(steps(scene) == 18);
  const auto plain = [&](double length) {
    mcplan::Scene scene = scenes::flat(length);
    scene.surfaces = {scenes::rectangle("ground", -1, length + 1, -5, 5, 0)};
    return scene;
  };
  const int ten = steps(plain(10.0)), twenty = steps(plain(20.0));
  CHECK(ten > 18);
  CHECK(ten >= 2 * 10.0 / 0.6);  // a stride of 0.6 m at most, a swing and a phase of support each
  CHECK(twenty == doctest::Approx(2 * ten).epsilon(0.1));
  CHECK(Problem(plain(10.0), scenes::humanoid44(), phases(12)).steps == 12);
}

TEST_CASE("the reference runs from start to goal and rests at both") {
  mcplan::Scene scene = scenes::stairs();
  scene.goal.yaw = 0.5;
  const Problem problem(scene, scenes::humanoid44(), phases(16));
  const Layout& at = problem.layout;
  const auto& x = problem.reference.x;
  REQUIRE(x.size() == 17);
  CHECK((x.back().segment<3>(at.com()) * 0.7 - Vector3d(1.6, 0, 1.0)).norm() < 1e-12);
  CHECK(x.back()[at.angle()] == doctest::Approx(0.5));
  CHECK(x[8][at.com()] * 0.7 == doctest::Approx(0.8));
  for (int k : {0, 16}) CHECK(x[k].segment<3>(at.velocity()).norm() == 0.0);
  // v_ref is the derivative of p_ref.
  const double dt = problem.duration_initial;
  for (int k = 1; k < 16; ++k)
    CHECK(x[k][at.velocity()] == doctest::Approx((x[k + 1][at.com()] - x[k - 1][at.com()]) / (2 * dt)).epsilon(0.1));
}

TEST_CASE("a first guess puts the weight on those in contact, or on all when the sequence is open") {
  for (auto input : {StiffnessInput::mu, StiffnessInput::lambda}) {
    Options options = phases(18);
    options.stiffness_input = input;
    const Problem problem(scenes::gap_with_rail(), scenes::humanoid44(), options);
    const auto mu = [&](const VectorXd& u, int l) {
      const double value = u[problem.layout.stiffness(l)];
      return input == StiffnessInput::lambda ? value * value : value;
    };
    const Trajectory open = problem.initial_guess({});
    ContactSequence sequence(19, problem.start_contacts);
    sequence[3] = {kFree, 0, kFree, kFree};
    sequence[5] = {kFree, kFree, 2, 3};
    const Trajectory given = problem.initial_guess(sequence);
    for (int l = 0; l < 4; ++l) {
      CHECK(mu(open.u[4], l) == doctest::Approx(0.25));
      CHECK(mu(given.u[4], l) == doctest::Approx(l < 2 ? 0.5 : 0.0));
      CHECK(mu(given.u[3], l) == doctest::Approx(l == 1 ? 1.0 : 0.0));
      CHECK(mu(given.u[5], l) == doctest::Approx(l < 2 ? 0.0 : 0.5));
    }
    CHECK(given.u.size() == 18);
  }
}

TEST_CASE("an initial sequence is refused with the field that does not fit") {
  const Problem problem(scenes::flat(), scenes::humanoid44(), phases(4));
  const auto field = [&](const ContactSequence& sequence) {
    return refused_field<mcplan::InvalidOptions>([&] { problem.to_active(sequence); });
  };
  const ContactState stand{0, 0, -1, -1};
  const ContactSequence good{stand, {0, -1, -1, -1}, stand, {-1, 0, -1, -1}, stand};
  CHECK(field(good) == "accepted");
  CHECK(problem.to_active(good)[1] == ContactState{0, -1});
  CHECK(field({stand, stand}) == "initial_sequence");
  ContactSequence bad = good;
  bad[2] = {0, 0};
  CHECK(field(bad) == "initial_sequence[2]");
  bad = good;
  bad[2][3] = 0;  // a hand that may touch nothing here
  CHECK(field(bad) == "initial_sequence[2][3]");
  bad = good;
  bad[0] = {0, -1, -1, -1};  // not the start
  CHECK(field(bad) == "initial_sequence");
  bad = good;
  bad[4] = {0, -1, -1, -1};  // not the goal
  CHECK(field(bad) == "initial_sequence");
  bad = good;
  bad[2] = {-1, 0, -1, -1};  // two switches
  CHECK(field(bad) == "initial_sequence");
  bad = good;
  bad[2][0] = 7;  // no such surface
  CHECK(field(bad) == "initial_sequence");
}

TEST_CASE("bad scenes, robots and options are refused when the problem is made") {
  const auto make = [](const mcplan::Scene& scene, const mcplan::Robot& robot, const Options& options) {
    return [=] { Problem(scene, robot, options); };
  };
  mcplan::Scene scene = scenes::flat();
  mcplan::Robot robot = scenes::humanoid44();
  Options options;
  options.phases = -1;
  CHECK(refused_field<mcplan::InvalidOptions>(make(scene, robot, options)) == "phases");
  options = {};
  robot.mass = -1.0;
  CHECK(refused_field<mcplan::InvalidRobot>(make(scene, robot, options)) == "mass");
  robot = scenes::humanoid44();
  scene.surfaces[0].vertices_W.resize(2);
  CHECK(refused_field<mcplan::InvalidScene>(make(scene, robot, options)) == "surfaces[0].vertices");
  scene = scenes::flat();
  scene.start.position_W.x() = std::nan("");
  CHECK(refused_field<mcplan::InvalidScene>(make(scene, robot, options)).rfind("start", 0) == 0);
}

TEST_CASE("a rule whose demand nobody can meet keeps the others on the ground") {
  mcplan::Scene scene = scenes::gap_with_rail();
  scene.surfaces.resize(2);  // no pads
  const Problem problem(scene, scenes::humanoid44(), phases(18));
  REQUIRE(problem.layout.ends() == 2);
  CHECK_FALSE(problem.rules.allowed({kFree, kFree}));
  CHECK(problem.rules.allowed({0, kFree}));
}

TEST_CASE("a measured start takes the place of the scene's") {
  Problem problem(scenes::flat(), scenes::humanoid44(), phases(10));
  const Layout& at = problem.layout;
  mcplan::Knot knot;
  knot.com_W = {0.5, 0.01, 0.69};
  knot.com_velocity_W = {0.4, 0.1, -0.1};
  knot.base_rpy = {0.01, -0.02, 0.1};
  knot.base_rpy_rate = {0, 0, 0.2};
  knot.end_effectors_W.assign(4, {0.45, 0.1, 0.0});
  problem.set_start(knot, {0, kFree});
  CHECK((problem.start.segment<3>(at.com()) * 0.7 - knot.com_W).norm() < 1e-15);
  CHECK((problem.start.segment<3>(at.velocity()) * problem.units.velocity() - knot.com_velocity_W).norm() < 1e-15);
  CHECK(problem.start[at.angle()] == 0.1);
  CHECK(problem.start[at.rate()] == doctest::Approx(0.2 * problem.units.time));
  CHECK(problem.rpy(problem.start) == knot.base_rpy);
  CHECK(problem.start_contacts == ContactState{0, kFree});
  CHECK(problem.reference.x.front() == problem.start);
  CHECK(problem.reference.x.back()[at.com()] * 0.7 == doctest::Approx(2.0));
}
