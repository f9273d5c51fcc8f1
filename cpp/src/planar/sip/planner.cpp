#include "mcplan/planar/sip/planner.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "mcplan/base/deadline.hpp"
#include "mcplan/ipm/solver.hpp"
#include "mcplan/version.hpp"
#include "planar/sip/attempts.hpp"
#include "planar/sip/plannable.hpp"
#include "planar/sip/program.hpp"

namespace mcplan::sip {
namespace {

constexpr int kKinematicOrder = 5;      // of angles and places, to a tenth of a millimetre
constexpr double kCloseBarrier = 1e-4;  // the start is nearly the solution

/// Instants at which the checker looks at a plan, at most.
double instants_of(int intervals, double duration_s, double sample_s) {
  return duration_s / sample_s + 2.0 * intervals;
}

/// Constraints of the checker that the options leave out.
bool asked_for(const std::string& name, const Options& options) {
  if (!options.dynamics)
    for (const char* force : {"torque", "balance", "moment", "friction", "pull"})
      if (name == force) return false;
  if (name == "torque") return options.torque_limits;
  if (name == "clearance") return options.clearance;
  return true;
}

}  // namespace

struct Planner::Impl {
  PlanarTask task;
  Options options;
  Layout layout;
  int rows = 0;  ///< of the program; 0 until there was one
  Deadline deadline;
  /// Under a time limit, measured in this solve: what an instant of the checker, values of all intervals, and a
  /// program's first point took, for each of its derivatives.
  struct {
    double instant_s = 0.0, values_s = 0.0, derivative_s = 0.0;
  } took;
  Report report;

  Impl(const PlanarTask& of, const Options& with) : task(of), options(with), layout(checked(of, with), with) {
    require_durations(task, options);
  }

  int row_count() {
    if (rows == 0)
      rows = Program(task, options, Curvature::none, 0.0, Eigen::VectorXd::Zero(layout.parameters), &close_discs)
                 .problem()
                 .row_count();
    return rows;
  }

  static const PlanarTask& checked(const PlanarTask& task, const Options& options) {
    task.validate();
    options.validate();
    require_plannable(task, options);
    return task;
  }

  CloseDiscs close_discs;  ///< kept apart; found on the way

  void measure_finishing(const nlp::Problem& values, const Eigen::VectorXd& x);
  double finishing_s(const Options& with, const Eigen::VectorXd& x) const;
  double starting_s(double derivatives) const;
  nlp::Solution run(const Options& with, double cost_scale, const Eigen::VectorXd& x, bool close = false);
  void part(nlp::Solution& solution, double cost_scale, Eigen::VectorXd apart);
  nlp::Solution within_cones(const Options& with, const Eigen::VectorXd& near, const Eigen::VectorXd& x);
  Eigen::VectorXd cheaper_start(const Eigen::VectorXd& x, double cost_scale);
  nlp::Solution feasible(const Eigen::VectorXd& x);
  void tighten(nlp::Solution& solution, double cost_scale);
  Result solve(const Eigen::VectorXd& start);
  CheckResult judged(const PlanarPlan& plan) const;
  void judge(Result& result, const nlp::Solution& solution);

