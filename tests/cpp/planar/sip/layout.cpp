#include "planar/sip/layout.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "planar/robots.hpp"
#include "tasks.hpp"

using namespace mcplan::sip;
using mcplan::PlanarTask;
using planar_tasks::paper_task;

namespace {

Options with(Forces forces, bool free_durations, FreeFlyer free_flyer = FreeFlyer::computed, bool dynamics = true) {
  Options options;
  options.forces = forces;
  options.free_durations = free_durations;
  options.free_flyer = free_flyer;
  options.dynamics = dynamics;
  return options;
}

}  // namespace

TEST_CASE("numbers of parameters are those of the paper's tables") {
  // Motion 1, 2, 3; without weights, weights per body, weights per point.
  const int one_duration[3][3] = {{82, 84, 89}, {298, 312, 335}, {298, 303, 317}};
  const int phase_durations[3][3] = {{84, 86, 91}, {306, 320, 343}, {306, 311, 325}};
  const int parameterised[3] = {109, 397, 397};
  for (int m = 0; m < 3; ++m) {
    const PlanarTask task = paper_task(m + 1);
    CAPTURE(task.name);
    const Forces cases[] = {Forces::uniform, Forces::per_body, Forces::per_point};
    for (int c = 0; c < 3; ++c) {
      CHECK(Layout(task, with(cases[c], false)).parameters == one_duration[m][c]);
      CHECK(Layout(task, with(cases[c], true)).parameters == phase_durations[m][c]);
      // Table II: kinematics alone needs no weights.
      CHECK(Layout(task, with(cases[c], false, FreeFlyer::computed, false)).parameters == one_duration[m][0]);
    }
    CHECK(Layout(task, with(Forces::uniform, false, FreeFlyer::parameterised)).parameters == parameterised[m]);
  }
  CHECK(Layout(paper_task(1), with(Forces::parameters, false)).parameters == 338);
}

TEST_CASE("intervals: 10, 34, 34") {
  CHECK(Layout(paper_task(1), {}).intervals == 10);
  CHECK(Layout(paper_task(2), {}).intervals == 34);
  CHECK(Layout(paper_task(3), {}).intervals == 34);
}

TEST_CASE("parameters come in blocks that neither overlap nor leave a gap") {
  for (int m : {1, 2, 3})
    for (Forces forces : {Forces::uniform, Forces::per_body, Forces::per_point, Forces::parameters})
      for (bool free : {false, true}) {
        const PlanarTask task = paper_task(m);
        const Layout layout(task, with(forces, free, FreeFlyer::parameterised));
        std::vector<int> uses(layout.parameters, 0);
        for (int j = 0; j < layout.splines; ++j)
          for (int i = 0; i < layout.control_points(); ++i) ++uses.at(layout.control_point(j, i));
        for (int d = 0; d < layout.durations; ++d) ++uses.at(layout.first_duration + d);
        for (std::size_t p = 0; p < task.phases.size(); ++p)
          for (int i = 0; i < layout.weights[p]; ++i) ++uses.at(layout.first_weight[p] + i);
        for (int k = 0; k < layout.intervals; ++k)
          for (int i = 0; i < layout.forces[k]; ++i) ++uses.at(layout.first_force[k] + i);
        CHECK(uses == std::vector<int>(layout.parameters, 1));
      }
}

TEST_CASE("the first three control points of a spline are one, and so are the last three") {
  const Layout layout(paper_task(1), {});
  const int last = layout.control_points() - 1;
  CHECK(layout.free_of(0) == 0);
  CHECK(layout.free_of(1) == 0);
  CHECK(layout.free_of(2) == 0);
  CHECK(layout.free_of(3) == 1);
  CHECK(layout.free_of(layout.intervals) == last);
  CHECK(layout.free_of(layout.intervals + 1) == last);
  CHECK(layout.free_of(layout.intervals + 2) == last);
  CHECK(layout.free_of(layout.intervals - 1) == last - 1);
}

TEST_CASE("an interval touches its control points, the durations about it, and its phase's weights and forces") {
  const PlanarTask task = paper_task(3);
  for (Forces forces : {Forces::per_point, Forces::parameters})
    for (bool free : {false, true}) {
      const Options options = with(forces, free);
      const Layout layout(task, options);
      for (int k = 0; k < layout.intervals; ++k) {
        CAPTURE(k);
        const LocalParameters local(task, layout, k);
        std::set<int> expected;
        for (int j = 0; j < layout.splines; ++j)
          for (int i = k; i <= k + 3; ++i) expected.insert(layout.control_point(j, layout.free_of(i)));
        std::set<int> durations;
        for (int d = std::max(k - 2, 0); d <= std::min(k + 2, layout.intervals - 1); ++d)
          durations.insert(layout.first_duration + (free ? task.phase_of(d) : 0));
        CHECK(durations.size() <= 2);  // phases here are at least three intervals long
        expected.insert(durations.begin(), durations.end());
        for (int i = 0; i < layout.weights[local.phase]; ++i) expected.insert(layout.first_weight[local.phase] + i);
        for (int i = 0; i < layout.forces[k]; ++i) expected.insert(layout.first_force[k] + i);
        CHECK(std::set<int>(local.variables.begin(), local.variables.end()) == expected);
        CHECK(local.count() == static_cast<int>(expected.size()));  // none twice
        CHECK(local.phase == task.phase_of(k));

        // The columns are where they are said to be.
        for (int j = 0; j < layout.splines; ++j)
          for (int i = 0; i < 4; ++i)
            CHECK(local.variables[local.control_column(j, local.control[i])] ==
                  layout.control_point(j, layout.free_of(k + i)));
        for (int d = 0; d < 5; ++d) {
          const int at = std::clamp(k + d - 2, 0, layout.intervals - 1), phase = task.phase_of(at);
          CHECK(local.variables[local.duration_column(local.knot_duration[d])] ==
                layout.first_duration + (free ? phase : 0));
          CHECK(local.knot_ratio[d] == doctest::Approx(1.0 / (free ? task.phases[phase].intervals : 34)));
        }
        CHECK(local.own_duration == local.knot_duration[2]);
        if (local.weights > 0) CHECK(local.variables[local.weight_column(0)] == layout.first_weight[local.phase]);
        if (local.forces > 0) CHECK(local.variables[local.force_column(0)] == layout.first_force[k]);
      }
    }
}

TEST_CASE("phases of one interval: an interval touches five durations") {
  PlanarTask task = planar::standing();
  task.phases.assign(7, task.phases[0]);
  for (auto& phase : task.phases) phase.intervals = 1;
  const Layout layout(task, {});
  const LocalParameters local(task, layout, 3);
  std::vector<int> expected(5);
  std::iota(expected.begin(), expected.end(), layout.first_duration + 1);
  CHECK(local.durations == expected);
}

TEST_CASE("two intervals, the fewest: one posture") {
  PlanarTask task = planar::standing();
  task.phases.resize(1);
  task.phases[0].intervals = 2;
  const Layout layout(task, with(Forces::uniform, true));
  CHECK(layout.parameters == task.robot.joint_count() + 1);
  for (int i = 0; i < 5; ++i) CHECK(layout.free_of(i) == 0);
  for (int k : {0, 1}) CHECK(LocalParameters(task, layout, k).controls == std::vector<int>{0});
}
