#include "mcplan/ddp/switched_ddp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <utility>

#include "mcplan/base/error.hpp"
#include "mcplan/ddp/best_plan.hpp"
#include "mcplan/ddp/constants.hpp"
#include "mcplan/ddp/initial_sequence.hpp"
#include "mcplan/ddp/plan_conversion.hpp"
#include "mcplan/ddp/reachable_surfaces.hpp"
#include "mcplan/ddp/search.hpp"
#include "mcplan/ddp/stepping_sequence.hpp"
#include "mcplan/plan/friction_use.hpp"
#include "mcplan/version.hpp"

namespace mcplan::ddp {
namespace {

/// Whether a search that ended so may have missed what it did not look at.
bool ended_by_itself(Status status) {
  return status == Status::solved || status == Status::numerical_failure || status == Status::no_sequence;
}

}  // namespace

struct SwitchedDdp::Impl {
  Scene scene;
  Robot robot;
  Options options;

  /// What a solve begins with: the scene's start, or an earlier plan from one of its phases on, and where it was.
  struct Request {
    const Plan* earlier = nullptr;
    int first = 0;                   ///< phase of the earlier plan that comes first
    const Knot* measured = nullptr;  ///< state at the start instead of the scene's
    double remaining_s = 0.0;        ///< of the first phase, when measured
  };

  /// One search: the problem on some of the scene's surfaces, and what is known of it.
  struct Run {
    Run(Problem&& problem_in, std::vector<int> surfaces_in, const Deadline& deadline_in, BestPlan& best_in,
        Report& report_in)
        : problem(std::move(problem_in)),
          surfaces(std::move(surfaces_in)),
          deadline(deadline_in),
          best(best_in),
          report(report_in),
          search(problem, deadline, report) {
      if (deadline.limited()) search.watch([this](const Incumbent& now) { best.keep(search, problem, surfaces, now); });
    }
    Problem problem;
    std::vector<int> surfaces;
    const Deadline& deadline;
    BestPlan& best;
    Report& report;
    Search search;
    Incumbent last;  ///< of the last attempt, before its contacts were made exact

    struct Guess {
      Incumbent start;
      double discover_with = 0.0;  ///< proximal weight of a discovery before the polish; 0: the sequence is kept
    };
    Incumbent first_guess(const ContactSequence& sequence) const;
    Incumbent at_once(const ContactSequence& sequence);
    ContactSequence initial(Status& status);
    Status attempt(std::vector<Guess> guesses);
    std::vector<Guess> guesses(const Incumbent& start, const Incumbent* warm) const;
    Status restart(Status status, const ContactSequence& initial);
    Status run(const Incumbent* warm);
    void finish(Incumbent now) { best.finish(search, problem, surfaces, std::move(now)); }
  };

  std::vector<int> surfaces_of(const Request& request, const Outlook& outlook) const;
  Problem pose(const Request& request, const std::vector<int>& surfaces) const;
  PlanResult solve(const Request& request);
  PlanResult conclude(Status status, int steps, const BestPlan& best, Report&& report, double time_s) const;
};

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
    if (discover) status = search.discover(now, guesses[i].discover_with);
    if (status == Status::solved) status = search.polish(now, kPolishIterations, kRoughCalm, lowest);
    // A guess that breaks down numerically is dropped, the others may still do.
    if (status == Status::numerical_failure) {
      status = Status::solved;
      continue;
    }
    const double merit = search.evaluate(now).merit();
    if (!std::isfinite(merit) || merit >= lowest) continue;
    lowest = merit;
    stepping_ahead = !discover;
    chosen = std::move(now);
  }
  if (chosen.sequence.empty()) return status == Status::solved ? Status::numerical_failure : status;
  if (status == Status::solved) status = search.refine(chosen);
  if (status == Status::solved) {
    // Limits are penalties: harder ones at the end bring what is left of a violation below the checker's tolerance.
    const double limit = problem.options.weights.limit;
    problem.options.weights.limit *= kHardening;
    status = search.polish(chosen, kFinalIterations, kFinalCalm, std::numeric_limits<double>::infinity());
    problem.options.weights.limit = limit;
  }
  last = chosen;
  // Out of time there is a plan already, and none for another one.
  if (status != Status::time_limit || !best.best()) finish(std::move(chosen));
  return status;
}

