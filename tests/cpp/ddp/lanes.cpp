#include "ddp/lanes.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

#include "support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;
using mcplan::Report;
using mcplan::StopRequest;

}  // namespace

TEST_CASE("threads do every task once, and none that comes after one that ends the loop is needed") {
  for (int team : {1, 2, 4}) {
    std::vector<std::atomic<int>> times(40);
    CHECK_FALSE(run_ahead(40, team, nullptr, [&](int task, int thread, const StopRequest&) {
      ++times[task];
      return thread < 0;
    }));
    for (const std::atomic<int>& count : times) CHECK(count == 1);
    std::vector<std::atomic<int>> before(40);
    CHECK_FALSE(run_ahead(40, team, nullptr, [&](int task, int, const StopRequest& stop) {
      if (!stop()) ++before[task];
      return task == 7;
    }));
    for (int task = 0; task <= 7; ++task) CHECK(before[task] == 1);
    for (int task = 8 + team; task < 40; ++task) CHECK(before[task] <= 1);
    if (team == 1) CHECK(before[8] == 0);
  }
}

TEST_CASE("a stop reaches all threads, and is asked for by the caller's alone") {
  for (int team : {1, 2, 4}) {
    std::atomic<int> asked{0};
    const auto caller = std::this_thread::get_id();
    std::atomic<bool> elsewhere{false};
    const bool stopped = run_ahead(
        team, team,
        [&] {
          if (std::this_thread::get_id() != caller) elsewhere = true;
          return ++asked > 20;
        },
        [&](int, int, const StopRequest& stop) {
          while (!stop()) std::this_thread::yield();
          return false;
        });
    CHECK(stopped);
    CHECK_FALSE(elsewhere);
  }
}

TEST_CASE("what a task throws in any of the threads is thrown to the caller") {
  for (int team : {1, 2, 4})
    for (int bad : {0, 3, 9})
      CHECK_THROWS_AS(run_ahead(10, team, nullptr,
                                [&](int task, int, const StopRequest&) -> bool {
                                  if (task == bad) throw std::runtime_error("bad");
                                  return false;
                                }),
                      std::runtime_error);
}

TEST_CASE("a task that another of the threads has done is told of as if it had been done here") {
  Options options = phases(10);
  const mcplan::Scene scene = scenes::flat();
  const auto polished = [&](int threads, int max_iterations) {
    options.threads = threads;
    options.max_iterations = max_iterations;
    const Problem problem(scene, scenes::humanoid44(), options);
    const mcplan::Deadline deadline;
    Report report;
    Search search(problem, deadline, report);
    std::vector<Incumbent> done(4);
    const Tuning tuning = problem.tuning();
    const Lanes::Run run = [&](int task, Search& by) {
      Random random(900 + task);
      done[task].sequence = random_sequence(problem, random);
      done[task].trajectory = problem.initial_guess(done[task].sequence, tuning);
      return by.polish(done[task], 5 + task, 0.0, std::numeric_limits<double>::infinity(), tuning) != Ending::done;
    };
    search.lanes().run(4, run);
    bool ended = false;
    for (int task = 0; task < 4 && !ended; ++task) {
      const bool told = search.lanes().tell(task);
      CHECK((!told || team_of(threads) > 1));
      if (!told) ended = run(task, search);
    }
    std::vector<double> merits;
    for (const mcplan::Iteration& row : report.history) merits.push_back(row.merit + row.index);
    return merits;
  };
  const std::vector<double> all = polished(1, 1000);
  CHECK(all.size() == 5 + 6 + 7 + 8);
  CHECK(polished(2, 1000) == all);
  for (int limit : {3, 5, 11, 12, 20, 26}) {
    CAPTURE(limit);
    const std::vector<double> some = polished(1, limit);
    CHECK(static_cast<int>(some.size()) <= limit);
    CHECK(polished(2, limit) == some);
    CHECK(polished(4, limit) == some);
  }
}
