#include "ddp/search.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "ddp/initial_sequence.hpp"
#include "ddp/tail_edits.hpp"
#include "mcplan/ddp/switched_ddp.hpp"
#include "support.hpp"

namespace {

using mcplan::Deadline;
using namespace support;
using namespace mcplan::ddp;
using mcplan::Status;

constexpr double kForever = std::numeric_limits<double>::infinity();

/// A search with everything it points to.
struct Bench {
  Bench(const mcplan::Scene& scene, const Options& options)
      : problem(scene, scenes::humanoid44(), options),
        deadline(options.time_limit_s),
        search(problem, deadline, report) {}
  Problem problem;
  Deadline deadline;
  mcplan::Report report;
  Search search;

  Incumbent guess(const ContactSequence& sequence) const {
    Incumbent out;
    out.trajectory = problem.initial_guess(sequence);
    out.sequence = sequence;
    return out;
  }
  Incumbent discovered() {
    Incumbent now = guess({});
    Schedule weights;
    weights.contact_weight = problem.options.weights.contact_min;
    search.model().expand(now.trajectory, weights);
    now.sequence = initial_sequence(search.model());
    CHECK(search.discover(now, problem.options.proximal_weight, problem.tuning()) == Ending::done);
    return now;
  }
};

}  // namespace

TEST_CASE("discovery lets the feet alternate and leaves a valid sequence with small defects") {
  for (Model model : kModels) {
    CAPTURE(name(model));
    Bench bench(scenes::flat(), phases(18, model));
    const Incumbent now = bench.discovered();
    CHECK(bench.problem.rules.valid(now.sequence));
    CHECK(now.sequence.front() == bench.problem.start_contacts);
    CHECK(now.sequence.back() == bench.problem.goal_contacts);
    CHECK(switch_count(now.sequence) >= 6);
    CHECK(now.evaluation.defect_max < 0.05);
  }
}

TEST_CASE("polishing keeps the sequence and never lets the merit rise") {
  for (const mcplan::Scene& scene : {scenes::flat(), scenes::gap()}) {
    Bench bench(scene, phases(18, Model::lipm));
    Incumbent now = bench.discovered();
    const ContactSequence sequence = now.sequence;
    const double before = bench.search.evaluate(now, bench.problem.tuning()).merit();
    const std::size_t first = bench.report.history.size();
    CHECK(bench.search.polish(now, 30, 0.0, kForever, bench.problem.tuning()) == Ending::done);
    CHECK(now.sequence == sequence);
    REQUIRE(bench.report.history.size() == first + 30);
    double last = before;
    for (std::size_t i = first; i < bench.report.history.size(); ++i) {
      const mcplan::Iteration& row = bench.report.history[i];
      CHECK(row.merit <= last * (1.0 + 1e-12));
      CHECK(row.switches == 0);
      last = row.merit;
    }
    CHECK(bench.search.evaluate(now, bench.problem.tuning()).merit() == doctest::Approx(last));
    CHECK(last < before);
  }
}

TEST_CASE("with contact wrenches no iteration lets the merit rise but by what the soles' new headings cost") {
  for (const mcplan::Scene& scene : {scenes::flat(), scenes::gap()}) {
    CAPTURE(scene.name);
    Bench bench(scene, phases(18));
    Incumbent now = bench.discovered();
    const ContactSequence sequence = now.sequence;
    const double first = bench.search.evaluate(now, bench.problem.tuning()).merit();
    for (int i = 0; i < 30; ++i) {
      Incumbent headed = now;
      bench.problem.set_sole_yaw(headed.sequence, headed.trajectory);
      const double before = bench.search.evaluate(headed, bench.problem.tuning()).merit();
      CHECK(bench.search.polish(now, 1, 0.0, kForever, bench.problem.tuning()) == Ending::done);
      CHECK(now.evaluation.merit() <= before * (1.0 + 1e-12));
      CHECK(now.trajectory.sole_yaw == headed.trajectory.sole_yaw);
      CHECK(bench.search.evaluate(now, bench.problem.tuning()).merit() == doctest::Approx(now.evaluation.merit()));
    }
    CHECK(now.sequence == sequence);
    CHECK(now.evaluation.merit() < first);
  }
}

