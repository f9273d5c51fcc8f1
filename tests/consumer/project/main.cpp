// Uses the installed library the way another project does: a built-in scene planned, saved, loaded and checked, a
// planar task copied, a scene and a robot in code, and a nonlinear program.

#include <cmath>
#include <cstdio>
#include <mcplan/mcplan.hpp>
#include <memory>
#include <string>
#include <vector>

namespace {

mcplan::Scene one_floor() {
  mcplan::Scene scene;
  scene.name = "one_floor";
  mcplan::Surface floor;
  floor.name = "floor";
  floor.vertices_W = {{-1, -1, 0}, {3, -1, 0}, {3, 1, 0}, {-1, 1, 0}};
  scene.surfaces = {floor};
  scene.start.contacts = {{"foot", "floor"}};
  scene.goal = scene.start;
  scene.goal.position_W.x() = 1.0;
  return scene;
}

mcplan::Robot hopper() {
  mcplan::EndEffector foot;
  foot.name = "foot";
  foot.nominal_B = {0, 0, -0.7};
  foot.reach_min_B = {-0.3, -0.2, -0.8};
  foot.reach_max_B = {0.3, 0.2, -0.5};
  mcplan::Robot robot;
  robot.name = "hopper";
  robot.mass = 10.0;
  robot.com_height = 0.7;
  robot.end_effectors = {foot};
  return robot;
}

int failures = 0;

void expect(bool condition, const std::string& what) {
  if (!condition) {
    std::fprintf(stderr, "wrong: %s\n", what.c_str());
    ++failures;
  }
}

/// The ten lines of the README, with what they need to be a test.
void plan_a_built_in_scene() {
  auto scene = mcplan::load_scene("stairs_broad");
  auto robot = mcplan::load_robot("talos");
  auto result = mcplan::ddp::plan(scene, robot);
  if (result.report.status == mcplan::Status::solved) result.plan.save("stairs.json");
  const mcplan::Plan plan = mcplan::load_plan("stairs.json");
  expect(plan == result.plan, "a plan does not come back as it was");
  expect(mcplan::check(plan, mcplan::load_scene("stairs_broad"), mcplan::load_robot("talos")).ok(),
         "the checker rejects the plan that came back");
}

/// A built-in planar task as the library's own files have it, and as it is written.
void copy_a_planar_task() {
  const mcplan::PlanarTask task = mcplan::load_planar_task("cartwheel");
  mcplan::save_planar_task(task, "copy.toml");
  expect(mcplan::load_planar_task("copy.toml") == task, "a planar task does not come back as it was");
  expect(task.robot == mcplan::load_planar_robot("climber9"), "a planar task has another robot than it names");
}

}  // namespace

int main() {
  plan_a_built_in_scene();
  copy_a_planar_task();
  expect(std::string(MCPLAN_VERSION) == EXPECTED_VERSION, "the header and the CMake package give different versions");

  mcplan::Scene scene = one_floor();
  const mcplan::Robot robot = hopper();
  scene.validate();
  robot.validate();
  const mcplan::ResolvedStance start = mcplan::resolve_stance(scene, robot, scene.start, "start");
  expect(start.contacts == std::vector<int>{0}, "the foot does not start on the floor");
  expect(std::abs(start.com_W.z() - 0.7) < 1e-12, "the CoM does not start at its height");

  // Pulls Ipopt in: without it the program would link although the package forgets what the static library needs.
  mcplan::nlp::Problem problem;
  problem.add_variables("x", 1, 1.0, 3.0, {0, 0});
  problem.add_cost(std::make_unique<mcplan::nlp::LinearPiece>("x", std::vector<int>{0}, Eigen::MatrixXd::Ones(1, 1)));
  problem.finish();
  const mcplan::nlp::Solution least = mcplan::nlp::solve(problem, Eigen::VectorXd::Constant(1, 2.0));
  expect(least.outcome == mcplan::nlp::Outcome::converged && std::abs(least.x[0] - 1.0) < 1e-4,
         "the least x is not at its bound");
  const mcplan::nlp::Solution by_kernel = mcplan::ipm::solve(problem, Eigen::VectorXd::Constant(1, 2.0));
  expect(by_kernel.outcome == mcplan::nlp::Outcome::converged && std::abs(by_kernel.x[0] - 1.0) < 1e-4,
         "the kernel does not find the least x at its bound");

  scene.surfaces[0].vertices_W.resize(2);
  try {
    scene.validate();
    expect(false, "a surface of two points is accepted");
  } catch (const mcplan::InvalidScene& error) {
    expect(error.field() == "surfaces[0].vertices", "the error names the field " + error.field());
  }

  if (failures == 0) std::puts("the installed library works");
  return failures;
}
