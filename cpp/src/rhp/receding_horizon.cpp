#include "mcplan/rhp/receding_horizon.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "mcplan/base/deadline.hpp"
#include "mcplan/base/error.hpp"
#include "mcplan/ipm/solver.hpp"
#include "mcplan/nlp/solver.hpp"
#include "mcplan/plan/checker.hpp"
#include "mcplan/plan/friction_use.hpp"
#include "mcplan/version.hpp"
#include "rhp/execution.hpp"
#include "rhp/foothold_margins.hpp"
#include "rhp/guess.hpp"
#include "rhp/horizon.hpp"
#include "rhp/human_size.hpp"
#include "rhp/solver_options.hpp"
#include "rhp/walker.hpp"

namespace mcplan::rhp {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// The forward-Euler motion is not the integral of its forces: what the checker says of that comes with the method.
bool only_euler_drift(const CheckResult& result) {
  for (const Violation& v : result.violations())
    if (v.name != "dynamics" && v.name != "at_consistency") return false;
  return true;
}

/// A limit of time or iterations came before the end of the solve.
bool cut_short(const Cycle& cycle) {
  return cycle.status == Status::time_limit || cycle.status == Status::iteration_limit;
}

}  // namespace

struct RecedingHorizon::Impl {
  Impl(const Scene& scene, const Robot& robot, const Options& options)
      : size(scene, robot, options), walker(size.walker()) {}

  /// Margins of the footholds that the whole sequence leaves room for.
  void keep_in_reach() {
    const FootholdMargins margins(walker, state, footsteps);
    walker.margin_ratios = margins.ratios;
    out_of_reach = margins.out_of_reach;
    yielded = margins.yielded;
  }

  void start_at(const State& own) {
    unfinished.reset();
    own_state = own;
    state = size.to_human(own);
  }

  HumanSize size;
  Walker walker;  ///< of human size, as is all here whose name does not say "own"
  Footsteps footsteps;
  std::string out_of_reach;  ///< the step that no foothold makes possible, if there is one
  std::string yielded;       ///< which margins are smaller than the option says, if any
  State state, own_state;
  bool moved = false;            ///< the next cycle starts where no cycle has ended
  bool measured = false;         ///< the walk did not start where the scene says
  int index = 0;                 ///< cycles done well
  std::optional<Memory> memory;  ///< of the last cycle
  Plan executed, horizon;
  bool horizon_rests = false;  ///< at its end
  int steps_used = 0;          ///< of the horizon, after its first
  double finishing_s = 0.0;    ///< that the last accepted cycle took after its solve
  Plan walked;
  std::vector<Cycle> cycles;
  /// A horizon and, once there is one, its solution; where a limit cuts its solve short without a step, the next cycle
  /// from the same state goes on there.
  struct Unfinished {
    HorizonRequest request;
    Horizon horizon;
    nlp::Solution solution;
  };
  std::optional<Unfinished> unfinished;
  void solve(Cycle& cycle, Unfinished& now, const Deadline& deadline) const;
  void accept(Cycle& cycle, const Unfinished& now, const Deadline& deadline);

  int steps_left() const { return footsteps.ends() ? footsteps.count() - index : walker.options.lookahead; }

  Cycle run();
  bool find_step();
  HorizonRequest request_for(int steps) const;
  CheckResult checked(const Plan& step) const;
  void accept_predicted(Cycle& cycle);
  void take(Cycle& cycle, Plan next, const CheckResult& found, const RunningCost& cost);
};

HorizonRequest RecedingHorizon::Impl::request_for(int steps) const {
  // The last solution, left and right exchanged if it began with the other leg, unless the horizon has become shorter
  // or the feet have not the same points.
  const Memory* last = memory && static_cast<int>(memory->footholds_W.size()) == steps ? &*memory : nullptr;
  const auto pointed = [this](int foot) { return walker.feet[foot].half_size.maxCoeff() == 0.0; };
  if (last && last->swing != footsteps[index].foot && pointed(0) != pointed(1)) last = nullptr;
  HorizonRequest request;
  request.state = state;
  request.first = index;
  request.steps = steps;
  request.footholds_W = last ? moved_footholds(walker, state, footsteps, index, *last)
                             : nominal_footholds(walker, state, footsteps, index, steps);
  request.rest = footsteps.ends() && steps == steps_left();
  request.guess = [this, last](const Horizon& built) {
    return last && last->x.size() == built.problem.variable_count() ? remembered_guess(walker, state, built, *last)
                                                                    : nominal_guess(walker, state, built);
  };
  return request;
}

