#include "ddp/joined_ground.hpp"

#include <doctest/doctest.h>

#include "mcplan/ddp/plan.hpp"
#include "mcplan/plan/checker.hpp"
#include "mcplan/scene/polygon.hpp"
#include "support.hpp"

namespace {

using namespace support;
using mcplan::Plan;
using mcplan::Scene;

/// Flat ground of tiles, so long and half as wide, that begin at x = -1.
Scene tiles(double size) {
  Scene scene = scenes::flat(0.6);
  mcplan::Surface whole = scene.surfaces[0];
  scene.surfaces.clear();
  for (int i = 0; i < 14; ++i)
    for (int j = -6; j < 6; ++j) {
      const double x = -1.0 + i * size, y = 0.5 * j * size;
      mcplan::Surface tile = whole;
      tile.name = "t" + std::to_string(i) + "_" + std::to_string(j);
      tile.vertices_W = {{x, y, 0}, {x + size, y, 0}, {x + size, y + 0.5 * size, 0}, {x, y + 0.5 * size, 0}};
      scene.surfaces.push_back(tile);
    }
  const auto below = [&](double x, double y) {
    for (const mcplan::Surface& tile : scene.surfaces)
      if (mcplan::Polygon(tile.vertices_W).outside({x, y, 0.0}) <= 0.0) return tile.name;
    return std::string();
  };
  const mcplan::Robot robot = scenes::humanoid44();
  for (mcplan::Stance* stance : {&scene.start, &scene.goal}) {
    stance->contacts.clear();
    for (const mcplan::EndEffector& end : robot.end_effectors)
      if (end.kind == "foot")
        stance->contacts[end.name] = below(stance->position_W.x() + end.nominal_B.x(), end.nominal_B.y());
  }
  return scene;
}

}  // namespace

TEST_CASE("a plan on whole ground is one on its pieces, and back again") {
  const Scene scene = tiles(0.31);
  const mcplan::Robot robot = scenes::humanoid44();
  const ddp::JoinedGround ground(scene);
  REQUIRE(ground.any());
  CHECK(ground.scene().surfaces.size() == 1);
  const Plan whole = ddp::plan(ground.scene(), robot).plan;
  REQUIRE(check(whole, whole.scene, robot).ok());
  const Plan apart = ground.take_apart(whole);
  CHECK(ground.fits(apart));
  CHECK(!ground.fits(whole));
  CHECK(check(apart, scene, robot).ok());
  for (int l = 0; l < apart.end_effector_count(); ++l)
    for (std::size_t k = 0; k <= apart.phases.size(); ++k) {
      const auto at = [&](const Plan& plan, std::size_t i) {
        return i < plan.phases.size() ? plan.phases[i].contacts[l].surface : plan.final_contacts[l];
      };
      CHECK((at(apart, k) < 0) == (at(whole, k) < 0));
      if (at(apart, k) < 0) continue;
      CHECK(mcplan::Polygon(scene.surfaces[at(apart, k)].vertices_W).outside(apart.knots[k].end_effectors_W[l]) < 0.02);
      if (k > 0 && at(apart, k - 1) >= 0) CHECK(at(apart, k) == at(apart, k - 1));
    }
  const Plan again = ground.join(apart);
  CHECK(again.scene.surfaces.size() == 1);
  CHECK(again.contact_sequence() == whole.contact_sequence());
  CHECK(again.final_contacts == whole.final_contacts);
  CHECK(ddp::on_joined_ground(apart).contact_sequence() == whole.contact_sequence());
}

TEST_CASE("there may be no plan to take apart, and sequences name the first piece") {
  const Scene scene = tiles(0.31);
  const ddp::JoinedGround ground(scene);
  Plan none;
  none.robot = scenes::humanoid44();
  CHECK(ground.fits(ground.take_apart(none)));
  std::vector<int> contacts{0, -1, 0};
  ground.take_apart(contacts);
  CHECK(contacts == std::vector<int>{0, -1, 0});
  contacts = {5, -1, 77};
  ground.join(contacts);
  CHECK(contacts == std::vector<int>{0, -1, 0});
}