  /// Parameters under other options.
  Eigen::VectorXd moved(const Eigen::VectorXd& x, const Options& from, const Options& to) const {
    return parameters_of(plan_of(task, from, Layout(task, from), x), task, to, Layout(task, to));
  }
};

/// From one evaluation, and from a check at few instants.
void Planner::Impl::measure_finishing(const nlp::Problem& values, const Eigen::VectorXd& x) {
  constexpr double kCoarser = 16.0;
  double begin_s = deadline.elapsed_s();
  values.worst_violation(x);
  took.values_s = deadline.elapsed_s() - begin_s;
  const PlanarPlan plan = plan_of(task, options, layout, x);
  PlanarTolerances coarse;
  coarse.sample_s *= kCoarser;
  begin_s = deadline.elapsed_s();
  check(plan, coarse, options.self_collision);
  took.instant_s = (deadline.elapsed_s() - begin_s) / instants_of(layout.intervals, plan.duration(), coarse.sample_s);
}

/// What remains to be done with x after the solver: its cost and violations in a few evaluations, and the last check.
double Planner::Impl::finishing_s(const Options& with, const Eigen::VectorXd& x) const {
  constexpr double kEvaluations = 6.0;  // cost and violation of the solver's point and of its start, terms of the cost
  const Layout of(task, with);
  const double duration_s = x.segment(of.first_duration, of.durations).sum();
  const double instants = instants_of(layout.intervals, duration_s, PlanarTolerances().sample_s);
  return kEvaluations * took.values_s + took.instant_s * instants;
}

/// What a program's first point takes, which the solver does not interrupt: derivatives, and the factors that give the
/// first multipliers. Measured: 0.42 to 0.69 us for each derivative, and up to 1.64 times as much for each of them in a
/// program with forces as in the one without that was solved before it, because larger factors fill in more.
double Planner::Impl::starting_s(double derivatives) const {
  constexpr double kFillIn = 1.65;
  constexpr double kDerivative_s = 0.42e-6;  // of the first program, before which nothing was measured
  return kFillIn * std::max(took.derivative_s, kDerivative_s) * derivatives;
}

/// All attempts in turn, until one solves the program; the best of them otherwise. `close`: x is nearly the solution.
/// Under a time limit none is begun whose first point would come too late, by those of the programs before.
nlp::Solution Planner::Impl::run(const Options& with, double cost_scale, const Eigen::VectorXd& x, bool close) {
  const bool cost = cost_scale > 0.0;
  std::optional<nlp::Solution> best;
  for (const Attempt& attempt : attempts_for(with, cost)) {
    const bool exact = attempt.hessian == HessianChoice::exact;
    const bool second = attempt.hessian != HessianChoice::limited_memory;
    StopRequest over;
    if (deadline.limited()) over = [until = deadline.reserving(finishing_s(with, x))] { return until.passed(); };
    Program program(task, with, exact ? Curvature::exact : Curvature::gauss_newton, cost_scale, x, &close_discs, over);
    const double left = deadline.remaining_s();
    const nlp::Problem& made = program.problem();
    const double derivatives = made.jacobian_structure().size() + (second ? made.hessian_structure().size() : 0.0);
    const double needed_s = deadline.limited() ? finishing_s(with, x) + starting_s(derivatives) : 0.0;
    if (deadline.limited() && (!program.complete() || left <= needed_s)) {
      if (best && best->outcome == nlp::Outcome::nearly_converged) break;
      if (!best) {
        best.emplace();
        best->x = x;
      }
      best->outcome = nlp::Outcome::time_limit;
      best->message = "reached time_limit_s";
      break;
    }
    if (with.dynamics == options.dynamics) rows = program.problem().row_count();
    nlp::SolverOptions how;
    how.tolerance = with.tolerance;
    how.constraint_tolerance = with.constraint_tolerance;
    how.max_iterations = attempt.max_iterations;
    how.time_limit_s = std::max(left, 1e-3);
    how.hessian = second ? nlp::Hessian::exact : nlp::Hessian::limited_memory;
    how.initial_barrier = close ? kCloseBarrier : attempt.initial_barrier;
    how.adaptive_barrier = attempt.adaptive_barrier;
    how.kernel = attempt.kernel;
    how.gradient_scaling = false;
    how.logger = with.logger;
    how.stop = with.stop;
    how.clock = with.clock;
    if (deadline.limited()) how.finishing_s = [&](const Eigen::VectorXd& at) { return finishing_s(with, at); };
    nlp::Solution solution = ipm::solve(attempt.solver, program.problem(), x, how);
    took.derivative_s = std::max(took.derivative_s, solution.start_s / std::max(derivatives, 1.0));
    report.iterations += solution.iterations;
    report.timing_s["evaluation"] += solution.evaluation_s;
    report.timing_s["linear_solver"] += solution.linear_solver_s;
    const bool kept = solution.worst.value <= with.constraint_tolerance;
    const bool best_kept = best && best->worst.value <= with.constraint_tolerance;
    const bool better = !best || (kept && !best_kept) || (kept && best_kept && solution.cost < best->cost) ||
                        (!kept && !best_kept && solution.worst.value < best->worst.value);
    const nlp::Outcome outcome = solution.outcome;
    const std::string message = solution.message;
    if (better || outcome == nlp::Outcome::converged) best = std::move(solution);
    if (ends_all(outcome)) {
      best->outcome = outcome;
      best->message = message;
      break;
    }
  }
  return *best;
}

/// A point within all constraints from `near`, whose limbs are at their contacts.
///
/// Where forces have few weights and the motion is steep, the kernel gets stuck between cones and limits. Then motions
/// of forces with more weights come first: they are found sooner, and those asked for are near them. What is left is
/// the start x that the search was given, which is no worse than where a failed one stopped.
nlp::Solution Planner::Impl::within_cones(const Options& with, const Eigen::VectorXd& near, const Eigen::VectorXd& x) {
  const std::optional<Forces> more = freer(with.forces);
  if (with.solver == nlp::Solver::ipopt || !with.dynamics || !more) return run(with, 0.0, near);
  const Options trial = trial_of(with);
  Options easier = trial;
  easier.forces = *more;
  nlp::Solution solution = run(trial, 0.0, near);
  if (ends_all(solution.outcome)) return solution;
  const nlp::Solution found = run(easier, 0.0, moved(near, with, easier));
  if (found.outcome == nlp::Outcome::converged || found.outcome == nlp::Outcome::interrupted)
    solution = better_of(std::move(solution), run(trial, 0.0, moved(found.x, easier, with)));
  if (ends_all(solution.outcome)) return solution;
  return better_of(std::move(solution), run(with, 0.0, x));
}

/// A point within all constraints.
///
/// Kinematics come first: a small program that brings the limbs to their contacts, after which forces need half of
/// the iterations. Where phases have durations of their own, one duration for all is searched: the knots stay equally
/// spaced, and motions found so are not driven to their shortest phases. Nor does the kernel choose a weight for each
/// point before there is a cost: from what a first motion needed of them walking may end in a minimum that costs 4 %
/// more.
nlp::Solution Planner::Impl::feasible(const Eigen::VectorXd& x) {
  Options with = options;
  const Range together = total_range(task, options);
  const bool together_first = options.free_durations && options.has_cost() && together.min <= together.max;
  if (together_first) with.free_durations = false;
  if (options.solver != nlp::Solver::ipopt && options.has_cost() && options.forces == Forces::per_point)
    with.forces = Forces::per_body;
  const bool convert = together_first || with.forces != options.forces;
  Eigen::VectorXd start = convert ? moved(x, options, with) : x;
  if (options.dynamics && options.kinematics_first && options.forces != Forces::parameters) {
    Options kinematics = with;
    if (with.solver == nlp::Solver::ipm) kinematics = trial_of(with);
    kinematics.dynamics = false;
    kinematics.order = std::min(options.order, kKinematicOrder);
    kinematics.neq = std::min(options.neq, kinematics.order);
    nlp::Solution found = run(kinematics, 0.0, moved(start, with, kinematics));
    const Layout layout_with(task, with);
    const int splines_and_durations = layout_with.first_duration + layout_with.durations;  // weights stay as they are
    if (found.outcome == nlp::Outcome::converged || ends_all(found.outcome))
      start.head(splines_and_durations) = moved(found.x, kinematics, with).head(splines_and_durations);
    if (found.outcome != nlp::Outcome::converged && ends_all(found.outcome)) {
      found.x = convert ? moved(start, with, options) : start;
      return found;
    }
  }
  nlp::Solution solution = within_cones(with, start, convert ? moved(x, options, with) : x);
  if (convert) {
    solution.x = moved(solution.x, with, options);
    if (!ends_all(solution.outcome)) solution = run(options, 0.0, x);
  }
  return solution;
}

/// Where the kernel begins with a cost, given a motion within all constraints. Each point with a weight of its own
/// leaves minima beside the one that is sought: the cheapest motion with one weight for each contact, which is one of
/// theirs, comes first, and what is found from there costs no more.
Eigen::VectorXd Planner::Impl::cheaper_start(const Eigen::VectorXd& x, double cost_scale) {
  Options with = options;
  with.forces = Forces::per_body;
  with.solver = nlp::Solver::ipm;
  const bool kernel = attempts_for(options, true).front().solver == nlp::Solver::ipm;
  if (!kernel || !options.dynamics || options.forces != Forces::per_point) return x;
  const nlp::Solution found = run(with, cost_scale, moved(x, options, with));
  return found.outcome == nlp::Outcome::converged ? moved(found.x, with, options) : x;
}

/// Rows for every pair of discs in every interval would be ten times all others, and nearly none of them matters: those
/// that come close on the way are kept apart, and the program is solved again, from a point without collisions where
/// there is one: from within a collision a way out is rarely found.
void Planner::Impl::part(nlp::Solution& solution, double cost_scale, Eigen::VectorXd apart) {
  constexpr int kRounds = 20;
  for (int round = 0; round < kRounds && solution.outcome == nlp::Outcome::converged; ++round) {
    const std::size_t known = close_discs.size();
    add_close_discs(plan_of(task, options, layout, solution.x), close_discs);
    if (close_discs.size() == known) return;
    solution = run(options, 0.0, apart);
    apart = solution.x;
    if (cost_scale > 0.0 && solution.outcome == nlp::Outcome::converged) solution = run(options, cost_scale, apart);
  }
}

/// What the Taylor polynomials leave out of forces and torques may exceed the checker's tolerances by some parts in ten
/// thousand where intervals are long: then again from here with twice that as a margin. The kernel may end at motions
/// with longer intervals: where margins would be large, or do not help, its polynomials get a higher order.
void Planner::Impl::tighten(nlp::Solution& solution, double cost_scale) {
  constexpr int kMaxOrder = 12, kRounds = 3;
  constexpr double kMaxMargin = 0.02, kLargeExcess = 1e-3;
  const bool kernel = options.solver != nlp::Solver::ipopt;
  Options with = options;
  bool moved = true;
  for (int round = 0; round < (kernel ? 6 : kRounds) && solution.outcome == nlp::Outcome::converged; ++round) {
    if (deadline.limited() && deadline.remaining_s() <= 2.0 * finishing_s(options, solution.x)) return;
    double excess = 0.0;
    for (const Violation& v : judged(plan_of(task, options, layout, solution.x)).violations()) {
      if (v.name != "torque" && v.name != "friction" && v.name != "pull") return;
      excess = std::max(excess, v.value);
    }
    if (excess == 0.0) return;
    if (kernel && with.order < kMaxOrder && (excess > kLargeExcess || !moved))
      with.order = std::min(with.order + 2, kMaxOrder);
    else
      with.margin += 2.0 * excess;
    if (with.margin > kMaxMargin) return;
    nlp::Solution next = run(with, cost_scale, solution.x, excess <= kLargeExcess || !kernel);
    if (next.outcome != nlp::Outcome::converged) return;
    moved = next.x != solution.x;
    solution = std::move(next);
  }
}

Result Planner::Impl::solve(const Eigen::VectorXd& start) {
  Result result;
  report = Report();
  close_discs.clear();
  const bool cost = options.has_cost();
  nlp::Solution solution;
  solution.x = start;
  solution.outcome = nlp::Outcome::converged;
  Program measure(task, options, Curvature::none, 0.0, start, &close_discs);
  rows = measure.problem().row_count();
  took = {};
  if (deadline.limited()) measure_finishing(measure.problem(), start);
  const bool inside = measure.problem().worst_violation(start).value <= options.constraint_tolerance;
  if (!cost || (options.feasible_first && !inside)) solution = feasible(start);
  if (options.self_collision) part(solution, 0.0, solution.x);
  const Eigen::VectorXd apart = solution.x;
  double cost_scale = 0.0;
  if (cost && solution.outcome == nlp::Outcome::converged) {
    constexpr double kStartCost = 100.0;  // the objective at the start: its gradients are then of the size of the rows'
    cost_scale = kStartCost / std::max(measure.cost(apart), 1e-9);
    solution = run(options, cost_scale, inside ? apart : cheaper_start(apart, cost_scale));
    // A solver that is stopped early has moved its start into the interior, and may have nothing as good yet.
    const auto value = [&](const Eigen::VectorXd& at) { return measure.problem().worst_violation(at).value; };
    const bool worse =
        value(solution.x) > options.constraint_tolerance || measure.cost(solution.x) > measure.cost(apart);
    if (solution.outcome != nlp::Outcome::converged && value(apart) <= options.constraint_tolerance && worse)
      solution.x = apart;
  }
  if (options.self_collision && cost_scale > 0.0) part(solution, cost_scale, apart);
  if (options.dynamics) tighten(solution, cost_scale);
  const Eigen::VectorXd& x = solution.x;
  result.plan = plan_of(task, options, layout, x);
  report.cost = measure.cost(x);
  report.cost_terms["duration"] = measure.duration(x);
  if (options.dynamics) report.cost_terms["torque"] = measure.torque_cost(x);
  if (options.jerk_weight > 0.0) report.cost_terms["jerk"] = measure.jerk_cost(x);
  result.solver = solution.solver;
  result.parameters = layout.parameters;
  result.constraints = rows;
  judge(result, solution);
  return result;
}

/// The checker's findings on what the options ask for.
CheckResult Planner::Impl::judged(const PlanarPlan& plan) const {
  CheckResult found = check(plan, {}, options.self_collision);
  auto& constraints = found.constraints;
  constraints.erase(std::remove_if(constraints.begin(), constraints.end(),
                                   [&](const Violation& v) { return !asked_for(v.name, options); }),
                    constraints.end());
  return found;
}

/// The checker's word, and what the solver said.
void Planner::Impl::judge(Result& result, const nlp::Solution& solution) {
  const double start_s = deadline.elapsed_s();
  report.status = nlp::status_of(solution.outcome);
  report.message = solution.message;
  const CheckResult found = judged(result.plan);
  report.worst_violation = found.worst();
  if (report.status == Status::solved && !found.ok()) {
    report.status = Status::acceptable;
    report.message = "converged, but the checker finds " + found.worst().to_string();
  } else if (report.status != Status::solved && !found.ok()) {
    report.message += "; violated most: " + found.worst().to_string();
  } else if (report.status != Status::solved && !options.has_cost()) {
    report.message = "the checker accepts the plan, on which the search " + solution.message;
    report.status = Status::solved;
  } else if (report.status != Status::solved) {
    report.message += "; the checker accepts the plan, which is not the cheapest";
  }
  for (const Violation& worst : found.constraints) {
    if (worst.name == "drift") result.drift_m = worst.value;
    if (worst.name == "drift_angle") result.drift_rad = worst.value;
  }
  report.timing_s["check"] = deadline.elapsed_s() - start_s;
  report.time_s = deadline.elapsed_s();
  report.version = MCPLAN_VERSION;
  result.report = report;
}

Planner::Planner(const PlanarTask& task, const Options& options) : impl_(std::make_unique<Impl>(task, options)) {}
Planner::~Planner() = default;
Planner::Planner(Planner&&) noexcept = default;
Planner& Planner::operator=(Planner&&) noexcept = default;

Result Planner::solve() {
  impl_->deadline = Deadline(impl_->options.time_limit_s, impl_->options.clock);
  return impl_->solve(zero_start(impl_->task, impl_->options, impl_->layout));
}

Result Planner::solve(const PlanarPlan& warm_start) {
  impl_->deadline = Deadline(impl_->options.time_limit_s, impl_->options.clock);
  return impl_->solve(parameters_of(warm_start, impl_->task, impl_->options, impl_->layout));
}

int Planner::parameters() const { return impl_->layout.parameters; }
int Planner::constraints() const { return impl_->row_count(); }

}  // namespace mcplan::sip
