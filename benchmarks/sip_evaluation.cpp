// What an evaluation of the whole-body planner's program costs: rows, rows with Jacobian, exact Hessian of cost and
// rows, on the walking motion with forces of case 3, beside finite differences of the same rows. Then the shares of
// evaluation and linear algebra in whole solves.
//
//     sip_evaluation [repeats, default 50] [--json] [--no-solves]

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <set>
#include <string>
#include <vector>

#include "mcplan/planar/sip/planner.hpp"
#include "planar/sip/program.hpp"
#include "tasks.hpp"

namespace {

using Eigen::VectorXd;
using namespace mcplan;

/// Processor time of this thread [ms]: on a busy machine a wall clock says how busy it is.
double now_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/// Median of `repeats` calls [ms].
template <class Call>
double median_ms(int repeats, Call&& call) {
  std::vector<double> times;
  for (int i = 0; i < repeats; ++i) {
    const double start = now_ms();
    call(i);
    times.push_back(now_ms() - start);
  }
  std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
  return times[times.size() / 2];
}

/// Columns of the Jacobian in groups within which no two have a row in common, first come first served.
std::vector<std::vector<int>> column_groups(const nlp::Problem& problem) {
  std::vector<std::vector<int>> columns_of(problem.row_count()), rows_of(problem.variable_count());
  for (const nlp::Entry& entry : problem.jacobian_structure()) {
    columns_of[entry.row].push_back(entry.column);
    rows_of[entry.column].push_back(entry.row);
  }
  std::vector<int> group(problem.variable_count(), -1);
  std::vector<std::vector<int>> groups;
  for (int column = 0; column < problem.variable_count(); ++column) {
    std::set<int> taken;
    for (const int row : rows_of[column])
      for (const int other : columns_of[row])
        if (group[other] >= 0) taken.insert(group[other]);
    int free = 0;
    while (taken.count(free) > 0) ++free;
    group[column] = free;
    if (free == static_cast<int>(groups.size())) groups.emplace_back();
    groups[free].push_back(column);
  }
  return groups;
}

/// Jacobian by differences, a group of columns at a time, in the order of jacobian_structure().
VectorXd differences(const nlp::Problem& problem, const std::vector<std::vector<int>>& groups, const VectorXd& x,
                     double step, bool central) {
  const auto& entries = problem.jacobian_structure();
  std::vector<std::vector<int>> entries_of(problem.variable_count());
  for (std::size_t i = 0; i < entries.size(); ++i) entries_of[entries[i].column].push_back(static_cast<int>(i));
  VectorXd out(static_cast<Eigen::Index>(entries.size())), before(problem.row_count()), after(problem.row_count()),
      moved;
  problem.rows(x, before);
  for (const auto& group : groups) {
    moved = x;
    for (const int column : group) moved[column] += step;
    problem.rows(moved, after);
    if (central) {
      moved = x;
      for (const int column : group) moved[column] -= step;
      problem.rows(moved, before);
    }
    for (const int column : group)
      for (const int i : entries_of[column])
        out[i] = (after[entries[i].row] - before[entries[i].row]) / (central ? 2.0 * step : step);
  }
  return out;
}

struct Times {
  double rows = 0.0, jacobian = 0.0, hessian = 0.0, forward = 0.0, central = 0.0;  ///< [ms]
};

Times evaluation(int repeats, bool json) {
  const PlanarTask task = planar_tasks::walking();
  const sip::Options options;  // case 3, a duration per phase, hull, tube, all constraints
  const sip::Layout layout(task, options);
  // Values and derivatives of the last two points are kept: four in turn are computed anew each time.
  std::vector<VectorXd> points;
  for (unsigned seed = 1; seed <= 4; ++seed) points.push_back(planar_tasks::random_parameters(task, layout, seed));
  const sip::Program program(task, options, sip::Curvature::exact, 1.0, points[0]);
  const nlp::Problem& problem = program.problem();
  const auto point = [&](int i) -> const VectorXd& { return points[i % points.size()]; };
  VectorXd f(problem.row_count()), gradient(problem.variable_count());
  VectorXd J(static_cast<Eigen::Index>(problem.jacobian_structure().size()));
  VectorXd H(static_cast<Eigen::Index>(problem.hessian_structure().size()));
  const VectorXd multipliers = VectorXd::Ones(problem.row_count());
  Times times;
  times.rows = median_ms(repeats, [&](int i) { problem.rows(point(i), f); });
  times.jacobian = median_ms(repeats, [&](int i) {
    problem.rows(point(i), f);
    problem.jacobian(point(i), J);
  });
  times.hessian = median_ms(repeats, [&](int i) { problem.hessian(point(i), 1.0, multipliers, H); });
  const auto groups = column_groups(problem);
  const int few = std::max(repeats / 10, 3);
  VectorXd by_forward, by_central;
  times.forward = median_ms(few, [&](int) { by_forward = differences(problem, groups, points[0], 1e-7, false); });
  times.central = median_ms(few, [&](int) { by_central = differences(problem, groups, points[0], 1e-5, true); });
  problem.rows(points[0], f);
  problem.jacobian(points[0], J);
  const double scale = J.cwiseAbs().maxCoeff();
  const double forward_error = (by_forward - J).cwiseAbs().maxCoeff() / scale;
  const double central_error = (by_central - J).cwiseAbs().maxCoeff() / scale;
  if (json) {
    std::printf(
        "{\"rows_ms\": %.6g, \"jacobian_ms\": %.6g, \"hessian_ms\": %.6g, \"rows\": %d, \"parameters\": %d, "
        "\"entries\": %d}\n",
        times.rows, times.jacobian, times.hessian, problem.row_count(), problem.variable_count(),
        static_cast<int>(J.size()));
    return times;
  }
  std::printf("walking, case 3: N = %d, %d rows, Jacobian with %d entries, Hessian with %d\n", problem.variable_count(),
              problem.row_count(), static_cast<int>(J.size()), static_cast<int>(H.size()));
  std::printf("  rows                        %8.2f ms\n", times.rows);
  std::printf("  rows and Jacobian           %8.2f ms  (x %.1f of the rows)\n", times.jacobian,
              times.jacobian / times.rows);
  std::printf("  Hessian of cost and rows    %8.2f ms  (x %.1f of rows and Jacobian)\n", times.hessian,
              times.hessian / times.jacobian);
  std::printf("  Jacobian by differences, %d groups of columns (plain: %d columns):\n", static_cast<int>(groups.size()),
              problem.variable_count());
  std::printf(
      "    forward                   %8.2f ms  (x %.1f), plain %.0f ms (x %.0f), error %.0e of the largest entry\n",
      times.forward, times.forward / times.jacobian, times.rows * (problem.variable_count() + 1),
      times.rows * (problem.variable_count() + 1) / times.jacobian, forward_error);
  std::printf("    central                   %8.2f ms  (x %.1f), plain %.0f ms (x %.0f), error %.0e\n", times.central,
              times.central / times.jacobian, times.rows * 2 * problem.variable_count(),
              times.rows * 2 * problem.variable_count() / times.jacobian, central_error);
  std::fflush(stdout);
  return times;
}

void shares(const char* title, const sip::Options& options) {
  const sip::Result result = sip::Planner(planar_tasks::walking(), options).solve();
  const auto& timing = result.report.timing_s;
  const auto part = [&](const char* name) { return timing.count(name) > 0 ? timing.at(name) : 0.0; };
  const double all = result.report.time_s, evaluated = part("evaluation"), solved = part("linear_solver");
  const double checked = part("check");
  std::printf("%s: %s, %d iterations, %.2f s: evaluation %.0f %%, linear solver %.0f %%, check %.1f %%, rest %.0f %%\n",
              title, std::string(to_string(result.report.status)).c_str(), result.report.iterations, all,
              100.0 * evaluated / all, 100.0 * solved / all, 100.0 * checked / all,
              100.0 * (all - evaluated - solved - checked) / all);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  int repeats = 50;
  bool json = false, solves = true;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--json") == 0)
      json = true;
    else if (std::strcmp(argv[i], "--no-solves") == 0)
      solves = false;
    else
      repeats = std::atoi(argv[i]);
  }
  if (repeats < 1) {
    std::fprintf(stderr, "usage: sip_evaluation [repeats] [--json] [--no-solves]\n");
    return 2;
  }
  evaluation(repeats, json);
  if (json || !solves) return 0;
  sip::Options options;
  options.torque_weight = 0.0;
  options.free_durations = options.torque_limits = options.clearance = false;
  shares("Table III, walking, case 3", options);
  shares("Table IV, walking, case 3", {});
  return 0;
}
