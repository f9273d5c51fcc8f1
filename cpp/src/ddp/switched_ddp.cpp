#include "mcplan/ddp/switched_ddp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <sstream>
#include <utility>

#include "mcplan/base/error.hpp"
#include "mcplan/ddp/initial_sequence.hpp"
#include "mcplan/ddp/plan_conversion.hpp"
#include "mcplan/ddp/search.hpp"
#include "mcplan/ddp/stepping_sequence.hpp"
#include "mcplan/plan/checker.hpp"
#include "mcplan/plan/friction_use.hpp"
#include "mcplan/version.hpp"

namespace mcplan::ddp {
namespace {

constexpr int kPolishIterations = 60, kFinalIterations = 120;
constexpr double kRoughCalm = 1e-3, kFinalCalm = 1e-4;
/// Limits are penalties; this much harder ones at the end leave a fraction of the violation.
constexpr double kHardening = 4.0;
/// Proximal weight of the second discovery over the first one's.
constexpr double kSecondDiscovery = 4.0;
/// How much further inside footholds go, each time a swing has caught an edge: a share of the longest half sole, so
/// that the second time the whole sole stands clear of the next riser. Lengths are those of a robot of human size.
constexpr double kClearanceShare = 0.6, kClearanceLeast_m = 0.04;
// Where soles are kept on their surface anyway, a toe's room is enough.
constexpr double kToeRoom_m = 0.03;
/// A violation within this factor of its tolerance is called acceptable, beyond it infeasible.
constexpr double kAcceptable = 10.0;
/// Iterations of Method::paper: the paper counts about 50 to convergence and reports averages over 100.
constexpr int kPaperIterations = 60;

/// Value in tolerances; what admits none is beyond every other violation.
double badness(const Violation& v) {
  if (v.tolerance > 0.0) return v.value / v.tolerance;
  return v.value > 0.0 ? 1e9 * (1.0 + v.value) : 0.0;
}

}  // namespace

struct SwitchedDdp::Impl {
  Scene scene;
  Robot robot;
  Options options;

  /// One solve: the problem, its search and the best plan found so far.
  struct Run {
    Run(const Problem& problem_in, const Deadline& deadline_in) : problem(problem_in), deadline(deadline_in) {
      search.emplace(problem, deadline, report);
    }
    Problem problem;
    const Deadline& deadline;
    Report report;
    std::optional<Search> search;

    struct Finished {
      Plan plan;
      Violation worst;
      bool ok = false;
      Evaluation evaluation;
    };
    std::optional<Finished> best;
    Incumbent last;  ///< of the last attempt, before its contacts were made exact
    bool measured_start = false;

    bool finish(Incumbent now);
    struct Guess {
      Incumbent start;
      double discover_with = 0.0;  ///< proximal weight of a discovery before the polish; 0: the sequence is kept
    };
    Status attempt(std::vector<Guess> guesses);
  };