Cycle RecedingHorizon::Impl::run() {
  const Options& options = walker.options;
  const Deadline deadline(options.time_limit_s, options.clock);
  Cycle cycle;
  cycle.index = static_cast<int>(cycles.size());
  const int steps = std::min(options.lookahead, steps_left());
  if (steps <= 0) throw InvalidInput("cycles", "must not go beyond the sequence of steps", text(index + 1));
  std::optional<Unfinished> now = std::exchange(unfinished, std::nullopt);
  if (!now) {
    now.emplace();
    now->request = request_for(steps);
    now->horizon = build_horizon(walker, footsteps, now->request);
  }
  nlp::Solution& solution = now->solution;
  solve(cycle, *now, deadline);
  cycle.status = nlp::status_of(solution.outcome);
  cycle.message = solution.message;
  cycle.variables = now->horizon.problem.variable_count();
  cycle.constraints = now->horizon.problem.row_count();
  cycle.cost = solution.cost;
  cycle.worst_violation.name = solution.worst.name;
  cycle.worst_violation.value = solution.worst.value;
  cycle.worst_violation.tolerance = options.constraint_tolerance;
  const bool keeps = solution.worst.value <= options.constraint_tolerance;
  if (!keeps && cycle.status == Status::solved) cycle.status = Status::acceptable;
  if (keeps || cut_short(cycle)) accept(cycle, *now, deadline);
  if (!cycle.executed && cut_short(cycle)) accept_predicted(cycle);
  if (!cycle.executed && cut_short(cycle)) unfinished = std::move(now);
  if (!cycle.executed && !out_of_reach.empty()) cycle.message += (cycle.message.empty() ? "" : "; ") + out_of_reach;
  cycle.time_s = deadline.elapsed_s();
  cycles.push_back(cycle);
  if (options.logger)
    options.logger(LogLevel::info, "cycle " + std::to_string(cycle.index) + "  " +
                                       std::string(to_string(cycle.status)) + "  " + text(cycle.iterations) +
                                       " iterations, " + text(cycle.time_s) + " s");
  return cycle;
}

/// A cycle, and others that go on with it where time_limit cuts it short without a step: no longer than the step under
/// way lasts (the first cycle's robot stands), and at most kFurtherCalls.
bool RecedingHorizon::Impl::find_step() {
  const double under_way_s = walked.phases.empty() ? nlp::kInfinity : executed.duration() * size.own().time;
  double spent_s = 0.0;
  for (int call = 0; call <= kFurtherCalls; ++call) {
    const Cycle cycle = run();
    if (cycle.executed) return true;
    spent_s += cycle.time_s;
    if (cycle.status != Status::time_limit || spent_s + cycle.time_s > under_way_s) return false;
  }
  return false;
}

/// Solve the horizon, from where its solve was cut short if it was; again with the faces of reach that were left out
/// and matter after all: `now` becomes the one that the solution is of.
void RecedingHorizon::Impl::solve(Cycle& cycle, Unfinished& now, const Deadline& deadline) const {
  const Options& options = walker.options;
  nlp::Solution& solution = now.solution;
  for (int attempt = 0;; ++attempt) {
    nlp::SolverOptions how = solver_options(options, deadline.remaining_s());
    // Close to the solution already. The kernel begins well inside all bounds wherever it is.
    if (attempt > 0 && options.solver == nlp::Solver::ipopt) how.initial_barrier = 1e-4;
    if (attempt == 0 && solution.x.size() > 0) {
      now.horizon.guess = solution.x;
      how.start = {solution.multipliers, solution.bound_multipliers};
      if (solution.barrier > 0.0) how.initial_barrier = solution.barrier;
    }
    if (deadline.limited()) how.finishing_s = [this](const VectorXd&) { return finishing_s; };
    how.max_iterations = std::max(1, options.max_iterations - cycle.iterations);
    solution = ipm::solve(options.solver, now.horizon.problem, now.horizon.guess, how);
    cycle.solver = solution.solver;
    cycle.iterations += solution.iterations;
    cycle.evaluation_s += solution.evaluation_s;
    cycle.linear_solver_s += solution.linear_solver_s;
    // Faces that were left out and matter after all: again with them, from here.
    constexpr int kAttempts = 5;
    const std::set<ReachRow> missed = violated_reach(walker, now.horizon, solution.x, options.constraint_tolerance);
    if (missed.empty() || attempt == kAttempts || solution.outcome != nlp::Outcome::converged || deadline.passed()) {
      const nlp::Problem::Worst unseen = worst_left_out(walker, now.horizon, solution.x);
      if (unseen.value > solution.worst.value) solution.worst = unseen;
      if (!missed.empty() && solution.outcome == nlp::Outcome::converged && deadline.passed()) {
        solution.outcome = nlp::Outcome::time_limit;
        solution.message = "reached time_limit_s";
      }
      return;
    }
    now.request.reach_rows.insert(missed.begin(), missed.end());
    now.request.guess = [x = solution.x](const Horizon&) { return x; };
    now.horizon = build_horizon(walker, footsteps, now.request);
  }
}