TEST_CASE("refining changes the sequence only for a lower true merit, and settles: no chattering") {
  Options options = phases(10);
  options.max_iterations = 1000000;
  Bench bench(scenes::flat(1.0), options);
  Incumbent now = bench.discovered();
  bench.search.polish(now, 60, 1e-3, kForever, bench.problem.tuning());
  const double before = now.evaluation.merit();
  CHECK(bench.search.refine(now, bench.problem.tuning()) == Ending::done);
  CHECK(bench.problem.rules.valid(now.sequence));
  CHECK(now.evaluation.merit() <= before * (1.0 + 1e-12));
  CHECK(bench.search.evaluate(now, bench.problem.tuning()).merit() == doctest::Approx(now.evaluation.merit()));
  int switches = -1, rounds = 0;
  double last = now.evaluation.merit();
  for (; switches != bench.report.switches && rounds < 10; ++rounds) {
    switches = bench.report.switches;
    bench.search.polish(now, 120, 1e-5, kForever, bench.problem.tuning());
    CHECK(bench.search.refine(now, bench.problem.tuning()) == Ending::done);
    CHECK(now.evaluation.merit() <= last * (1.0 + 1e-12));
    last = now.evaluation.merit();
  }
  CAPTURE(rounds);
  CHECK(switches == bench.report.switches);
}

namespace {

Options without_end(int phase_count) {
  Options options = phases(phase_count);
  options.max_iterations = 1000000;
  return options;
}

/// What is discovered, at the optimum of its sequence; `tuning` becomes that of the interior point.
Incumbent polished(Bench& bench, Tuning& tuning) {
  tuning = bench.problem.tuning();
  tuning.exact = true;
  Incumbent now = bench.discovered();
  CHECK(bench.search.polish_guess(now, Search::Origin::discovered, kForever, tuning) == Ending::done);
  return now;
}

}  // namespace

TEST_CASE("where it is known what was tried, refining the same motion again tries other sequences") {
  Tuning tuning;
  Bench bench(scenes::flat(1.0), without_end(8));
  Incumbent now = polished(bench, tuning);
  bench.search.keep_known(true);
  for (int switches = -1; switches != bench.report.switches;) {
    switches = bench.report.switches;
    CHECK(bench.search.refine(now, tuning) == Ending::done);
  }
  const ContactSequence optimum = now.sequence;
  bench.search.keep_known(true);  // nothing is known any more
  std::set<ContactSequence> seen[2];
  for (std::set<ContactSequence>& tried : seen) {
    bench.search.watch([&](const Incumbent& at, const Tuning&) { tried.insert(at.sequence); });
    Incumbent again = now;
    CHECK(bench.search.refine(again, tuning) == Ending::done);
    tried.erase(optimum);
    CHECK(!tried.empty());
  }
  for (const ContactSequence& sequence : seen[1]) CHECK(seen[0].count(sequence) == 0);
}

TEST_CASE("an end is changed for a lower true merit alone") {
  Bench bench(scenes::flat(0.5), without_end(8));
  Tuning tuning = bench.problem.tuning();
  tuning.exact = true;
  // One step of each foot, at the last moment.
  Incumbent now = bench.discovered();
  now.sequence.assign(9, now.sequence.front());
  now.sequence[5][0] = now.sequence[7][1] = kFree;
  REQUIRE(bench.problem.rules.valid(now.sequence));
  now.trajectory = bench.problem.initial_guess(now.sequence, tuning);
  CHECK(bench.search.polish_guess(now, Search::Origin::sequence, kForever, tuning) == Ending::done);
  bool improved = true;
  int rounds = 0;
  for (; improved && rounds < 10; ++rounds) {
    const Incumbent before = now;
    CHECK(bench.search.change_tail(now, tuning, improved) == Ending::done);
    if (!improved) {
      CHECK(now.sequence == before.sequence);
      CHECK(now.evaluation.merit() == before.evaluation.merit());
      break;
    }
    const std::vector<ContactSequence> edits = tail_edits(bench.problem.rules, before.sequence);
    CHECK(std::find(edits.begin(), edits.end(), now.sequence) != edits.end());
    CHECK(now.evaluation.merit() < before.evaluation.merit());
    CHECK(bench.search.evaluate(now, tuning).merit() == doctest::Approx(now.evaluation.merit()));
  }
  CHECK(rounds > 0);  // it has lowered the merit
  CHECK(rounds < 10);
}