  PlanResult solve(Problem problem, const Incumbent* warm, bool measured_start);
};

/// Make exact, convert, check; keep the plan if it is the best so far. True when the checker passes.
bool SwitchedDdp::Impl::Run::finish(Incumbent now) {
  // If the contacts cannot be met exactly, the plan is kept as it is, and the checker says what is wrong with it.
  search->make_exact(now);
  const Stopwatch watch(report.timing_s, "check");
  Finished finished;
  finished.plan = to_plan(problem, now);
  finished.plan.measured_start = measured_start;
  finished.evaluation = search->evaluate(now);
  Tolerances tolerances;
  if (!problem.options.one_switch_per_step) tolerances.switches = std::numeric_limits<int>::max();
  const CheckResult result = check(finished.plan, problem.scene, problem.robot, tolerances);
  finished.ok = result.ok();
  finished.worst = result.worst();
  const bool better = !best || (finished.ok && !best->ok) ||
                      (finished.ok == best->ok && (finished.ok ? finished.evaluation.merit() < best->evaluation.merit()
                                                               : badness(finished.worst) < badness(best->worst)));
  if (better) best = std::move(finished);
  return best->ok;
}

/// Polish every guess, those without a sequence of their own after a discovery; refine the cheapest and finish it.
Status SwitchedDdp::Impl::Run::attempt(std::vector<Guess> guesses) {
  Incumbent chosen;
  double lowest = std::numeric_limits<double>::infinity();
  Status status = Status::solved;
  bool stepping_ahead = false;
  for (std::size_t i = 0; i < guesses.size() && status == Status::solved; ++i) {
    const bool discover = guesses[i].discover_with > 0.0;
    // The stepping sequences differ in who begins: when the first of them is ahead, the other is no better.
    if (!discover && stepping_ahead) break;
    Incumbent& now = guesses[i].start;
    if (discover) status = search->discover(now, guesses[i].discover_with);
    if (status == Status::solved) status = search->polish(now, kPolishIterations, kRoughCalm, lowest);
    // A guess that breaks down numerically is dropped, the others may still do.
    if (status == Status::numerical_failure) {
      status = Status::solved;
      continue;
    }
    const double merit = search->evaluate(now).merit();
    if (!std::isfinite(merit) || merit >= lowest) continue;
    lowest = merit;
    stepping_ahead = !discover;
    chosen = std::move(now);
  }
  if (chosen.sequence.empty()) return status == Status::solved ? Status::numerical_failure : status;
  if (status == Status::solved) status = search->refine(chosen);
  if (status == Status::solved) {
    // Limits are penalties: harder ones at the end bring what is left of a violation below the checker's tolerance.
    const double limit = problem.options.weights.limit;
    problem.options.weights.limit *= kHardening;
    status = search->polish(chosen, kFinalIterations, kFinalCalm, std::numeric_limits<double>::infinity());
    problem.options.weights.limit = limit;
  }
  last = chosen;
  finish(std::move(chosen));
  return status;
}

PlanResult SwitchedDdp::Impl::solve(Problem problem, const Incumbent* warm, bool measured_start) {
  // Measured: 0.6 ms a phase for the closing Newton steps and the checker's replay.
  constexpr double kFinishing_s = 1e-3;
  const Deadline deadline = Deadline(options.time_limit_s, options.clock).reserving(kFinishing_s * problem.steps);
  Run run(problem, deadline);
  run.measured_start = measured_start;
  const Problem& p = run.problem;
  run.report.seed = options.seed;
  run.report.threads = options.threads;
  run.report.version = MCPLAN_VERSION;

  const auto first_guess = [&](const ContactSequence& sequence) {
    Incumbent guess;
    guess.trajectory = p.initial_guess(sequence);
    guess.sequence = sequence;
    return guess;
  };
  ContactSequence initial = options.initial_sequence;
  if (initial.empty()) {
    const Trajectory guess = p.initial_guess({});
    Schedule schedule;
    schedule.contact_weight = options.weights.contact_min;
    run.search->model().expand(guess, schedule);
    initial = initial_sequence(run.search->model());
  } else {
    initial = p.to_active(initial);
  }

  using Guess = Run::Guess;
  Status status = Status::no_sequence;
  if (!initial.empty()) {
    Incumbent start = first_guess({});
    start.sequence = initial;
    if (options.method == Method::paper) {
      status = run.search->run_paper(start, std::min(kPaperIterations, options.max_iterations));
      if (status != Status::numerical_failure) run.finish(start);
    } else {
      std::vector<Guess> guesses;
      if (warm) {
        guesses.push_back({*warm});
      } else if (!options.initial_sequence.empty()) {
        guesses.push_back({first_guess(initial)});
      } else {
        // Shorter and longer steps lead to other sequences; the better one goes on.
        guesses.push_back({start, options.proximal_weight});
        guesses.push_back({start, kSecondDiscovery * options.proximal_weight});
        for (int mover : {0, 1}) {
          const ContactSequence stepping = stepping_sequence(p, mover);
          if (!stepping.empty()) guesses.push_back({first_guess(stepping)});
        }
      }
      status = run.attempt(std::move(guesses));

      // Other settings of what the outcome depends on most, in an order drawn from the seed.
      std::vector<std::pair<double, double>> settings{{10.0, 0.30}, {100.0, 0.40}, {30.0, 0.35},
                                                      {10.0, 0.45}, {100.0, 0.30}, {30.0, 0.50}};
      std::mt19937_64 random(options.seed);
      for (std::size_t i = settings.size(); i > 1; --i) std::swap(settings[i - 1], settings[random() % i]);
      for (int i = 0; i < options.restarts && !(run.best && run.best->ok); ++i) {
        if (status != Status::solved && status != Status::numerical_failure) break;
        const auto [proximal, duration_s] = settings[static_cast<std::size_t>(i) % settings.size()];
        run.problem.duration_initial =
            std::clamp(duration_s * p.similarity.time / p.units.time, p.duration_min, p.duration_max);
        Incumbent again = first_guess({});
        again.sequence = initial;
        std::vector<Guess> others{{again, proximal}};
        // A foot too close to the next step catches it with its toe: the same motion with footholds further inside.
        if (run.best && run.best->worst.name == "clearance" && !run.last.sequence.empty()) {
          const double on_surface = options.sole_inside < 0.0 ? robot.sole_support : options.sole_inside;
          double further_m = (on_surface >= 1.0 ? kToeRoom_m : kClearanceLeast_m) * p.similarity.length;
          for (const EndEffector& end : robot.end_effectors)
            if (on_surface < 1.0) further_m = std::max(further_m, kClearanceShare * end.half_size.maxCoeff());
          run.problem.toe_room += further_m / p.units.length;
          others.insert(others.begin(), Guess{run.last});
        }
        status = run.attempt(std::move(others));
      }
    }
  }

  PlanResult out;
  Report& report = run.report;
  if (run.best) {
    out.plan = std::move(run.best->plan);
    report.friction_use = friction_use(out.plan);
    report.worst_violation = run.best->worst;
    report.cost = run.best->evaluation.cost;
    for (int i = 0; i < kTermCount; ++i)
      if (run.best->evaluation.terms[i] > 0.0)
        report.cost_terms[to_string(static_cast<Term>(i))] = run.best->evaluation.terms[i];
    if (run.best->ok)
      status = Status::solved;
    else if (status == Status::solved)
      status = badness(run.best->worst) <= kAcceptable ? Status::acceptable : Status::infeasible;
  } else {
    out.plan.scene = scene;
    out.plan.robot = robot;
    if (status == Status::solved) status = Status::numerical_failure;
    const bool no_sequence = status == Status::no_sequence;
    report.worst_violation.name = no_sequence ? "contact_sequence" : "finite";
    report.worst_violation.value = 1.0;
    report.worst_violation.unit = no_sequence ? "missing" : "numbers";
  }
  report.status = status;
  report.time_s = deadline.elapsed_s();
  std::ostringstream message;
  if (status == Status::solved)
    message << "the checker accepts the plan";
  else if (status == Status::no_sequence)
    message << "no contact sequence joins start and goal in " << p.steps << " phases; raise `phases`, or look at the "
            << "surfaces' end_effectors and the scene's rules";
  else if (!run.best)
    message << (status == Status::numerical_failure ? "every attempt broke down numerically"
                                                    : "stopped before there was a plan");
  else
    message << "the best plan violates " << report.worst_violation.to_string();
  report.message = message.str();
  out.report = std::move(report);
  return out;
}

namespace {

/// What replan() relies on beyond a plan that is valid in itself.
void require_fit(const Plan& previous, const Knot& measured, const Robot& robot) {
  const std::size_t ends = robot.end_effectors.size();
  const auto require_count = [ends](const std::string& field, std::size_t count) {
    if (count != ends)
      throw InvalidPlan(field, "must be one per end-effector (" + std::to_string(ends) + ")", std::to_string(count));
  };
  require_count("previous.robot.end_effectors", previous.robot.end_effectors.size());
  require_count("measured.end_effectors_W", measured.end_effectors_W.size());
  if (!measured.end_effector_yaw.empty()) require_count("measured.end_effector_yaw", measured.end_effector_yaw.size());
  const auto require_finite = [](const std::string& field, const Eigen::Ref<const Eigen::VectorXd>& value) {
    if (!value.allFinite()) throw InvalidPlan("measured." + field, "must be finite numbers", text(value));
  };
  require_finite("com_W", measured.com_W);
  require_finite("com_velocity_W", measured.com_velocity_W);
  require_finite("base_rpy", measured.base_rpy);
  require_finite("base_rpy_rate", measured.base_rpy_rate);
  require_finite("angular_momentum_W", measured.angular_momentum_W);
  for (const Eigen::Vector3d& end : measured.end_effectors_W) require_finite("end_effectors_W", end);
  for (double yaw : measured.end_effector_yaw) require_finite("end_effector_yaw", Eigen::VectorXd::Constant(1, yaw));
}

}  // namespace

SwitchedDdp::SwitchedDdp(const Scene& scene, const Robot& robot, const Options& options)
    : impl_(std::make_unique<Impl>(Impl{scene, robot, options})) {
  // Working the problem out validates everything.
  const Problem problem(scene, robot, options);
  if (!options.initial_sequence.empty()) problem.to_active(options.initial_sequence);
}
SwitchedDdp::~SwitchedDdp() = default;
SwitchedDdp::SwitchedDdp(SwitchedDdp&&) noexcept = default;
SwitchedDdp& SwitchedDdp::operator=(SwitchedDdp&&) noexcept = default;

PlanResult SwitchedDdp::solve() {
  return impl_->solve(Problem(impl_->scene, impl_->robot, impl_->options), nullptr, false);
}

PlanResult SwitchedDdp::solve(const Plan& warm_start) {
  warm_start.validate();
  Options options = impl_->options;
  options.phases = static_cast<int>(warm_start.phases.size());
  const Problem problem(impl_->scene, impl_->robot, options);
  const Incumbent warm = from_plan(problem, warm_start, 0);
  if (warm.sequence.empty() || !problem.rules.valid(warm.sequence)) return impl_->solve(problem, nullptr, false);
  return impl_->solve(problem, &warm, false);
}

PlanResult SwitchedDdp::replan(const Plan& previous, double t, const Knot& measured) {
  previous.validate();
  require_fit(previous, measured, impl_->robot);
  const PlanState now = previous.at(t);
  const std::vector<double> times = previous.knot_times();
  int first = now.phase;
  double remaining = times[first + 1] - t;
  // What is left of the phase is too short to be planned: the next one starts now.
  const double shortest = 0.02 * similarity_of(impl_->robot, impl_->scene.gravity).time;
  const int phases = static_cast<int>(previous.phases.size());
  if (remaining < shortest && first + 1 < phases) {
    ++first;
    remaining = previous.phases[first].duration;
  }
  Options options = impl_->options;
  options.phases = phases - first;
  options.initial_sequence.clear();
  Problem problem(impl_->scene, impl_->robot, options);
  ContactState contacts;
  for (int e : problem.active) {
    const int surface = previous.phases[first].contacts[e].surface;
    contacts.push_back(surface == kFree ? kFree : problem.scene.surface_index(previous.scene.surfaces[surface].name));
  }
  problem.set_start(measured, contacts);
  problem.first_duration = remaining / problem.units.time;
  Incumbent warm = from_plan(problem, previous, first);
  if (warm.sequence.empty() || !problem.rules.valid(warm.sequence)) return impl_->solve(problem, nullptr, true);
  warm.trajectory.x.front() = problem.start;
  warm.trajectory.u.front()[problem.layout.duration()] = problem.first_duration;
  return impl_->solve(problem, &warm, true);
}

}  // namespace mcplan::ddp
