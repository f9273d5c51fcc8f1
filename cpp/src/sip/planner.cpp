#include "mcplan/sip/planner.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "mcplan/nlp/solver.hpp"
#include "mcplan/sip/program.hpp"
#include "mcplan/version.hpp"

namespace mcplan::sip {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// One way of solving a program.
struct Attempt {
  HessianChoice hessian;
  bool adaptive_barrier;
  double initial_barrier;
  int max_iterations;
};

// Without a cost second derivatives say little: L-BFGS, the weak pull's own Hessian, and the exact one each solve what
// the others do not. With one the exact Hessian converges in some tens of iterations where Gauss-Newton, which leaves
// out the constraints' curvature, needs hundreds (docs/theory/sip.md).
std::vector<Attempt> attempts_for(const Options& options, bool cost) {
  const int most = options.max_iterations, some = std::min(most, 200);
  if (options.hessian != HessianChoice::automatic) return {{options.hessian, !cost, cost ? 0.01 : 0.1, most}};
  if (cost)
    return {{HessianChoice::exact, false, 0.01, most},
            {HessianChoice::exact, true, 0.1, most},
            {HessianChoice::gauss_newton, true, 0.1, most}};
  return {{HessianChoice::limited_memory, true, 0.1, some},
          {HessianChoice::gauss_newton, true, 0.1, some},
          {HessianChoice::exact, true, 0.1, most}};
}

bool ends_all(Status status) {
  return status == Status::solved || status == Status::time_limit || status == Status::interrupted;
}

/// What a valid motion may lack for this planner, by the first field that does.
void require_plannable(const PlanarMotion& motion, const Options& options) {
  if (motion.robot.joint_count() < 1)
    throw InvalidRobot("bodies", "needs at least one joint to plan", "the base alone");
  if (motion.interval_count() < 2)
    throw InvalidMotion("phases[0].intervals",
                        "must be at least 2 in a motion of one phase, to be at rest at both ends",
                        text(motion.interval_count()));
  if (options.dynamics && options.forces == Forces::parameters) return;
  for (std::size_t k = 0; k < motion.phases.size(); ++k) {
    Eigen::Index points = 0;
    for (const PlanarContact& contact : motion.phases[k].contacts)
      points += static_cast<Eigen::Index>(motion.robot.end_effectors[contact.end_effector].points.size());
    try {
      least_norm_gain(motion, static_cast<int>(k), Eigen::VectorXd::Ones(points));
    } catch (const InvalidPlan& error) {
      throw InvalidMotion("phases[" + std::to_string(k) + "].contacts", error.rule(), error.value());
    }
  }
}

/// The motion's and the options' bounds of durations must leave something between them.
void require_durations(const nlp::Problem& problem, const Layout& layout, const Options& options) {
  for (int i = 0; i < layout.durations; ++i) {
    const int variable = layout.first_duration + i;
    const double lower = problem.variable_lower()[variable], upper = problem.variable_upper()[variable];
    if (lower > upper)
      throw InvalidOptions(options.free_durations ? "phase_duration_s" : "total_duration_s",
                           "must overlap with what the motion allows" +
                               (options.free_durations ? " phase " + std::to_string(i) : std::string()),
                           "at least " + text(lower) + " and at most " + text(upper) + " s");
  }
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
  PlanarMotion motion;
  Options options;
  Layout layout;
  int rows = 0;
  Clock::time_point begin;
  Report report;

  Impl(const PlanarMotion& of, const Options& with) : motion(of), options(with), layout(checked(of, with), with) {
    const Program program(motion, options, Curvature::gauss_newton, 0.0, Eigen::VectorXd::Zero(layout.parameters));
    require_durations(program.problem(), layout, options);
    rows = program.problem().row_count();
  }

  static const PlanarMotion& checked(const PlanarMotion& motion, const Options& options) {
    motion.validate();
    options.validate();
    require_plannable(motion, options);
    return motion;
  }

  nlp::Solution run(const Options& with, double cost_scale, const Eigen::VectorXd& x);
  Eigen::VectorXd feasible(const Eigen::VectorXd& x, nlp::Solution& last);
  Result solve(Eigen::VectorXd x);
  void judge(Result& result, const nlp::Solution& solution);
};

/// All attempts in turn, until one solves the program; the best of them otherwise.
nlp::Solution Planner::Impl::run(const Options& with, double cost_scale, const Eigen::VectorXd& x) {
  const bool cost = cost_scale > 0.0;
  std::optional<nlp::Solution> best;
  for (const Attempt& attempt : attempts_for(with, cost)) {
    const double left = with.time_limit_s - seconds_since(begin);
    if (best && left <= 0.0) {
      if (best->status == Status::acceptable) break;
      best->status = Status::time_limit;
      best->message = "reached time_limit_s";
      break;
    }
    const bool exact = attempt.hessian == HessianChoice::exact;
    Program program(motion, with, exact ? Curvature::exact : Curvature::gauss_newton, cost_scale, x);
    nlp::SolverOptions how;
    how.tolerance = with.tolerance;
    how.constraint_tolerance = with.constraint_tolerance;
    how.max_iterations = attempt.max_iterations;
    how.time_limit_s = std::max(left, 1e-3);
    how.hessian = attempt.hessian == HessianChoice::limited_memory ? nlp::Hessian::limited_memory : nlp::Hessian::exact;
    how.initial_barrier = attempt.initial_barrier;
    how.adaptive_barrier = attempt.adaptive_barrier;
    how.gradient_scaling = false;
    how.logger = with.logger;
    how.stop = with.stop;
    nlp::Solution solution = nlp::solve(program.problem(), x, how);
    report.iterations += solution.iterations;
    report.timing_s["evaluation"] += solution.evaluation_s;
    report.timing_s["linear_solver"] += solution.linear_solver_s;
    const bool kept = solution.worst.value <= with.constraint_tolerance;
    const bool best_kept = best && best->worst.value <= with.constraint_tolerance;
    const bool better = !best || (kept && !best_kept) || (kept && best_kept && solution.cost < best->cost) ||
                        (!kept && !best_kept && solution.worst.value < best->worst.value);
    const Status status = solution.status;
    const std::string message = solution.message;
    if (better || status == Status::solved) best = std::move(solution);
    if (ends_all(status)) {
      best->status = status;
      best->message = message;
      break;
    }
  }
  return *best;
}

/// A point within all constraints. Where phases have durations of their own, one duration for all is searched first:
/// the knots stay equally spaced, and motions found so are not driven to their shortest phases.
Eigen::VectorXd Planner::Impl::feasible(const Eigen::VectorXd& x, nlp::Solution& last) {
  if (!options.free_durations) {
    last = run(options, 0.0, x);
    return last.x;
  }
  Options together = options;
  together.free_durations = false;
  const Layout other(motion, together);
  const Eigen::VectorXd start = parameters_of(plan_of(motion, options, layout, x), motion, together, other);
  last = run(together, 0.0, start);
  Eigen::VectorXd out = parameters_of(plan_of(motion, together, other, last.x), motion, options, layout);
  if (last.status == Status::solved || ends_all(last.status)) return out;
  last = run(options, 0.0, x);
  return last.x;
}

Result Planner::Impl::solve(Eigen::VectorXd x) {
  Result result;
  report = Report();
  const bool cost =
      options.has_cost() && (options.dynamics || options.duration_weight > 0.0 || options.jerk_weight > 0.0);
  Program measure(motion, options, Curvature::gauss_newton, 0.0, x);
  const auto kept = [&] { return measure.problem().worst_violation(x).value <= options.constraint_tolerance; };
  nlp::Solution solution;
  solution.status = Status::solved;
  if (!cost || (options.feasible_first && !kept())) {
    if (cost || options.free_durations == false)
      x = feasible(x, solution);
    else {
      solution = run(options, 0.0, x);
      x = solution.x;
    }
    if (options.logger) options.logger(LogLevel::info, "constraints: " + solution.message);
  }
  if (cost && (solution.status == Status::solved || !options.feasible_first)) {
    constexpr double kStartCost = 100.0;  // the objective at the start: its gradients are then of the size of the rows'
    solution = run(options, kStartCost / std::max(measure.cost(x), 1e-9), x);
    // A solver that is stopped early has moved its start into the interior, and may have nothing as good yet.
    const auto value = [&](const Eigen::VectorXd& at) { return measure.problem().worst_violation(at).value; };
    const bool worse = value(solution.x) > options.constraint_tolerance || measure.cost(solution.x) > measure.cost(x);
    if (solution.status == Status::solved || !kept() || !worse) x = solution.x;
  }
  solution.x = x;
  result.plan = plan_of(motion, options, layout, x);
  report.cost = measure.cost(x);
  report.cost_terms["duration"] = measure.duration(x);
  if (options.dynamics) report.cost_terms["torque"] = measure.torque_cost(x);
  if (options.jerk_weight > 0.0) report.cost_terms["jerk"] = measure.jerk_cost(x);
  result.parameters = layout.parameters;
  result.constraints = rows;
  judge(result, solution);
  return result;
}

/// The checker's word, and what the solver said.
void Planner::Impl::judge(Result& result, const nlp::Solution& solution) {
  const Clock::time_point start = Clock::now();
  report.status = solution.status;
  report.message = solution.message;
  CheckResult found = check(result.plan, {}, options.self_collision);
  auto& constraints = found.constraints;
  constraints.erase(std::remove_if(constraints.begin(), constraints.end(),
                                   [&](const Violation& v) { return !asked_for(v.name, options); }),
                    constraints.end());
  report.worst_violation = found.worst();
  if (report.status == Status::solved && !found.ok()) {
    report.status = Status::acceptable;
    report.message = "converged, but the checker finds " + found.worst().to_string();
  } else if (report.status != Status::solved && !found.ok()) {
    report.message += "; violated most: " + found.worst().to_string();
  }
  const Drift drift = largest_drift(result.plan);
  result.drift_m = drift.position_m;
  result.drift_rad = drift.angle_rad;
  report.timing_s["check"] = seconds_since(start);
  report.time_s = seconds_since(begin);
  report.version = MCPLAN_VERSION;
  result.report = report;
}

Planner::Planner(const PlanarMotion& motion, const Options& options) : impl_(std::make_unique<Impl>(motion, options)) {}
Planner::~Planner() = default;
Planner::Planner(Planner&&) noexcept = default;
Planner& Planner::operator=(Planner&&) noexcept = default;

Result Planner::solve() {
  impl_->begin = Clock::now();
  return impl_->solve(zero_start(impl_->motion, impl_->options, impl_->layout));
}

Result Planner::solve(const WholeBodyPlan& warm_start) {
  impl_->begin = Clock::now();
  return impl_->solve(parameters_of(warm_start, impl_->motion, impl_->options, impl_->layout));
}

int Planner::parameters() const { return impl_->layout.parameters; }
int Planner::constraints() const { return impl_->rows; }

}  // namespace mcplan::sip