Incumbent SwitchedDdp::Impl::Run::first_guess(const ContactSequence& sequence) const {
  Incumbent guess;
  guess.trajectory = problem.initial_guess(sequence);
  guess.sequence = sequence;
  return guess;
}

/// What there is when time is up before the first iteration: end-effectors where they are due and the weight on those
/// that stand, by the sequence or in turns.
Incumbent SwitchedDdp::Impl::Run::at_once(const ContactSequence& sequence) {
  Incumbent best_guess = first_guess(sequence);
  if (!problem.options.initial_sequence.empty()) return best_guess;
  double lowest = search.evaluate(best_guess).merit();
  for (int mover : {0, 1}) {
    const ContactSequence stepping = stepping_sequence(problem, mover);
    if (stepping.empty()) continue;
    Incumbent guess = first_guess(stepping);
    const double merit = search.evaluate(guess).merit();
    if (!(merit < lowest)) continue;
    lowest = merit;
    best_guess = std::move(guess);
  }
  return best_guess;
}

/// The contact sequence that the search begins with; where finding it takes too long, end-effectors in turns.
ContactSequence SwitchedDdp::Impl::Run::initial(Status& status) {
  const Options& options = problem.options;
  if (!options.initial_sequence.empty()) return problem.to_active(options.initial_sequence);
  const Trajectory guess = problem.initial_guess({});
  Schedule schedule;
  schedule.contact_weight = options.weights.contact_min;
  search.model().expand(guess, schedule);
  bool stopped = false;
  int looks = 0;
  const double until_s = deadline.elapsed_s() + kInitialShare * std::max(deadline.remaining_s(), 0.0);
  ContactSequence found = initial_sequence(search.model(), kBeam, [&] {
    if (++looks % kPollsPerRequest == 0 && options.stop && options.stop()) status = Status::interrupted;
    return stopped = status == Status::interrupted || deadline.elapsed_s() >= until_s;
  });
  for (int mover : {0, 1})
    if (stopped && found.empty()) found = stepping_sequence(problem, mover);
  if (!found.empty()) return found;
  if (status != Status::interrupted) status = stopped ? Status::time_limit : Status::no_sequence;
  return {};
}

std::vector<SwitchedDdp::Impl::Run::Guess> SwitchedDdp::Impl::Run::guesses(const Incumbent& start,
                                                                           const Incumbent* warm) const {
  const Options& options = problem.options;
  if (warm) return {{*warm}};
  if (!options.initial_sequence.empty()) return {{first_guess(start.sequence)}};
  // Shorter and longer steps lead to other sequences; the better one goes on.
  std::vector<Guess> out{{start, options.proximal_weight}, {start, kSecondDiscovery * options.proximal_weight}};
  for (int mover : {0, 1}) {
    const ContactSequence stepping = stepping_sequence(problem, mover);
    if (!stepping.empty()) out.push_back({first_guess(stepping)});
  }
  return out;
}

/// Other settings of what the outcome depends on most, in an order drawn from the seed, until a plan is accepted.
Status SwitchedDdp::Impl::Run::restart(Status status, const ContactSequence& initial) {
  const Problem& p = problem;
  const Options& options = p.options;
  std::vector<RestartSetting> settings(std::begin(kRestarts), std::end(kRestarts));
  std::mt19937_64 random(options.seed);
  for (std::size_t i = settings.size(); i > 1; --i) std::swap(settings[i - 1], settings[random() % i]);
  for (int i = 0; i < options.restarts && !best.ok(); ++i) {
    if (status != Status::solved && status != Status::numerical_failure) break;
    const auto [proximal, duration_s] = settings[static_cast<std::size_t>(i) % settings.size()];
    problem.duration_initial =
        std::clamp(duration_s * p.similarity.time / p.units.time, p.duration_min, p.duration_max);
    Incumbent again = first_guess({});
    again.sequence = initial;
    std::vector<Guess> others{{again, proximal}};
    // A foot too close to the next step catches it with its toe: the same motion with footholds further inside.
    if (best.best() && best.best()->worst.name == "clearance" && !last.sequence.empty()) {
      const double on_surface = options.sole_inside < 0.0 ? p.robot.sole_support : options.sole_inside;
      double further_m = (on_surface >= 1.0 ? kToeRoom_m : kClearanceMin_m) * p.similarity.length;
      for (const EndEffector& end : p.robot.end_effectors)
        if (on_surface < 1.0) further_m = std::max(further_m, kClearanceShare * end.half_size.maxCoeff());
      problem.toe_room += further_m / p.units.length;
      others.insert(others.begin(), Guess{last});
    }
    status = attempt(std::move(others));
  }
  return status;
}

