#include "mcplan/planar/plan_files.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <utility>
#include <variant>
#include <vector>

#include "mcplan/base/error.hpp"
#include "mcplan/plan/plan_files.hpp"
#include "planar/robots.hpp"

using namespace mcplan;

namespace {

namespace fs = std::filesystem;

/// A plan whose numbers need all their digits.
PlanarPlan noisy_plan() {
  PlanarPlan plan = planar::standing_plan();
  std::mt19937 rng(5);
  std::normal_distribution<double> noise(0.0, 1e-3);
  for (Eigen::Index i = 0; i < plan.control_points.size(); ++i) plan.control_points(i) += noise(rng);
  for (Eigen::VectorXd& weights : plan.weights)
    for (double& weight : weights) weight += 0.1 * std::abs(noise(rng));
  for (double& duration : plan.durations) duration += 0.1 * std::abs(noise(rng));
  plan.task.phases[1].poses[0].max[2] = HUGE_VAL;
  return plan;
}

/// A plan of each force law: one that has none does not compile.
PlanarPlan plan_under(planar_laws::LeastNorm /*law*/) { return noisy_plan(); }

/// With a base of its own.
PlanarPlan plan_under(planar_laws::Polynomial /*law*/) {
  PlanarPlan plan = noisy_plan();
  plan.force_law = planar_laws::Polynomial();
  plan.weights.clear();
  plan.base_control_points = Eigen::MatrixXd::Random(3, plan.control_points.cols());
  for (int i = 0; i < plan.task.interval_count(); ++i) plan.force_polynomials.push_back(Eigen::MatrixXd::Random(4, 8));
  return plan;
}

template <std::size_t... I>
std::vector<PlanarPlan> plans_of_all_laws(std::index_sequence<I...> /*laws*/) {
  return {plan_under(std::variant_alternative_t<I, PlanarForceLaw>())...};
}

std::string planar_field(const std::string& text) {
  try {
    planar_plan_from_json(text);
  } catch (const InvalidPlan& found) {
    return found.field();
  }
  return "accepted";
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("planar plans of every force law survive a file to the last bit") {
  const fs::path file = fs::temp_directory_path() / ("mcplan_planar_plan_" + std::to_string(getpid()) + ".json");
  constexpr std::size_t laws = std::variant_size_v<PlanarForceLaw>;
  for (const PlanarPlan& plan : plans_of_all_laws(std::make_index_sequence<laws>())) {
    plan.save(file.string());
    const PlanarPlan back = load_planar_plan(file.string());
    CHECK(back.force_law == plan.force_law);
    CHECK(back == plan);
    const double t = 0.37 * plan.duration();
    CHECK(back.at(t).torque == plan.at(t).torque);
    PlanarPlan other = back;
    other.control_points(1, 2) += 1e-15;
    CHECK(other != plan);
  }
  fs::remove(file);
}

TEST_CASE("the task of a plan may be called motion, as in files of 0.1") {
  const PlanarPlan plan = noisy_plan();
  const std::string text = planar_plan_to_json(plan), earlier = with(text, "\"task\": {", "\"motion\": {");
  CHECK(text.find("\"motion\"") == std::string::npos);
  CHECK(planar_plan_from_json(earlier) == plan);
  CHECK(planar_field(with(earlier, "\"gravity\": 9.81", "\"gravity\": -1")) == "motion.robot.gravity");
}

TEST_CASE("a robot without joints has a plan, too") {
  PlanarPlan plan = planar::standing_plan();
  PlanarRobot& robot = plan.task.robot;
  robot.bodies.resize(1);
  robot.collision_pairs.clear();
  robot.end_effectors = {{"sole", 0, {0.0, 0.0}, 0.0, {-0.1, 0.1}}};
  for (PlanarPhase& phase : plan.task.phases) {
    phase.contacts = {PlanarContact{}};
    phase.clearances.clear();
    phase.poses.clear();
  }
  plan.control_points.resize(0, plan.task.interval_count() + 3);
  plan.weights.assign(3, Eigen::VectorXd::Ones(2));
  CHECK(planar_plan_from_json(planar_plan_to_json(plan)) == plan);
}

TEST_CASE("other endings, other files and plans in space are refused") {
  CHECK_THROWS_AS(noisy_plan().save("plan.npz"), InvalidInput);
  CHECK_THROWS_AS(load_planar_plan("/nowhere/plan.json"), InvalidPlan);
  CHECK_THROWS_AS(load_planar_plan("/dev/zero"), InvalidPlan);
  try {
    plan_from_json(planar_plan_to_json(noisy_plan()));
    FAIL("it was read");
  } catch (const InvalidPlan& found) {
    CHECK(std::string(found.what()) == "kind: must be \"plan\": a plan of contacts and CoM, got \"planar_plan\"");
  }
}

TEST_CASE("what is wrong with a planar plan in JSON is named") {
  const std::string text = planar_plan_to_json(noisy_plan());
  CHECK(planar_field(text) == "accepted");
  CHECK(planar_field(with(text, "\"kind\": \"planar_plan\"", "\"kind\": \"plan\"")) == "kind");
  CHECK(planar_field(with(text, "\"format\": 2", "\"format\": 9")) == "format");
  CHECK(planar_field(with(text, "\"durations\": [", "\"duration\": [")) == "duration");
  CHECK(planar_field(with(text, "\"gravity\": 9.81", "\"gravity\": -1")) == "task.robot.gravity");
  CHECK(planar_field(with(text, "\"parent\": 1", "\"parent\": 2")) == "task.robot.bodies[2].parent");
  CHECK(planar_field(with(text, "\"surface\": 0", "\"surface\": 7")) == "task.phases[0].contacts[0].surface");
  CHECK(planar_field(with(text, "\"force_law\": \"least_norm\"", "\"force_law\": \"magic\"")) == "force_law");
  CHECK(planar_field(with(text, "\"weights\": [", "\"weights\": [[1.0], ")) == "weights");
  CHECK(planar_field(with(text, "\"control_points\": [", "\"control_points\": [[1.0], ")) == "control_points[1]");
  CHECK(planar_field(with(text, "\"base_control_points\": []", "\"base_control_points\": [[\"inf\"]]")) ==
        "base_control_points[0][0]");
  for (std::size_t cut = 0; cut < text.size(); cut += 1 + text.size() / 200) {
    CAPTURE(cut);
    CHECK(planar_field(text.substr(0, cut)) == "");
  }
}

TEST_CASE("a planar plan of more intervals than a file may have is refused") {
  PlanarPlan plan = planar::standing_plan();
  plan.task.phases.assign(21, plan.task.phases[0]);
  for (PlanarPhase& phase : plan.task.phases) phase.intervals = 1000;
  plan.durations.assign(21, 1.0);
  plan.weights.assign(21, Eigen::VectorXd::Ones(4));
  plan.control_points = Eigen::MatrixXd::Zero(plan.task.robot.joint_count(), 21'003);
  CHECK_NOTHROW(plan.validate());
  CHECK_THROWS_AS(planar_plan_to_json(plan), InvalidPlan);
}
