#include "mcplan/ddp/switched_ddp.hpp"

#include <algorithm>
#include <optional>
#include <sstream>
#include <utility>

#include "ddp/barrier.hpp"
#include "ddp/best_plan.hpp"
#include "ddp/constants.hpp"
#include "ddp/cost_terms.hpp"
#include "ddp/headings.hpp"
#include "ddp/impossible.hpp"
#include "ddp/joined_ground.hpp"
#include "ddp/plan_conversion.hpp"
#include "ddp/reachable_surfaces.hpp"
#include "ddp/ways.hpp"
#include "mcplan/base/error.hpp"
#include "mcplan/ddp/replan.hpp"
#include "mcplan/plan/checker.hpp"
#include "mcplan/plan/friction_use.hpp"
#include "mcplan/version.hpp"
#include "model/text.hpp"

namespace mcplan::ddp {

using Eigen::Vector3d;

namespace {

/// What the user is told of a search that ended so, with this plan or none.
Status status_of(Ending ending, const std::optional<BestPlan::Finished>& best) {
  if (best && best->ok) return Status::solved;
  switch (ending) {
    case Ending::broke_down:  // the last attempt; others may have come to their end
      if (best && best->sampled) return Status::numerical_failure;
      [[fallthrough]];
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
  }
  return Status::numerical_failure;
}

}  // namespace

struct SwitchedDdp::Impl {
  Scene scene;
  Robot robot;
  Options options;

