#include "mcplan/plan/plan_files.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "fixtures.hpp"
#include "mcplan/base/error.hpp"
#include "point_fixtures.hpp"

using namespace mcplan;

namespace {

namespace fs = std::filesystem;

/// A plan whose numbers need all their digits.
Plan noisy(Plan plan) {
  std::mt19937 rng(5);
  std::normal_distribution<double> noise(0.0, 1e-3);
  for (Knot& knot : plan.knots)
    for (Eigen::Vector3d* const v : {&knot.com_W, &knot.com_velocity_W, &knot.base_rpy, &knot.base_rpy_rate})
      for (int i = 0; i < 3; ++i) (*v)[i] += noise(rng);
  for (Phase& phase : plan.phases) phase.duration += 0.1 * std::abs(noise(rng));
  return plan;
}

std::string field(const std::string& text) {
  try {
    plan_from_json(text);
  } catch (const InvalidPlan& found) {
    return found.field();
  }
  return "accepted";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("plans of every force law survive a file to the last bit") {
  const fs::path file = fs::temp_directory_path() / ("mcplan_plan_" + std::to_string(getpid()) + ".json");
  for (const Plan& made : {fixtures::walk(), fixtures::flight(), fixtures::step_on_corners()}) {
    const Plan plan = noisy(made);
    plan.save(file.string());
    const Plan back = load_plan(file.string());
    CHECK(back == plan);
    const double t = 0.37 * plan.duration();
    CHECK(back.at(t).com_W == plan.at(t).com_W);
    Plan other = back;
    other.knots[1].com_W.x() += 1e-15;
    CHECK(other != plan);
  }
  fs::remove(file);
}

TEST_CASE("slack of the start survives a file, and a file without it has none") {
  Plan plan = noisy(fixtures::walk());
  const std::string without = plan_to_json(plan);
  CHECK(without.find("start_slack_s") == std::string::npos);
  CHECK(plan_from_json(without).start_slack_s == 0.0);
  plan.measured_start = true;
  plan.start_slack_s = 0.1 + 0.2;
  const std::string with = plan_to_json(plan);
  CHECK(plan_from_json(with) == plan);
  CHECK(plan_from_json(with).start_slack_s == 0.1 + 0.2);
  Plan other = plan;
  other.start_slack_s = 0.3;
  CHECK(other != plan);
  CHECK(field(replaced(with, "\"measured_start\": true", "\"measured_start\": false")) == "start_slack_s");
  CHECK(field(replaced(with, "\"start_slack_s\": 0.3", "\"start_slack_s\": -0.3")) == "start_slack_s");
}

TEST_CASE("how long a swing is under way survives a file, and a file without it has none that is") {
  Plan plan = noisy(fixtures::walk());
  const std::string without = plan_to_json(plan);
  CHECK(without.find("elapsed_s") == std::string::npos);
  CHECK(plan_from_json(without).swings[0].elapsed_s == 0.0);
  plan.swings[0].first_phase = 0;
  plan.swings[0].elapsed_s = 0.1 + 0.2;
  const std::string with = plan_to_json(plan);
  CHECK(plan_from_json(with) == plan);
  CHECK(field(replaced(with, "\"elapsed_s\": 0.3", "\"elapsed_s\": -0.3")) == "swings[0].elapsed_s");
}

TEST_CASE("other endings and other files are refused") {
  CHECK_THROWS_AS(fixtures::walk().save("plan.npz"), InvalidInput);
  CHECK_THROWS_AS(load_plan("/nowhere/plan.json"), InvalidPlan);
  CHECK_THROWS_AS(load_plan("/dev/zero"), InvalidPlan);
}

TEST_CASE("what is wrong with a plan in JSON is named") {
  const std::string text = plan_to_json(fixtures::walk());
  CHECK(field(text) == "accepted");
  CHECK(field(replaced(text, "\"kind\": \"plan\"", "\"kind\": \"whole_body\"")) == "kind");
  CHECK(field(replaced(text, "\"format\": 4", "\"format\": 9")) == "format");
  CHECK(field(replaced(text, "\"phases\": [", "\"phasen\": [")) == "phasen");
  CHECK(field(replaced(text, "\"gravity\": 9.81", "\"gravity\": -1")) == "scene.gravity");
  CHECK(field(replaced(text, "\"mass\": 40.0", "\"mass\": 1e999")) == "");
  CHECK(field(replaced(text, "\"duration\": 0.4", "\"duration\": -0.4")) == "phases[0].duration");
  CHECK(field(replaced(text, "\"surface\": 0", "\"surface\": 77")) == "phases[0].contacts[0].surface");
  for (std::size_t cut = 0; cut < text.size(); cut += 1 + text.size() / 200) {
    CAPTURE(cut);
    CHECK(field(text.substr(0, cut)) == "");
  }
}

TEST_CASE("a plan in JSON may begin with a byte order mark") {
  const Plan plan = fixtures::walk();
  CHECK(plan_from_json("\xEF\xBB\xBF" + plan_to_json(plan)) == plan);
}

TEST_CASE("texts that would take much memory are refused") {
  std::string many = "[0";
  for (int i = 0; i < 3'000'000; ++i) many += ",0";
  CHECK(field(many + "]") == "");
  CHECK(field(std::string(100'000, '[')) == "");
}