CheckResult RecedingHorizon::Impl::checked(const Plan& step) const {
  Tolerances tolerances;
  tolerances.sample_s = 0.005;
  return check(size.to_own(step), size.scene(), size.robot(), tolerances);
}

/// Take a motion that keeps the program's constraints, or one that does not quite and is usable all the same; the
/// checker decides whether it is called solved.
void RecedingHorizon::Impl::accept(Cycle& cycle, const Unfinished& now, const Deadline& deadline) {
  const Horizon& horizon_now = now.horizon;
  const nlp::Solution& solution = now.solution;
  const double start_s = deadline.elapsed_s();
  Plan next = executed_plan(walker, state, horizon_now, solution.x, 1);
  const CheckResult found = checked(next);
  if (!(solution.worst.value <= walker.options.constraint_tolerance) && !usable(found)) {
    cycle.message += "; its best point is not usable: " + found.worst().to_string();
    return;
  }
  const bool euler = walker.options.transcription == Transcription::euler;
  if (cycle.status == Status::solved && !found.ok()) {
    cycle.status = Status::acceptable;
    cycle.message = euler && only_euler_drift(found)
                        ? "converged; the forward-Euler motion is not the integral of its forces"
                        : "converged, but the checker finds " + found.worst().to_string();
  }
  const bool converged =
      solution.outcome == nlp::Outcome::converged || solution.outcome == nlp::Outcome::nearly_converged;
  cycle.step_from = converged ? StepFrom::converged : StepFrom::iterate;
  const Measures measures = measure(walker, state, horizon_now, solution.x, next);
  cycle.drift_com_m = measures.drift_com_m * size.own().length;
  cycle.drift_momentum = measures.drift_momentum * size.own().angular_momentum();
  cycle.defect = measures.defect;
  horizon = executed_plan(walker, state, horizon_now, solution.x, horizon_now.steps);
  horizon_rests = now.request.rest;
  steps_used = 0;
  memory = memory_of(state, horizon_now, solution.x);
  take(cycle, std::move(next), found, {measures.acceleration_cost, measures.momentum_cost});
  finishing_s = deadline.elapsed_s() - start_s;
}

/// Take the step that the last plan predicted for now, if there is one and it is usable from here. The last step of a
/// horizon that does not end at rest is none: the goal alone pulls at its end, at more than a metre a second, and no
/// cycle was seen to find a step from there.
void RecedingHorizon::Impl::accept_predicted(Cycle& cycle) {
  const int steps = static_cast<int>(horizon.phases.size()) / 3, last = horizon_rests ? steps - 1 : steps - 2;
  if (steps_used + 1 > last) return;
  Plan next = predicted_step(walker, state, horizon, steps_used + 1);
  const CheckResult found = checked(next);
  if (!usable(found)) {
    cycle.message += "; the step that the last plan predicted is not usable: " + found.worst().to_string();
    return;
  }
  cycle.step_from = StepFrom::previous_plan;
  ++steps_used;
  const RunningCost cost = running_cost(walker, next);
  take(cycle, std::move(next), found, cost);
}

/// A step becomes the walk's next one.
void RecedingHorizon::Impl::take(Cycle& cycle, Plan next, const CheckResult& found, const RunningCost& cost) {
  const Similarity& own = size.own();
  cycle.worst_violation = found.worst();
  cycle.acceleration_cost = cost.acceleration * (own.velocity() * own.velocity() / own.time);
  cycle.momentum_cost = cost.momentum * (own.angular_momentum() * own.angular_momentum() * own.time);
  cycle.duration_s = next.duration() * own.time;
  const State end = end_of(walker, next);
  cycle.distance_m = walker.r_WH.col(0).dot(end.com_W - state.com_W) * own.length;
  cycle.executed = true;
  if (walked.phases.empty() || moved) {
    measured = measured || moved;
    walked = next;
    walked.measured_start = measured;
  } else {
    append_plan(walked, next);
  }
  executed = std::move(next);
  moved = false;
  state = end;
  own_state = size.to_own(end);
  ++index;
}

RecedingHorizon::RecedingHorizon(const Scene& scene, const Robot& robot, const Options& options)
    : impl_(std::make_unique<Impl>(scene, robot, options)) {
  impl_->footsteps = footsteps_of(impl_->walker);
  impl_->start_at(impl_->size.to_own(impl_->walker.start()));
  impl_->keep_in_reach();
}