Status SwitchedDdp::Impl::Run::run(const Incumbent* warm) {
  Status status = Status::solved;
  const ContactSequence sequence = initial(status);
  if (sequence.empty()) return status;
  Incumbent start = first_guess({});
  start.sequence = sequence;
  if (deadline.limited()) best.keep(search, problem, surfaces, warm ? *warm : at_once(sequence));
  const Options& options = problem.options;
  if (options.method == Method::paper) {
    status = search.run_paper(start, std::min(kPaperIterations, options.max_iterations));
    if (status != Status::numerical_failure && (status != Status::time_limit || !best.best())) finish(start);
    return status;
  }
  return restart(attempt(guesses(start, warm)), sequence);
}

/// Surfaces that the search looks at: those near the way, and those that are named.
std::vector<int> SwitchedDdp::Impl::surfaces_of(const Request& request, const Outlook& outlook) const {
  const bool all = outlook.reach <= 0.0 || options.method == Method::paper;
  std::set<int> needed;
  for (int i = 0; all && i < static_cast<int>(scene.surfaces.size()); ++i) needed.insert(i);
  if (all) return {needed.begin(), needed.end()};
  for (const Stance* stance : {&scene.start, &scene.goal})
    for (const auto& [who, surface] : stance->contacts) needed.insert(scene.surface_index(surface));
  for (const auto& row : options.initial_sequence) needed.insert(row.begin(), row.end());
  if (request.earlier)
    for (const auto& row : request.earlier->contact_sequence())
      for (int surface : row)
        if (surface >= 0) needed.insert(scene.surface_index(request.earlier->scene.surfaces[surface].name));
  const ResolvedStance from = resolve_stance(scene, robot, scene.start, "start");
  const ResolvedStance to = resolve_stance(scene, robot, scene.goal, "goal");
  return surfaces_near_way(scene, request.measured ? request.measured->end_effectors_W : from.end_effectors_W,
                           to.end_effectors_W, outlook.reach * reach_of(robot), needed);
}

/// The problem on these surfaces.
Problem SwitchedDdp::Impl::pose(const Request& request, const std::vector<int>& surfaces) const {
  Options with = options;
  if (request.earlier) with.phases = static_cast<int>(request.earlier->phases.size()) - request.first;
  if (request.measured) with.initial_sequence.clear();
  for (auto& row : with.initial_sequence)
    for (int& surface : row) {
      const auto here = std::lower_bound(surfaces.begin(), surfaces.end(), surface);
      if (here != surfaces.end() && *here == surface) surface = static_cast<int>(here - surfaces.begin());
    }
  Problem problem(part_of(scene, surfaces), robot, with);
  if (!request.measured) return problem;
  const Plan& previous = *request.earlier;
  ContactState contacts;
  for (int e : problem.active) {
    const int surface = previous.phases[request.first].contacts[e].surface;
    contacts.push_back(surface == kFree ? kFree : problem.scene.surface_index(previous.scene.surfaces[surface].name));
  }
  problem.set_start(*request.measured, contacts);
  problem.first_duration = request.remaining_s / problem.units.time;
  return problem;
}