TEST_CASE("what is recorded is what was done") {
  Options options = phases(10);
  options.record_history = true;
  int lines = 0;
  options.logger = [&](mcplan::LogLevel, const std::string&) { ++lines; };
  Bench bench(scenes::flat(0.8), options);
  bench.discovered();
  CHECK(bench.report.iterations == static_cast<int>(bench.report.history.size()));
  CHECK(lines >= bench.report.iterations);
  int switches = 0;
  double contact_weight = 0.0;
  for (std::size_t i = 0; i < bench.report.history.size(); ++i) {
    const mcplan::Iteration& row = bench.report.history[i];
    CHECK(row.index == static_cast<int>(i) + 1);
    CHECK(row.contact_weight >= contact_weight);
    CHECK(row.sequence.size() == 11);
    CHECK(bench.problem.rules.valid(row.sequence));
    contact_weight = row.contact_weight;
    switches += row.switches;
  }
  CHECK(contact_weight == options.weights.contact_max);
  CHECK(switches == bench.report.switches);
}

TEST_CASE("the stop request and the iteration limit end every stage") {
  Options options = phases(10);
  int polls = 0;
  options.stop = [&] { return ++polls > 5; };
  Bench stopped(scenes::flat(), options);
  Incumbent now = stopped.guess({});
  now.sequence.assign(11, stopped.problem.start_contacts);
  CHECK(stopped.search.discover(now, 30.0, stopped.problem.tuning()) == Ending::interrupted);
  CHECK(stopped.report.iterations == 5);
  CHECK(stopped.search.polish(now, 10, 0.0, kForever, stopped.problem.tuning()) == Ending::interrupted);

  options.stop = nullptr;
  options.max_iterations = 7;
  Bench limited(scenes::flat(), options);
  now = limited.guess({});
  now.sequence.assign(11, limited.problem.start_contacts);
  CHECK(limited.search.discover(now, 30.0, limited.problem.tuning()) == Ending::iteration_limit);
  CHECK(limited.report.iterations == 7);
  CHECK(limited.search.run_paper(now, 10, limited.problem.tuning()) == Ending::iteration_limit);
}

TEST_CASE("exhaustive enumeration of six steps: the search ends near the best of all 183 sequences") {
  Options options = phases(6);
  options.max_iterations = 1000000;
  const mcplan::Scene scene = scenes::flat(0.3);
  Bench bench(scene, options);
  const mcplan::PlanResult result = SwitchedDdp(scene, scenes::humanoid44(), options).solve();
  CHECK(result.report.status == Status::solved);
  ContactSequence found;
  for (const auto& row : result.plan.contact_sequence()) found.push_back({row[0], row[1]});
  found.push_back({0, 0});

  double best = kForever, best_of_found = kForever;
  ContactSequence best_sequence;
  int tried = 0, better = 0;
  for (const ContactSequence& sequence : every_sequence(bench.problem)) {
    if (kSlowBuild && ++tried % 8 != 0 && sequence != found) continue;
    Incumbent now = bench.guess(sequence);
    bench.search.polish(now, 300, 1e-6, kForever, bench.problem.tuning());
    const double merit = bench.search.evaluate(now, bench.problem.tuning()).merit();
    if (!std::isfinite(merit)) continue;
    if (sequence == found) best_of_found = merit;
    better += merit < result.report.cost;
    if (merit < best) {
      best = merit;
      best_sequence = sequence;
    }
  }
  const auto text = [](const ContactSequence& sequence) {
    std::string out;
    for (const ContactState& s : sequence)
      out += s[0] == kFree ? (s[1] == kFree ? "x" : "r") : s[1] == kFree ? "l" : ".";
    return out;
  };
  MESSAGE("global best ", best, " ", text(best_sequence), "; found ", result.report.cost, " ", text(found),
          ", which polishes to ", best_of_found, "; ", better, " of 183 are better");
  // Near, not there: a search by neighbours stops at a local optimum, here 6 % above the best.
  CHECK(best_of_found <= 1.1 * best);
  CHECK(result.report.cost <= 1.25 * best);
  CHECK(better <= 10);
}
