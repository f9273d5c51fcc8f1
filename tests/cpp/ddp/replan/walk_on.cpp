#include "ddp/replan/walk_on.hpp"

#include <doctest/doctest.h>

#include "mcplan/ddp/plan.hpp"
#include "scenes.hpp"

namespace {

using namespace mcplan;
using namespace mcplan::ddp;

struct Ahead {
  explicit Ahead(const VelocityCommand& command, int phases = 12, double t = 1.0) {
    plan = ddp::plan(scenes::flat(), scenes::humanoid44()).plan;
    scene = plan.scene;
    rest = rest_of(plan, t);
    ratio = walk_on(rest, scene, plan.robot, command, phases);
  }
  Plan plan;
  Scene scene;
  Rest rest;
  double ratio = 0.0;
};

}  // namespace

TEST_CASE("a command fills the horizon with steps in turn, and its goal is a stance at rest on ground that is there") {
  for (const int phases : {8, 12, 20}) {
    CAPTURE(phases);
    const Ahead ahead({{0.2, 0.0}, 0.0}, phases);
    CHECK(ahead.ratio == 1.0);
    CHECK(ahead.rest.size() <= phases);
    CHECK(ahead.rest.size() >= phases - 3);
    ahead.scene.validate();
    const ResolvedStance goal = resolve_stance(ahead.scene, ahead.plan.robot, ahead.scene.goal, "goal");
    for (int e : {0, 1}) CHECK(goal.contacts[e] == ahead.rest.plan.final_contacts[e]);
    int last = -1;
    for (int k = 1; k < ahead.rest.size(); ++k)
      for (int e : {0, 1})
        if (ahead.rest.surface(k, e) < 0 && ahead.rest.surface(k - 1, e) >= 0) {
          CHECK(e != last);
          last = e;
        }
    CHECK(ahead.rest.desired.back().com_velocity_W.norm() < 1e-9);
  }
}

TEST_CASE("the way of a command is that of its velocity") {
  const double speed = 0.2;
  const Ahead straight({{speed, 0.0}, 0.0}), turning({{0.0, 0.0}, 0.3}), sideways({{0.0, 0.05}, 0.0});
  const auto times = straight.rest.plan.knot_times();
  const auto& desired = straight.rest.desired;
  const Eigen::Vector3d moved = desired[6].com_W - desired[3].com_W;
  CHECK(moved.head<2>().norm() == doctest::Approx(speed * (times[6] - times[3])).epsilon(1e-9));
  CHECK(std::abs(moved.y()) < 1e-3);  // the soles head where the base went, by a thousandth
  const auto turning_times = turning.rest.plan.knot_times();
  CHECK(turning.rest.desired[6].base_rpy.z() - turning.rest.desired[3].base_rpy.z() ==
        doctest::Approx(0.3 * (turning_times[6] - turning_times[3])).epsilon(1e-9));
  CHECK(sideways.rest.desired[6].com_velocity_W.y() == doctest::Approx(0.05));
}

TEST_CASE("a command is slowed down to strides that the legs reach, and by the ground's end") {
  const Ahead fast({{2.0, 0.0}, 0.0});
  CHECK(fast.ratio < 0.5);
  CHECK(fast.ratio > 0.1);
  Scene small = scenes::flat();
  for (Eigen::Vector3d& v : small.surfaces.front().vertices_W) v.x() = std::min(v.x(), 2.2);
  const Plan plan = ddp::plan(small, scenes::humanoid44()).plan;
  Rest rest = rest_of(plan, plan.duration() - 0.2);
  Scene scene = small;
  CHECK(walk_on(rest, scene, plan.robot, {{0.4, 0.0}, 0.0}, 12) < 1.0);
  CHECK(scene.goal.position_W.x() < 2.2 + 0.15 * 0.7);
}