RecedingHorizon::RecedingHorizon(const Scene& scene, const Robot& robot, const Plan& sequence, const Options& options)
    : impl_(std::make_unique<Impl>(scene, robot, options)) {
  impl_->footsteps = footsteps_of(impl_->walker, sequence);
  impl_->start_at(start_of(impl_->walker, sequence));
  impl_->keep_in_reach();
  impl_->measured = sequence.measured_start;
}

RecedingHorizon::~RecedingHorizon() = default;
RecedingHorizon::RecedingHorizon(RecedingHorizon&&) noexcept = default;
RecedingHorizon& RecedingHorizon::operator=(RecedingHorizon&&) noexcept = default;

Cycle RecedingHorizon::step() { return impl_->run(); }

Cycle RecedingHorizon::step(const State& measured) {
  require_state(impl_->walker, measured);
  // A walk joins its steps only where they meet: from elsewhere a new one begins, once its first step is found.
  const State& planned = impl_->own_state;
  const bool elsewhere = measured.com_W != planned.com_W || measured.com_velocity_W != planned.com_velocity_W ||
                         measured.angular_momentum_W != planned.angular_momentum_W ||
                         measured.feet_W != planned.feet_W || measured.surfaces != planned.surfaces;
  impl_->moved = impl_->moved || elsewhere;
  if (elsewhere) impl_->start_at(measured);
  return impl_->run();
}

const State& RecedingHorizon::state() const { return impl_->own_state; }
Plan RecedingHorizon::executed() const { return impl_->size.to_own(impl_->executed); }
Plan RecedingHorizon::horizon() const { return impl_->size.to_own(impl_->horizon); }

Walk RecedingHorizon::walk() {
  const int cycles = impl_->footsteps.ends() ? std::min(impl_->walker.options.cycles, impl_->steps_left())
                                             : impl_->walker.options.cycles;
  int steps = 0;
  while (steps < cycles && impl_->find_step()) ++steps;
  Walk out = result();
  out.success = steps == cycles && out.success;
  return out;
}

Walk RecedingHorizon::result() const {
  Walk out;
  out.plan = impl_->size.to_own(impl_->walked);
  out.cycles = impl_->cycles;
  out.success = !out.cycles.empty();
  Report& report = out.report;
  report.status = out.cycles.empty() ? Status::infeasible : Status::solved;
  report.message = out.cycles.empty() ? "no cycle has run" : "";
  report.version = MCPLAN_VERSION;
  for (const Cycle& cycle : out.cycles) {
    // One that was cut short without a step, and gone on with.
    const bool continued = !cycle.executed && cut_short(cycle) && cycle.index + 1 < static_cast<int>(out.cycles.size());
    out.success = out.success && (cycle.executed || continued);
    report.iterations += cycle.iterations;
    report.time_s += cycle.time_s;
    report.timing_s["evaluation"] += cycle.evaluation_s;
    report.timing_s["linear solver"] += cycle.linear_solver_s;
    report.cost_terms["acceleration"] += cycle.acceleration_cost;
    report.cost_terms["momentum"] += cycle.momentum_cost;
    report.cost += cycle.acceleration_cost + cycle.momentum_cost;
    report.worst_violation = cycle.worst_violation;
    if (continued || cycle.status == Status::solved || (report.status != Status::solved && cycle.executed)) continue;
    report.status = cycle.status;
    report.message = "cycle " + std::to_string(cycle.index) + ": " + cycle.message;
    if (!cycle.executed && cycle.index > 0) report.message += "; the steps before it stand";
  }
  if (report.message.empty()) report.message = impl_->yielded;
  if (out.plan.phases.empty()) return out;

  // The whole walk is what the user gets: it is solved only if the checker accepts it as one piece.
  Plan& plan = out.plan;
  plan.open_end = false;
  CheckResult found = check(plan, plan.scene, plan.robot);
  bool goal_reached = true;
  for (const Violation& v : found.violations()) goal_reached = goal_reached && v.name != "goal";
  if (!goal_reached) {
    plan.open_end = true;
    found = check(plan, plan.scene, plan.robot);
  }
  report.warnings = found.warnings;
  report.friction_use = friction_use(plan);
  if (out.cycles.back().executed) report.worst_violation = found.worst();
  if (report.status == Status::solved && !found.ok()) {
    // A walk through a solid is no matter of margins: nothing here knows of solids, but where soles land.
    constexpr double kThrough = 10.0;
    const Violation& worst = found.worst();
    const bool through =
        (worst.name == "trunk" || worst.name == "limb") && worst.value > kThrough * std::max(worst.tolerance, 0.0);
    report.status = through ? Status::infeasible : Status::acceptable;
    report.message = "every cycle converged, but the checker finds " + found.worst().to_string();
  }
  return out;
}

}  // namespace mcplan::rhp