PlanResult SwitchedDdp::Impl::solve(const Request& request) {
  const Deadline deadline(options.time_limit_s, options.clock);
  BestPlan best(scene, deadline, request.measured != nullptr);
  Report report;
  report.seed = options.seed;
  report.threads = options.threads;
  report.version = MCPLAN_VERSION;
  Status status = Status::no_sequence;
  int steps = 0;
  std::size_t rows = 0;  // of the history, named by the scene's surfaces
  for (int level = 0; level < kOutlooks; ++level) {
    const Outlook look = outlook(options.method == Method::paper ? kOutlooks - 1 : level);
    const std::vector<int> surfaces = surfaces_of(request, look);
    Problem problem = pose(request, surfaces);
    problem.look_near(look.nearest);
    steps = problem.steps;
    const bool all = surfaces.size() == scene.surfaces.size() && problem.rules.looks_everywhere();
    std::optional<Incumbent> warm;
    if (request.earlier) {
      warm = from_plan(problem, *request.earlier, request.first);
      if (warm->sequence.empty() || !problem.rules.valid(warm->sequence)) warm.reset();
    }
    if (warm && request.measured) {
      warm->trajectory.x.front() = problem.start;
      warm->trajectory.u.front()[problem.layout.duration()] = problem.first_duration;
    }
    Run run(std::move(problem), surfaces, deadline, best, report);
    status = run.run(warm ? &*warm : nullptr);
    for (; rows < report.history.size(); ++rows)
      for (ContactState& state : report.history[rows].sequence)
        for (int& surface : state)
          if (surface != kFree) surface = surfaces[surface];
    if (best.ok() || !ended_by_itself(status) || all) {
      best.settle(run.problem, report);
      break;
    }
  }
  return conclude(status, steps, best, std::move(report), deadline.elapsed_s());
}

PlanResult SwitchedDdp::Impl::conclude(Status status, int steps, const BestPlan& kept, Report&& report,
                                       double time_s) const {
  PlanResult out;
  const auto& best = kept.best();
  if (best) {
    out.plan = best->plan;
    report.friction_use = friction_use(out.plan);
    report.worst_violation = best->worst;
    report.cost = best->evaluation.cost;
    for (int i = 0; i < kTermCount; ++i)
      if (best->evaluation.terms[i] > 0.0)
        report.cost_terms[to_string(static_cast<Term>(i))] = best->evaluation.terms[i];
    if (best->ok)
      status = Status::solved;
    else if (status == Status::solved)
      status = violation_ratio(best->worst) <= kAcceptable ? Status::acceptable : Status::infeasible;
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
  report.time_s = time_s;
  std::ostringstream message;
  if (status == Status::solved)
    message << "the checker accepts the plan";
  else if (status == Status::no_sequence)
    message << "no contact sequence joins start and goal in " << steps << " phases; raise `phases`, or look at the "
            << "surfaces' end_effectors and the scene's rules";
  else if (!best)
    message << (status == Status::numerical_failure ? "every attempt broke down numerically"
                                                    : "stopped before there was a plan");
  else if (best->sampled && best->worst.value <= best->worst.tolerance)
    message << "stopped before the checker had seen the best plan in full; it accepts what it saw of it";
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

PlanResult SwitchedDdp::solve() { return impl_->solve({}); }

PlanResult SwitchedDdp::solve(const Plan& warm_start) {
  warm_start.validate();
  Impl::Request request;
  request.earlier = &warm_start;
  return impl_->solve(request);
}

PlanResult SwitchedDdp::replan(const Plan& previous, double t, const Knot& measured) {
  previous.validate();
  require_fit(previous, measured, impl_->robot);
  const PlanState now = previous.at(t);
  const std::vector<double> times = previous.knot_times();
  int first = now.phase;
  double remaining = times[first + 1] - t;
  // What is left of the phase is too short to be planned: the next one starts now.
  const double shortest = kReplanRest_s * similarity_of(impl_->robot, impl_->scene.gravity).time;
  const int phases = static_cast<int>(previous.phases.size());
  if (remaining < shortest && first + 1 < phases) {
    ++first;
    remaining = previous.phases[first].duration;
  }
  Impl::Request request;
  request.earlier = &previous;
  request.first = first;
  request.measured = &measured;
  request.remaining_s = remaining;
  return impl_->solve(request);
}

}  // namespace mcplan::ddp
