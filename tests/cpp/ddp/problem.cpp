#include "ddp/problem.hpp"

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
  CHECK(flat.layout.axis_count() == 3);
  CHECK(flat.layout.nx() == 6 + 6 + 6);
  const Problem rail(scenes::gap_with_rail(), scenes::humanoid44(), options);
  CHECK(rail.active == std::vector<int>{0, 1, 2, 3});
  CHECK(std::isinf(rail.friction[2]));
  CHECK(rail.rules.surfaces(2) == std::vector<int>{2});
  options.model = Model::lipm;
  const Problem lipm(scenes::flat(), scenes::humanoid44(), options);
  CHECK(lipm.active == std::vector<int>{0, 1});
  CHECK(lipm.layout.axes() == std::vector<int>{2});  // no contact moment drives roll and pitch
  CHECK(lipm.layout.nx() == 6 + 2 + 6);
  CHECK(lipm.layout.nu() == 6 + 2 + 2 + 1);
  for (Model model : kModels) {
    options.model = model;
    options.method = Method::paper;
    const Problem paper(scenes::flat(), scenes::humanoid44(), options);
    CHECK(paper.model == Model::lipm);
    CHECK(paper.active.size() == 4);
    CHECK(paper.layout.axis_count() == 3);
    CHECK(paper.layout.nu() == 12 + 4 + 12 + 1);
  }
}

TEST_CASE("a shortest flight that is asked for is no longer than the longest phase") {
  mcplan::Robot robot = scenes::humanoid44();
  robot.phase_duration = {0.2, 0.5};
  Options options;
  options.flight_duration_min_s = 0.5;
  const Problem problem(scenes::flat(), robot, options);
  CHECK(problem.flight_duration_min * problem.units.time == doctest::Approx(0.5));
  options.flight_duration_min_s = 0.51;
  CHECK_THROWS_WITH_AS(Problem(scenes::flat(), robot, options),
                       doctest::Contains("flight_duration_min_s: must be at most the longest phase, 0.5"),
                       mcplan::InvalidOptions);
}

TEST_CASE("phases are first guessed in the middle of their box, in the paper's model at its author's 0.45 s") {
  mcplan::Robot robot = scenes::humanoid44();
  robot.phase_duration = {0.2, 0.5};
  for (Model model : kModels) {
    Options options = phases(18, model);
    const auto initial_s = [&] {
      const Problem problem(scenes::flat(), robot, options);
      CHECK(problem.initial_guess({}).u[3][problem.layout.duration()] == problem.duration_initial);
      return problem.duration_initial * problem.units.time;
    };
    CHECK(initial_s() == doctest::Approx(model == Model::wrench ? 0.35 : 0.45));
    options.duration_initial_s = 0.3;
    CHECK(initial_s() == doctest::Approx(0.3));
  }
}

