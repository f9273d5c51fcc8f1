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

TEST_CASE("soles that know one plane press within it and twist about its normal") {
  for (double slope : {0.0, 0.3}) {
    mcplan::Scene scene = scenes::gap();
    for (mcplan::Surface& surface : scene.surfaces)
      for (auto& v : surface.vertices_W) v.z() += slope * v.x();
    const Problem problem(scene, scenes::humanoid44(), phases(18));
    const Layout& at = problem.layout;
    const Vector3d normal = Vector3d(-slope, 0, 1).normalized();
    CHECK(at.nu() == 2 * (3 + 1 + 2 + 2 + 1) + 1);
    REQUIRE(at.moment_count() == 2);
    for (int l : {0, 1}) {
      REQUIRE(at.pressure_count(l) == 2);
      CHECK((at.offsets(l).pressure.transpose() * normal).norm() <= 1e-15);
      CHECK((at.offsets(l).pressure.transpose() * at.offsets(l).pressure - Eigen::Matrix2d::Identity()).norm() <=
            1e-15);
      CHECK(at.offsets(l).force_line == Eigen::Matrix3d::Identity().leftCols(2));  // far below the CoM
      CHECK(at.moments()[l].end_effector == l);
      CHECK((at.moments()[l].direction_W - normal).norm() <= 1e-15);
      CHECK(at.moments()[l].most == doctest::Approx(1.0 / (44.0 * 9.8 * 0.7)));
    }
  }
}

TEST_CASE("soles that know several planes have all directions; points neither press aside nor twist") {
  const Problem problem(gap_with_walls(), scenes::humanoid44(), phases(18));
  const Layout& at = problem.layout;
  REQUIRE(at.ends() == 4);
  for (int l : {0, 1}) CHECK(at.offsets(l).pressure == Eigen::Matrix3d::Identity());
  REQUIRE(at.moment_count() == 6);
  for (int i = 0; i < 6; ++i) {
    CHECK(at.moments()[i].end_effector == i / 3);
    CHECK(at.moments()[i].direction_W == Vector3d::Unit(i % 3));
  }
  for (int l : {2, 3}) CHECK(at.pressure_count(l) == 0);
  CHECK(at.nu() == 2 * (3 + 1 + 3 + 2 + 3) + 2 * (3 + 1) + at.force_line_count(2) + at.force_line_count(3) + 1);
  // Every input has its own place.
  std::vector<int> used(at.nu(), 0);
  const auto use = [&](int first, int count) {
    for (int i = first; i < first + count; ++i) ++used[i];
  };
  for (int l = 0; l < 4; ++l) {
    use(Layout::stride(l), 3), use(at.stiffness(l), 1);
    use(at.pressure(l), at.pressure_count(l)), use(at.force_line(l), at.force_line_count(l));
  }
  use(at.moment(), at.moment_count()), use(at.duration(), 1);
  CHECK(used == std::vector<int>(at.nu(), 1));
}

