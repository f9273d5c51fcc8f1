#include "planar/sip/constraints/swing_lines.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "planar/sip/tasks.hpp"

using mcplan::PlanarContact;
using mcplan::PlanarSurface;
using mcplan::PlanarTask;
using mcplan::sip::swing_lines;
using mcplan::sip::SwingLine;

namespace {

PlanarSurface piece(const std::string& name, double x, double y, double angle, double from, double to) {
  PlanarSurface out = planar_tasks::surface(name, {x, y}, angle);
  out.from = from;
  out.to = to;
  return out;
}

/// One step of the walker's right foot, of six intervals, over what is given.
PlanarTask step_over(const std::vector<PlanarSurface>& surfaces, const PlanarContact& landing) {
  PlanarTask task;
  task.name = "step";
  task.robot = planar_tasks::walker();
  task.surfaces = surfaces;
  const PlanarContact left{0, 0, {0.0, 0.0}, 0.0}, right{1, 0, {0.0, 0.0}, 0.0};
  planar_tasks::add_phase(task, {left, right}, 3);
  planar_tasks::add_phase(task, {left}, 6);
  planar_tasks::add_phase(task, {left, landing}, 3);
  return task;
}

/// The first step of stairs, on its tread.
PlanarTask first_step() {
  return step_over({piece("ground", 0.0, 0.0, 0.0, -INFINITY, 0.18), piece("riser", 0.18, 0.0, M_PI_2, 0.0, 0.12),
                    piece("tread", 0.18, 0.12, 0.0, 0.0, INFINITY)},
                   {1, 2, {0.3, 0.12}, 0.0});
}

/// Directions of the lines of an interval of the step.
std::vector<Eigen::Vector2d> normals(const PlanarTask& task, int interval) {
  std::vector<Eigen::Vector2d> out;
  for (const SwingLine& line : swing_lines(task, 1, interval)) out.push_back(line.normal_W);
  return out;
}

}  // namespace

TEST_CASE("an end-effector stays in front of every endless surface for the whole of its swing") {
  const PlanarTask task = planar_tasks::climbing();
  for (int interval = 0; interval < 4; ++interval) {
    const auto lines = swing_lines(task, 1, interval);
    REQUIRE(lines.size() == 2);
    for (int s = 0; s < 2; ++s) {
      CHECK(lines[s].end_effector == 1);
      CHECK(lines[s].point_W == task.surfaces[s].origin_W);
      CHECK(lines[s].normal_W == task.surfaces[s].normal_W());
    }
  }
  CHECK(swing_lines(task, 0, 0).empty());  // all three stand
}

TEST_CASE("a foot that steps up is before the riser and over the ground first, over the tread in the end") {
  const PlanarTask task = first_step();
  const Eigen::Vector2d up(0.0, 1.0), back(-1.0, 0.0);
  bool landed = false;
  for (int interval = 0; interval < 6; ++interval) {
    CAPTURE(interval);
    const auto lines = normals(task, interval);
    const bool over = lines.size() == 1 && (lines[0] - up).norm() < 1e-12;
    if (!over) {
      CHECK_FALSE(landed);
      REQUIRE(lines.size() == 2);
      CHECK((lines[0] - up).norm() < 1e-12);
      CHECK((lines[1] - back).norm() < 1e-12);
    } else {
      landed = true;  // the line of the tread hides ground and riser
      CHECK(swing_lines(task, 1, interval)[0].point_W.y() == 0.12);
    }
  }
  CHECK(landed);
  CHECK(normals(task, 0).size() == 2);
}

TEST_CASE("a foot that steps over a rail is before it, over it, behind it, in this order") {
  PlanarTask task =
      step_over({piece("ground", 0.0, 0.0, 0.0, -INFINITY, INFINITY), piece("rail", 0.25, 0.06, 0.0, -0.01, 0.01)},
                {1, 0, {0.5, 0.0}, 0.0});
  std::string order;
  for (int interval = 0; interval < 6; ++interval) {
    const auto lines = swing_lines(task, 1, interval);
    REQUIRE(lines.size() <= 2);
    char where = '?';
    for (const SwingLine& line : lines) {
      if (line.point_W.y() == 0.0 && line.normal_W.y() > 0.5) continue;  // the ground
      where = line.normal_W.y() > 0.5 ? 'o' : line.normal_W.x() < -0.5 ? 'b' : 'a';
    }
    if (lines.size() == 1) where = lines[0].point_W.y() > 0.0 ? 'o' : '?';  // the rail's line hides the ground
    if (order.empty() || order.back() != where) order += where;
  }
  CHECK(order == "boa");
}

TEST_CASE("a surface that the task names keeps all away that is behind it, the others have lines of their own") {
  PlanarTask task = planar_tasks::climbing();
  task.phases[1].clearances = {{1, 0, 1, 3, -INFINITY}};
  CHECK(swing_lines(task, 1, 0).size() == 2);
  REQUIRE(swing_lines(task, 1, 1).size() == 1);
  CHECK(swing_lines(task, 1, 1)[0].normal_W == task.surfaces[1].normal_W());
  CHECK(swing_lines(task, 1, 2).size() == 1);
  CHECK(swing_lines(task, 1, 3).size() == 2);
}

TEST_CASE("pairs in no_clearance have no line") {
  PlanarTask task = planar_tasks::climbing();
  task.no_clearance = {{1, 1}, {0, 0}};
  REQUIRE(swing_lines(task, 1, 0).size() == 1);
  CHECK(swing_lines(task, 1, 0)[0].normal_W == task.surfaces[0].normal_W());
  REQUIRE(swing_lines(task, 3, 0).size() == 1);
  CHECK(swing_lines(task, 3, 0)[0].normal_W == task.surfaces[1].normal_W());
}