TEST_CASE("acting and line points are the foot with its offsets, and their transposed derivatives theirs") {
  const Problem problem(gap_with_walls(), scenes::humanoid44(), phases(18));
  const Layout& at = problem.layout;
  Random random(70);
  for (int l = 0; l < 4; ++l)
    for (bool line : {false, true}) {
      const VectorXd z = noise(random, at.nz(), 1.0);
      const auto point = [&](const VectorXd& from) -> VectorXd {
        const VectorXd x = from.head(at.nx()), u = from.tail(at.nu());
        return line ? at.line_point(x, u, l) : at.acting_point(x, u, l);
      };
      const MatrixXd jacobian = differences(point, z);
      const Vector3d along = noise(random, 3, 1.0);
      VectorXd g = VectorXd::Ones(at.nz());
      if (line)
        at.add_along_line_point(l, along, g);
      else
        at.add_along_acting_point(l, along, g);
      CHECK((g - VectorXd::Ones(at.nz()) - jacobian.transpose() * along).norm() <= 1e-10);
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
  REQUIRE(problem.layout.end_effector_count() == 2);
  CHECK_FALSE(problem.rules.allowed({kFree, kFree}));
  CHECK(problem.rules.allowed({0, kFree}));
}

TEST_CASE("a measured start takes the place of the scene's") {
  for (Model model : kModels) {
    CAPTURE(name(model));
    Problem problem(scenes::flat(), scenes::humanoid44(), phases(10, model));
    const Layout& at = problem.layout;
    const int yaw = at.axis_count() - 1;
    mcplan::Knot knot;
    knot.com_W = {0.5, 0.01, 0.69};
    knot.com_velocity_W = {0.4, 0.1, -0.1};
    knot.base_rpy = {0.01, -0.02, 0.1};
    knot.base_rpy_rate = {0, 0, 0.2};
    knot.end_effectors_W.assign(4, {0.45, 0.1, 0.0});
    problem.set_start(knot, {0, kFree});
    CHECK((problem.start.segment<3>(at.com()) * 0.7 - knot.com_W).norm() < 1e-15);
    CHECK((problem.start.segment<3>(at.velocity()) * problem.units.velocity() - knot.com_velocity_W).norm() < 1e-15);
    CHECK(problem.start[at.angle(yaw)] == 0.1);
    // I omega where no momentum was measured.
    CHECK(problem.units.angular_momentum() == doctest::Approx(44.0 * 0.7 * std::sqrt(9.8 * 0.7)));
    CHECK(problem.start[at.momentum(yaw)] == doctest::Approx(5.0 * 0.2 / problem.units.angular_momentum()));
    CHECK(problem.rpy(problem.start) == knot.base_rpy);
    CHECK(problem.start_contacts == ContactState{0, kFree});
    CHECK(problem.reference.x.front() == problem.start);
    CHECK(problem.reference.x.back()[at.com()] * 0.7 == doctest::Approx(2.0));
    CHECK(problem.start_yaw == std::vector<double>(2, 0.1));
    knot.angular_momentum_W = {1.0, -2.0, 3.0};
    knot.end_effector_yaw = {0.3, -0.1, 0.0, 0.0};
    problem.set_start(knot, {0, kFree});
    CHECK(problem.start_yaw == std::vector<double>{0.3, -0.1});
    const double momentum = model == Model::wrench ? 3.0 : 5.0 * 0.2;
    CHECK(problem.start[at.momentum(yaw)] == doctest::Approx(momentum / problem.units.angular_momentum()));
    if (model == Model::wrench)
      CHECK(problem.start[at.momentum(1)] == doctest::Approx(-2.0 / problem.units.angular_momentum()));
  }
}

TEST_CASE("friction is planned a little tighter than the surface's, in as many sides as were asked for") {
  Options options = phases(18);
  for (int sides : {0, 4}) {
    options.friction_sides = sides;
    mcplan::Scene scene = gap_with_walls();
    scene.surfaces[0].friction = 0.03;
    const Problem problem(scene, scenes::humanoid44(), options);
    CHECK(problem.friction[0] == doctest::Approx(0.015));
    CHECK(problem.friction[1] == doctest::Approx(0.68));
    CHECK(problem.friction[2] == doctest::Approx(0.48));
    CHECK(problem.pyramid_ratio == doctest::Approx(sides == 0 ? 1.0 : std::sqrt(0.5)));
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
      REQUIRE(problem.pyramid[i].size() == static_cast<std::size_t>(sides));
      for (const Vector3d& t : problem.pyramid[i]) {
        CHECK(t.norm() == doctest::Approx(1.0));
        CHECK(std::abs(t.dot(problem.polygons[i].normal_W())) <= 1e-15);
      }
    }
  }
}

TEST_CASE(
    "hands that may touch nothing are held at their nominal place, beside a trunk as far in as their box reaches") {
  mcplan::Robot robot = scenes::humanoid44();
  mcplan::Scene scene = scenes::flat();
  scene.surfaces.front().end_effectors = {"foot"};
  for (const bool trunk : {false, true}) {
    if (trunk) robot.trunk.push_back({Vector3d(0, 0, 0.1), Vector3d(0, 0, 0.4), 0.1});
    const Problem problem(scene, robot, Options());
    REQUIRE(problem.idle_hands.size() == 2);
    for (int i : {0, 1}) {
      const mcplan::EndEffector& hand = robot.end_effectors[2 + i];
      const Vector3d place = problem.idle_hands[i] * problem.units.length;
      const double inner = i == 0 ? hand.reach_max_B.y() : hand.reach_min_B.y();
      CHECK(place.x() == doctest::Approx(hand.nominal_B.x()));
      CHECK(place.y() == doctest::Approx(trunk ? inner : hand.nominal_B.y()));
      CHECK(place.z() == doctest::Approx(hand.nominal_B.z()));
    }
  }
}