TEST_CASE("the line of force goes anywhere where surfaces are met at an angle") {
  const Problem rail(scenes::gap_with_rail(), scenes::humanoid44(), phases(18));
  for (int hand : {2, 3}) CHECK(rail.layout.offsets(hand).force_line == Eigen::Matrix3d::Identity());
  mcplan::Scene walls = gap_with_walls();
  for (int i : {2, 3}) walls.surfaces[i].end_effectors = {"foot"};
  const Problem chimney(walls, scenes::humanoid44(), phases(18));
  for (int foot : {0, 1}) CHECK(chimney.layout.offsets(foot).force_line == Eigen::Matrix3d::Identity());
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

TEST_CASE("a robot that cannot twist has no moments") {
  mcplan::Robot robot = scenes::humanoid44();
  for (auto& end : robot.end_effectors) end.max_moment.setZero();
  for (const mcplan::Scene& scene : {scenes::flat(), gap_with_walls()})
    CHECK(Problem(scene, robot, phases(18)).layout.moment_count() == 0);
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
  for (Model model : kModels) {
    mcplan::Scene scene = scenes::stairs();
    scene.goal.yaw = 0.5;
    const Problem problem(scene, scenes::humanoid44(), phases(16, model));
    const Layout& at = problem.layout;
    const int yaw = at.axis_count() - 1;
    const auto& x = problem.reference.x;
    REQUIRE(x.size() == 17);
    CHECK((x.back().segment<3>(at.com()) * 0.7 - Vector3d(1.6, 0, 1.0)).norm() < 1e-12);
    CHECK(x.back()[at.angle(yaw)] == doctest::Approx(0.5));
    CHECK(x[8][at.com()] * 0.7 == doctest::Approx(0.8));
    for (int k : {0, 16}) CHECK(x[k].segment<3>(at.velocity()).norm() == 0.0);
    for (int k : {0, 16}) CHECK(x[k].segment(at.momentum(), at.axis_count()).norm() == 0.0);
    // v_ref is the derivative of p_ref, and L_ref that of the angles times the inertia.
    const double dt = 2 * problem.duration_initial;
    for (int k = 1; k < 16; ++k) {
      CHECK(x[k][at.velocity()] == doctest::Approx((x[k + 1][at.com()] - x[k - 1][at.com()]) / dt).epsilon(0.1));
      CHECK(
          x[k][at.momentum(yaw)] ==
          doctest::Approx(problem.inertia.z() * (x[k + 1][at.angle(yaw)] - x[k - 1][at.angle(yaw)]) / dt).epsilon(0.1));
    }
  }
}

TEST_CASE("where the goal is turned, the reference's feet turn with the base") {
  mcplan::Scene scene = scenes::flat(0.0);
  scene.start.yaw = -0.3;
  scene.goal.yaw = 1.8;
  for (Model model : kModels) {
    const Problem problem(scene, scenes::humanoid44(), phases(16, model));
    const Layout& at = problem.layout;
    for (int k = 0; k <= 16; ++k) {
      const VectorXd& x = problem.reference.x[k];
      const double s = k / 16.0, yaw = -0.3 + 2.1 * s * s * (3 - 2 * s);
      CHECK(problem.rpy(x).z() == doctest::Approx(yaw));
      for (int l : {0, 1}) {
        const double side = l == 0 ? -0.1 / 0.7 : 0.1 / 0.7;  // across the base, the same all the way
        const Vector3d expected(-side * std::sin(yaw), side * std::cos(yaw), 0.0);
        CHECK((x.segment<3>(at.end(l)) - expected).norm() <= 1e-12);
      }
    }
    CHECK(problem.start_yaw == std::vector<double>(2, -0.3));
    CHECK(problem.goal_yaw == 1.8);
  }
}

TEST_CASE("standing soles head where the base does on average, at start and goal as given, swinging ones with it") {
  mcplan::Scene scene = scenes::flat();
  scene.start.yaw = 0.2;
  scene.goal.yaw = 1.0;
  const Problem problem(scene, scenes::humanoid44(), phases(8));
  const Layout& at = problem.layout;
  Trajectory t = problem.initial_guess({});
  const std::vector<double> base{0.25, 0.3, 0.35, 0.5, 0.6, 0.7, 0.9, 0.93, 0.97};
  for (int k = 0; k <= 8; ++k) t.x[k][at.angle(2)] = base[k];
  const ContactState both{0, 0}, right{0, kFree}, left{kFree, 0};
  problem.set_sole_yaw({both, left, both, both, right, both, left, both, both}, t);
  const auto of = [&](int l) {
    std::vector<double> out;
    for (const auto& row : t.sole_yaw) out.push_back(row[l]);
    return out;
  };
  REQUIRE(t.sole_yaw.size() == 9);
  // The right foot stands in phase 0, from 2 to 5 (knots 2 to 6), and from 7 to the end.
  const double right_yaw = (0.35 + 0.5 + 0.6 + 0.7 + 0.9) / 5;
  const std::vector<double> expected_right{0.2, 0.3, right_yaw, right_yaw, right_yaw, right_yaw, 0.9, 1.0, 1.0};
  // The left foot from 0 to 3 (the start's), and from 5 to the end (the goal's).
  const std::vector<double> expected_left{0.2, 0.2, 0.2, 0.2, 0.6, 1.0, 1.0, 1.0, 1.0};
  for (int k = 0; k <= 8; ++k) {
    CAPTURE(k);
    CHECK(of(0)[k] == doctest::Approx(expected_right[k]));
    CHECK(of(1)[k] == doctest::Approx(expected_left[k]));
  }
  // A contact that ends at the last knot but is not the goal's goes by the base again; whoever never steps keeps to the
  // start's.
  problem.set_sole_yaw(ContactSequence(9, both), t);
  for (int l : {0, 1}) CHECK(of(l) == std::vector<double>(9, 0.2));
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
    CHECK(problem.pyramid_share == doctest::Approx(sides == 0 ? 1.0 : std::sqrt(0.5)));
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
      REQUIRE(problem.pyramid[i].size() == static_cast<std::size_t>(sides));
      for (const Vector3d& t : problem.pyramid[i]) {
        CHECK(t.norm() == doctest::Approx(1.0));
        CHECK(std::abs(t.dot(problem.polygons[i].normal_W())) <= 1e-15);
      }
    }
  }
}
