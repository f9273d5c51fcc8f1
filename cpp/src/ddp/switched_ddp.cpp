#include "mcplan/ddp/switched_ddp.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "ddp/attempts.hpp"
#include "ddp/best_plan.hpp"
#include "ddp/constants.hpp"
#include "ddp/cost_terms.hpp"
#include "ddp/impossible.hpp"
#include "ddp/plan_conversion.hpp"
#include "ddp/reachable_surfaces.hpp"
#include "ddp/replan_fit.hpp"
#include "ddp/routes.hpp"
#include "mcplan/base/error.hpp"
#include "mcplan/plan/friction_use.hpp"
#include "mcplan/version.hpp"
#include "model/text.hpp"

namespace mcplan::ddp {

using Eigen::Vector3d;

namespace {

/// Whether a search that ended so may have missed what it did not look at.
bool ended_by_itself(Ending ending) {
  return ending == Ending::done || ending == Ending::broke_down || ending == Ending::no_sequence;
}

/// What the user is told of a search that ended so, with this plan or none.
Status status_of(Ending ending, const std::optional<BestPlan::Finished>& best) {
  if (best && best->ok) return Status::solved;
  switch (ending) {
    case Ending::done:
      if (!best) return Status::numerical_failure;
      return violation_ratio(best->worst) <= kAcceptable ? Status::acceptable : Status::infeasible;
    case Ending::no_sequence:
      return Status::no_sequence;
    case Ending::iteration_limit:
      return Status::iteration_limit;
    case Ending::time_limit:
      return Status::time_limit;
    case Ending::interrupted:
      return Status::interrupted;
    case Ending::broke_down:
      break;
  }
  return Status::numerical_failure;
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

  void require_warm_starts() const {
    if (options.method == Method::paper)
      throw InvalidOptions("method", "must be standard to start from a plan: the published algorithm does not",
                           "paper");
  }
  /// A search of its own: along a route or straight on, with flights or without.
  struct Way {
    Route route;
    bool flights = true;
    int min_contacts = 0;
  };
  /// What it has found.
  struct Found {
    BestPlan best;
    Ending ending = Ending::no_sequence;
    int steps = 0;
    Way way = {};
  };

  std::vector<int> surfaces_of(const Request& request, const Route& route, const Outlook& outlook) const;
  Problem pose(const Request& request, const Way& way, int phases, const std::vector<int>& surfaces) const;
  PlanResult solve(const Request& request);
  void search_in(int phases, const Request& request, const Way& way, const Deadline& deadline, Report& report,
                 Found& found) const;
  Found search(const Request& request, const Way& way, const Deadline& deadline, Report& report) const;
  void try_more_phases(const Request& request, const Deadline& deadline, Report& report, Found& found) const;
  bool four_feet_stand() const;
  void tell(const Way& way, const Found& found) const;
  Found search_all(const Request& request, const Deadline& deadline, Report& report) const;
  PlanResult conclude(Ending ending, int steps, const BestPlan& best, Report&& report, double time_s) const;
  std::string message_of(Status status, int steps, const BestPlan& kept, const Report& report) const;
  PlanResult without_plan(Report&& report) const;
};

/// Surfaces that the search looks at: those near the way, and those that are named.
std::vector<int> SwitchedDdp::Impl::surfaces_of(const Request& request, const Route& route,
                                                const Outlook& outlook) const {
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
  const double near = outlook.reach * reach_of(robot);
  for (std::size_t i = 1; i < route.size(); ++i) {
    std::vector<Vector3d> here = from.end_effectors_W, there = here;
    for (Vector3d& end : here) end += route[i - 1] - route.front();
    for (Vector3d& end : there) end += route[i] - route.front();
    const std::vector<int> beside = surfaces_near_way(scene, here, there, near, needed);
    needed.insert(beside.begin(), beside.end());
  }
  return surfaces_near_way(scene, request.measured ? request.measured->end_effectors_W : from.end_effectors_W,
                           to.end_effectors_W, near, needed);
}

/// The problem on these surfaces, in so many phases; 0: as many as the way asks for.
Problem SwitchedDdp::Impl::pose(const Request& request, const Way& way, int phases,
                                const std::vector<int>& surfaces) const {
  Options with = options;
  with.phases = phases;
  with.allow_flight = way.flights;
  with.min_contacts = way.min_contacts;
  if (request.earlier) with.phases = static_cast<int>(request.earlier->phases.size()) - request.first;
  if (request.measured) with.initial_sequence.clear();
  for (auto& row : with.initial_sequence)
    for (int& surface : row) {
      const auto here = std::lower_bound(surfaces.begin(), surfaces.end(), surface);
      if (here != surfaces.end() && *here == surface) surface = static_cast<int>(here - surfaces.begin());
    }
  Problem problem(part_of(scene, surfaces), robot, with, way.route);
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

/// With ever more of the scene, until there is a plan that the checker accepts.
void SwitchedDdp::Impl::search_in(int phases, const Request& request, const Way& way, const Deadline& deadline,
                                  Report& report, Found& found) const {
  std::size_t rows = report.history.size();  // named by the scene's surfaces
  for (int level = 0; level < kOutlooks; ++level) {
    const Outlook look = outlook(options.method == Method::paper ? kOutlooks - 1 : level);
    const std::vector<int> surfaces = surfaces_of(request, way.route, look);
    Problem problem = pose(request, way, phases, surfaces);
    problem.look_near(look.nearest);
    found.steps = problem.steps;
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
    Attempts attempts(std::move(problem), surfaces, deadline, found.best, report);
    found.ending = attempts.run(warm ? &*warm : nullptr);
    for (; rows < report.history.size(); ++rows)
      for (ContactState& state : report.history[rows].sequence)
        for (int& surface : state)
          if (surface != kFree) surface = surfaces[surface];
    if (found.best.solved() || !ended_by_itself(found.ending) || all) {
      found.best.settle(attempts.problem(), report);
      break;
    }
  }
}

/// In as many phases as the way asks for.
SwitchedDdp::Impl::Found SwitchedDdp::Impl::search(const Request& request, const Way& way, const Deadline& deadline,
                                                   Report& report) const {
  Found found{BestPlan(scene, deadline, request.measured != nullptr)};
  found.way = way;
  search_in(options.phases, request, way, deadline, report, found);
  return found;
}

/// Where a plan is nearly found, the same way in more phases: ground may ask for shorter steps than the robot can make.
void SwitchedDdp::Impl::try_more_phases(const Request& request, const Deadline& deadline, Report& report,
                                        Found& found) const {
  if (options.phases > 0 || request.earlier || !options.initial_sequence.empty() || options.method == Method::paper)
    return;
  for (const double factor : kMorePhases) {
    const auto& best = found.best.best();
    if (found.best.ok() || !best || !ended_by_itself(found.ending) || violation_ratio(best->worst) > kAcceptable)
      return;
    const int phases = 2 * static_cast<int>(0.5 * factor * found.steps);
    if (phases > kPhasesMax) return;
    search_in(phases, request, found.way, deadline, report, found);
    tell(found.way, found);
  }
}

/// At the start and at the goal.
bool SwitchedDdp::Impl::four_feet_stand() const {
  const ResolvedStance from = resolve_stance(scene, robot, scene.start, "start");
  const ResolvedStance to = resolve_stance(scene, robot, scene.goal, "goal");
  int feet = 0;
  for (std::size_t e = 0; e < robot.end_effectors.size(); ++e)
    feet += from.contacts[e] >= 0 && to.contacts[e] >= 0 && robot.end_effectors[e].kind == "foot";
  return feet >= 4;
}

void SwitchedDdp::Impl::tell(const Way& way, const Found& found) const {
  if (!options.logger) return;
  std::ostringstream line;
  line << (way.flights ? "" : "without flights, ") << (way.route.empty() ? "straight on" : "by way of");
  for (std::size_t i = 1; i + 1 < way.route.size(); ++i)
    line << " (" << model::digits(way.route[i].x(), "%.2f") << ", " << model::digits(way.route[i].y(), "%.2f") << ", "
         << model::digits(way.route[i].z(), "%.2f") << ")";
  line << ", in " << found.steps << " phases: ";
  if (!found.best.best())
    line << "no plan";
  else if (found.best.ok())
    line << "cost " << model::digits(found.best.best()->evaluation.cost, "%.4g");
  else
    line << "violates " << found.best.best()->worst.name;
  options.logger(LogLevel::info, line.str());
}

/// Straight on; where steps do not lead along there, round what is in the way as well, and where they do, again without
/// flights if there were any. The best of what is found.
SwitchedDdp::Impl::Found SwitchedDdp::Impl::search_all(const Request& request, const Deadline& deadline,
                                                       Report& report) const {
  const bool given = request.earlier || !options.initial_sequence.empty() || options.method == Method::paper;
  const Routes routes = given || !options.detours ? Routes() : find_routes(scene, robot, options.sole_inside);
  std::optional<Found> best;
  const int by_feet = !given && four_feet_stand() ? 2 : 0,
            least = options.min_contacts < 0 ? by_feet : options.min_contacts;
  bool stopped = false;  // by the caller or a limit: whatever was found before, nothing more is tried
  const auto try_way = [&](const Way& way) {
    stopped = stopped || (best && (deadline.passed() || (options.stop && options.stop())));
    if (stopped) return;
    Found found = search(request, way, deadline, report);
    tell(way, found);
    stopped = !ended_by_itself(found.ending);
    if (!best || better(found.best.best(), best->best.best())) best.emplace(std::move(found));
  };
  for (const Route& route : routes.detours) try_way({route, false, least});
  const bool trunk_passes = !routes.obstructed || !best || !best->best.ok();
  if (trunk_passes) try_way({{}, options.allow_flight, least});
  const auto flies = [](const Plan& plan) {
    return std::any_of(plan.phases.begin(), plan.phases.end(), [](const Phase& phase) {
      return std::all_of(phase.contacts.begin(), phase.contacts.end(), [](const Contact& c) { return c.surface < 0; });
    });
  };
  if (!given && options.allow_flight && best->best.ok() && flies(best->best.best()->plan) &&
      flight_needed(scene, robot).empty())
    try_way({{}, false, least});
  // Two feet are what a walk should have; a leap may have fewer.
  const auto hopeless = [&] { return !best->best.best() || violation_ratio(best->best.best()->worst) > kAcceptable; };
  if (options.min_contacts < 0 && least > 0 && hopeless()) try_way({{}, options.allow_flight, 0});
  return std::move(*best);
}

PlanResult SwitchedDdp::Impl::solve(const Request& request) {
  const Deadline deadline(options.time_limit_s, options.clock);
  Report report;
  report.seed = options.seed;
  report.threads = options.threads;
  report.version = MCPLAN_VERSION;
  if (std::optional<Impossible> impossible =
          why_impossible(scene, robot, request.measured != nullptr, options.allow_flight)) {
    report.status = Status::infeasible;
    report.message = impossible->message;
    report.worst_violation = impossible->violation;
    report.time_s = deadline.elapsed_s();
    return without_plan(std::move(report));
  }
  Found found = search_all(request, deadline, report);
  try_more_phases(request, deadline, report, found);
  return conclude(found.ending, found.steps, found.best, std::move(report), deadline.elapsed_s());
}

PlanResult SwitchedDdp::Impl::without_plan(Report&& report) const {
  PlanResult out;
  out.plan.scene = scene;
  out.plan.robot = robot;
  out.report = std::move(report);
  return out;
}

PlanResult SwitchedDdp::Impl::conclude(Ending ending, int steps, const BestPlan& kept, Report&& report,
                                       double time_s) const {
  const auto& best = kept.best();
  report.status = status_of(ending, best);
  report.time_s = time_s;
  if (best) {
    // Of a plan that was looked at in few instants, in as few.
    constexpr double kUsual_s = 0.005;
    report.friction_use = friction_use(best->plan, best->sampled ? best->sample_s : std::max(kUsual_s, best->sample_s));
    report.worst_violation = best->worst;
    report.warnings = best->warnings;
    report.cost = best->evaluation.cost;
    const CostTerms& terms = best->evaluation.terms;
    for (std::size_t i = 0; i < cost_terms().size(); ++i)
      if (terms[i] > 0.0) report.cost_terms[cost_terms()[i]->name()] = terms[i];
  } else {
    const bool no_sequence = report.status == Status::no_sequence;
    report.worst_violation.name = no_sequence ? "contact_sequence" : "finite";
    report.worst_violation.value = 1.0;
    report.worst_violation.unit = no_sequence ? "missing" : "numbers";
  }
  report.message = message_of(report.status, steps, kept, report);
  if (!best) return without_plan(std::move(report));
  return {best->plan, std::move(report)};
}

std::string SwitchedDdp::Impl::message_of(Status status, int steps, const BestPlan& kept, const Report& report) const {
  const auto& best = kept.best();
  std::ostringstream message;
  if (!report.paper_verdict.empty())
    message << "the published algorithm: " << report.paper_verdict << ", cost "
            << model::digits(report.paper_cost, "%.3g") << "; ";
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
  if (best && status != Status::solved && !best->plan.measured_start)
    if (const std::string flight = flight_needed(scene, robot); !flight.empty()) message << "; " << flight;
  return message.str();
}

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
  impl_->require_warm_starts();
  warm_start.validate();
  Impl::Request request;
  request.earlier = &warm_start;
  return impl_->solve(request);
}

PlanResult SwitchedDdp::replan(const Plan& previous, double t, const Knot& measured) {
  impl_->require_warm_starts();
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
