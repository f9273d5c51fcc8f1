#include "ddp/ways.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;
using mcplan::Report;
using mcplan::Scene;

/// Two floors with a hole between them, so long, and on each side of it a bridge, so far from the middle.
Scene bridges(double length = 1.6, double aside = 0.4, double to_the_left = 0.0) {
  const double end = 0.5 + length;
  Scene scene = scenes::made_of(
      "hole", {scenes::rectangle("a", -1, 0.5, -2, 2, 0), scenes::rectangle("b", end, end + 1.9, -2, 2, 0)}, "a", "b",
      {end + 0.5, 0, 0});
  const double left = to_the_left > 0.0 ? to_the_left : aside;
  scene.surfaces.push_back(scenes::rectangle("left", 0.5, end, left, left + 0.6, 0));
  scene.surfaces.push_back(scenes::rectangle("right", 0.5, end, -aside - 0.6, -aside, 0));
  return scene;
}

struct Outcome {
  std::vector<double> rows;
  double cost = 0.0;
  int iterations = 0;
  bool by_route = false;
};

Outcome searched(const Options& given, std::vector<std::string>* ways = nullptr, const Scene& scene = bridges()) {
  Options options = given;
  if (ways)
    options.logger = [ways](mcplan::LogLevel, const std::string& line) {
      if (line.find(" phases: ") != std::string::npos) ways->push_back(line);
    };
  const mcplan::Robot robot = scenes::humanoid44();
  const mcplan::Deadline deadline;
  Report report;
  const Found found = WaysToGoal(scene, robot, options, nullptr, deadline).search(report);
  Outcome out;
  for (const mcplan::Iteration& row : report.history) out.rows.push_back(row.merit + row.index);
  if (found.best.best()) out.cost = found.best.best()->evaluation.cost;
  out.iterations = report.iterations;
  out.by_route = !found.way.course.route.empty();
  return out;
}

Outcome searched(int threads, int max_iterations, std::vector<std::string>* ways = nullptr) {
  Options options;
  options.threads = threads;
  options.max_iterations = max_iterations;
  return searched(options, ways);
}

}  // namespace

TEST_CASE("of a jump and bridges on both sides a bridge is taken, the same one for any number of threads") {
  if (kSlowBuild) return;
  std::vector<std::string> alone, beside;
  const Outcome one = searched(1, 5000, &alone), two = searched(2, 5000, &beside);
  CHECK(one.by_route);
  CHECK(alone.size() == 3);
  CHECK(alone == beside);
  CHECK(one.rows == two.rows);
  CHECK(one.cost == two.cost);
  CHECK(one.iterations == two.iterations);
  // The base turns with the way round: sideways it costs 0.2 and more.
  CHECK(one.cost < 0.2);
}

TEST_CASE("a limit on iterations falls at the same one with several threads and ways") {
  const Outcome one = searched(1, 60), two = searched(2, 60);
  CHECK(one.iterations == 60);
  CHECK(one.rows == two.rows);
  CHECK(one.cost == two.cost);
}

TEST_CASE("once a way has a plan, the others are tried without restarts") {
  if (kSlowBuild) return;
  Options once;
  once.threads = 1;
  once.restarts = 0;
  Options usual;
  usual.threads = 1;
  const Scene wide = bridges(1.8, 0.6);  // no jump leads over it at the first attempt
  const Outcome one = searched(once, nullptr, wide), restarted = searched(usual, nullptr, wide);
  CHECK(one.by_route);
  CHECK(one.iterations == restarted.iterations);
  CHECK(one.cost == restarted.cost);
}

TEST_CASE("once a plan is easy, ways that ask for far more phases are not searched, with any number of threads") {
  if (kSlowBuild) return;
  const Scene scene = bridges(1.6, 0.4, 1.4);
  std::vector<std::string> alone, beside;
  Options options;
  options.threads = 1;
  const Outcome one = searched(options, &alone, scene);
  options.threads = 2;
  const Outcome two = searched(options, &beside, scene);
  CHECK(one.by_route);
  CHECK(alone.size() == 2);  // by the bridge that is near, and straight on; not by the one that is far to the left
  CHECK(alone == beside);
  CHECK(one.rows == two.rows);
  CHECK(one.cost == two.cost);
}