  void require_warm_starts() const {
    if (options.method == Method::paper)
      throw InvalidOptions("method", "must be standard to start from a plan: the published algorithm does not",
                           "paper");
  }
  /// Whether the first state of a plan is the start's; with Model::lipm the CoM may begin a little elsewhere.
  bool begins_at_stance() const { return options.method == Method::standard && options.model == Model::wrench; }
  PlanResult solve(const Plan* earlier) const;
  PlanResult solve_joined(const JoinedGround& ground, const Plan* earlier, const Deadline& deadline) const;
  PlanResult solve_within(const Plan* earlier, const Deadline& deadline) const;
  PlanResult conclude(const Found& found, Report&& report, double time_s) const;
  std::string message_of(Status status, const Found& found, const Report& report) const;
  PlanResult without_plan(Report&& report) const;
};

/// On surfaces that are whole. What comes of that is checked on the pieces, too: there it has to be solved.
PlanResult SwitchedDdp::Impl::solve(const Plan* earlier) const {
  const Deadline deadline(options.time_limit_s, options.clock);
  const JoinedGround ground(scene);
  if (options.method == Method::paper || !ground.any() || (earlier && !ground.fits(*earlier)))
    return solve_within(earlier, deadline);
  PlanResult out = solve_joined(ground, earlier, deadline);
  if (out.report.status != Status::solved || check(out.plan, scene, robot).ok()) return out;
  return solve_within(earlier, deadline);
}

PlanResult SwitchedDdp::Impl::solve_joined(const JoinedGround& ground, const Plan* earlier,
                                           const Deadline& deadline) const {
  Impl whole{ground.scene(), robot, options};
  for (std::vector<int>& contacts : whole.options.initial_sequence) ground.join(contacts);
  if (options.watch) whole.options.watch = [&](const Plan& plan) { options.watch(ground.take_apart(plan)); };
  std::optional<Plan> begin;
  if (earlier) begin = ground.join(*earlier);
  PlanResult out = whole.solve_within(begin ? &*begin : nullptr, deadline);
  out.plan = ground.take_apart(std::move(out.plan));
  for (Iteration& row : out.report.history)
    for (std::vector<int>& contacts : row.sequence) ground.take_apart(contacts);
  return out;
}

PlanResult SwitchedDdp::Impl::solve_within(const Plan* earlier, const Deadline& deadline) const {
  Report report;
  report.seed = options.seed;
  report.threads = options.threads;
  report.version = MCPLAN_VERSION;
  std::optional<Impossible> impossible = why_impossible(scene, robot, false, options.allow_flight);
  if (!impossible && begins_at_stance()) impossible = start_beyond_reach(scene, robot, kAcceptable);
  if (!impossible && begins_at_stance()) impossible = leg_in_solid(scene, robot, false, kAcceptable);
  if (impossible) {
    report.status = Status::infeasible;
    report.message = impossible->message;
    report.worst_violation = impossible->violation;
    report.time_s = deadline.elapsed_s();
    return without_plan(std::move(report));
  }
  const Found found = WaysToGoal(scene, robot, options, earlier, deadline).search(report);
  return conclude(found, std::move(report), deadline.elapsed_s());
}

PlanResult SwitchedDdp::Impl::without_plan(Report&& report) const {
  PlanResult out;
  out.plan.scene = scene;
  out.plan.robot = robot;
  out.report = std::move(report);
  return out;
}

PlanResult SwitchedDdp::Impl::conclude(const Found& found, Report&& report, double time_s) const {
  const auto& best = found.best.best();
  report.status = status_of(found.ending, best);
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
  report.message = message_of(report.status, found, report);
  if (!best) return without_plan(std::move(report));
  return {best->plan, std::move(report)};
}

std::string SwitchedDdp::Impl::message_of(Status status, const Found& found, const Report& report) const {
  const auto& best = found.best.best();
  std::ostringstream message;
  if (!report.paper_verdict.empty())
    message << "the published algorithm: " << report.paper_verdict << ", cost "
            << model::digits(report.paper_cost, "%.3g") << "; ";
  if (status == Status::solved)
    message << "the checker accepts the plan";
  else if (status == Status::no_sequence)
    message << "no contact sequence joins start and goal in " << found.steps
            << " phases; raise `phases`, or look at the "
            << "surfaces' end_effectors and the scene's rules";
  else if (!best)
    message << (status == Status::numerical_failure ? "every attempt broke down numerically"
                                                    : "stopped before there was a plan");
  else if (best->sampled && best->worst.value <= best->worst.tolerance)
    message << "stopped before the checker had seen the best plan in full; it accepts what it saw of it";
  else
    message << "the best plan violates " << report.worst_violation.to_string();
  if (best && status != Status::solved) {
    std::string why = flight_needed(scene, robot);
    // Whoever stopped the search knows why there is no plan.
    const bool stopped = status == Status::time_limit || status == Status::interrupted;
    if (why.empty() && found.barrier && !stopped) why = text_of(*found.barrier, scene, robot.name);
    // A leg that is in a solid at an end of the way is why there is none for it, whatever else there is on it.
    if (const std::optional<Impossible> goal = leg_in_solid(scene, robot, true, 1.0)) why = goal->message;
    if (begins_at_stance())
      for (const auto& start : {leg_in_solid(scene, robot, false, 1.0), start_beyond_reach(scene, robot, 1.0)})
        if (start) why = start->message;
    if (!why.empty()) message << "; " << why;
  }
  return message.str();
}

SwitchedDdp::SwitchedDdp(const Scene& scene, const Robot& robot, const Options& options)
    : impl_(std::make_unique<Impl>(Impl{scene, robot_for(robot, options), options})) {
  // Working the problem out validates everything.
  const Problem problem(scene, robot, options);
  // A heading is the same after whole turns; scenes hold none beyond one.
  const double yaw = turning_least(scene.start.yaw, scene.goal.yaw);
  if (std::abs(yaw) <= 2.0 * M_PI) impl_->scene.goal.yaw = yaw;
  if (!options.initial_sequence.empty()) problem.to_active(options.initial_sequence);
}
SwitchedDdp::~SwitchedDdp() = default;
SwitchedDdp::SwitchedDdp(SwitchedDdp&&) noexcept = default;
SwitchedDdp& SwitchedDdp::operator=(SwitchedDdp&&) noexcept = default;

PlanResult SwitchedDdp::solve() { return impl_->solve(nullptr); }

PlanResult SwitchedDdp::solve(const Plan& warm_start) {
  impl_->require_warm_starts();
  warm_start.validate();
  return impl_->solve(&warm_start);
}

PlanResult SwitchedDdp::replan(const Plan& previous, double t, const Knot& measured) {
  impl_->require_warm_starts();
  ReplanOptions with;
  with.search = impl_->options;
  return ddp::replan(previous, t, {measured, {}}, impl_->scene, impl_->robot, with);
}

}  // namespace mcplan::ddp
