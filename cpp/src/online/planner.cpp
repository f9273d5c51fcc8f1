#include "mcplan/online/planner.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "mcplan/base/error.hpp"
#include "mcplan/online/following.hpp"

namespace mcplan::online {
namespace {

using SteadyClock = std::chrono::steady_clock;

double seconds_since(SteadyClock::time_point began) {
  return std::chrono::duration<double>(SteadyClock::now() - began).count();
}

/// All that one computation reads, so that nothing of it changes meanwhile. Plans and scenes are shared: copying them
/// under the lock would keep a controller waiting.
struct Question {
  std::uint64_t ticket = 0;
  MeasuredState state;
  std::shared_ptr<const Plan> plan;
  double begins_s = 0.0;
  bool accepted = false;
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const std::vector<Robot>> robots;
  PlannerOptions options;
};

/// The plan, from beside the measured CoM by a shift.
PlanResult first_usable(const Question& question, const Eigen::Vector3d& shift_W) {
  const double t_now = question.state.time_s - question.begins_s, t = std::clamp(t_now, 0.0, question.plan->duration());
  if (t_now < -question.options.period_s)
    throw InvalidInput("state.time_s",
                       "must be no earlier than the plan under way, " + std::to_string(question.begins_s),
                       std::to_string(question.state.time_s));
  const Scene& scene = question.scene ? *question.scene : question.plan->scene;
  ddp::Measured measured = question.state.measured;
  measured.state.com_W += shift_W;
  measured.state =
      with_planned_height(std::move(measured.state), *question.plan, t_now, question.options.height_margin_m);
  measured.state =
      with_planned_turn(std::move(measured.state), *question.plan, t_now, question.options.turn_margin_rad_s);
  std::optional<PlanResult> found;
  ddp::ReplanOptions options = question.options.replan;
  options.previous_accepted = question.accepted;
  for (const Robot& robot : *question.robots) {
    PlanResult result = ddp::replan(*question.plan, t, measured, scene, robot, options);
    options.crossing = true;  // those after the first are for emergencies
    const bool usable = follows(result.report, question.options.period_s);
    // One that keeps all limits for a while only, that stops, or that does not quite catch the robot is second to one
    // that leads on to the end within wider limits.
    const bool second = result.report.plan_from == PlanFrom::stop ||
                        (result.report.plan_from == PlanFrom::recovery && result.report.status != Status::solved);
    const bool settled = usable && result.report.status != Status::infeasible && !second;
    const bool first = !found || (usable && !follows(found->report, question.options.period_s));
    if (settled || first) found = std::move(result);
    if (settled) break;
  }
  if (!found->plan.phases.empty()) found->plan = with_feet_kept_up(std::move(found->plan));
  return *std::move(found);
}

Update answer(const Question& question) {
  const auto began = SteadyClock::now();
  Update out;
  out.ticket = question.ticket;
  out.begins_s = out.kept_until_s = question.state.time_s;
  try {
    const Robot& robot = question.plan->robot;
    const Scene& scene = question.scene ? *question.scene : question.plan->scene;
    out.com_shift_W = com_shift_W(question.state.push, robot.com_height, scene.gravity);
    out.result = first_usable(question, out.com_shift_W);
    out.usable = follows(out.result->report, question.options.period_s);
    out.kept_until_s += out.result->report.kept_until_s;
  } catch (const std::exception& error) {  // a state that is refused must not end the thread: the plan goes on
    out.error = error.what();
  }
  out.took_s = seconds_since(began);
  return out;
}

}  // namespace

void PlannerOptions::validate() const {
  replan.validate();
  if (!(period_s > 0.0 && std::isfinite(period_s)))
    throw InvalidOptions("period_s", "must be positive", std::to_string(period_s));
  if (!(height_margin_m >= 0.0))
    throw InvalidOptions("height_margin_m", "must be 0 at least", std::to_string(height_margin_m));
  if (!(turn_margin_rad_s >= 0.0))
    throw InvalidOptions("turn_margin_rad_s", "must be 0 at least", std::to_string(turn_margin_rad_s));
}

struct Planner::Work {
  Work(Plan plan, double began_s, PlannerOptions given)
      : under_way(std::make_shared<const Plan>(std::move(plan))),
        begins_s(began_s),
        own_robot(std::make_shared<const std::vector<Robot>>(1, under_way->robot)),
        robots(own_robot),
        options(std::move(given)),
        accepted(options.replan.previous_accepted) {
    const StopRequest asked = options.replan.search.stop;
    options.replan.search.stop = [this, asked] { return closed.load() || (asked && asked()); };
  }

  void run() {
    std::unique_lock<std::mutex> lock(mutex);
    while (true) {
      changed.wait(lock, [&] { return closed || waiting; });
      if (closed) return;
      Question question{ticket, *std::exchange(waiting, std::nullopt), under_way, begins_s, accepted, scene, robots,
                        options};
      computing = true;
      lock.unlock();
      Update update = answer(question);
      lock.lock();
      done = std::move(update);
      computing = false;
      changed.notify_all();
    }
  }

  mutable std::mutex mutex;
  std::condition_variable changed;
  std::optional<MeasuredState> waiting;
  std::optional<Update> done;
  std::uint64_t ticket = 0;
  bool computing = false;
  std::atomic<bool> closed = false;
  std::shared_ptr<const Plan> under_way;
  double begins_s;
  std::shared_ptr<const Scene> scene;
  const std::shared_ptr<const std::vector<Robot>> own_robot;  // of the first plan
  std::shared_ptr<const std::vector<Robot>> robots;
  PlannerOptions options;
  bool accepted;  // by the checker: of the first plan what the options say, then what its status does
  std::thread thread;
};

Planner::Planner(Plan plan, double begins_s, PlannerOptions options) {
  options.validate();
  plan.validate();
  if (!std::isfinite(begins_s)) throw InvalidInput("begins_s", "must be finite", std::to_string(begins_s));
  work_ = std::make_unique<Work>(std::move(plan), begins_s, std::move(options));
  work_->thread = std::thread([work = work_.get()] { work->run(); });
}

Planner::~Planner() {
  {
    const std::lock_guard<std::mutex> lock(work_->mutex);
    work_->closed = true;
  }
  work_->changed.notify_all();
  work_->thread.join();
}

std::uint64_t Planner::submit(MeasuredState state) {
  std::uint64_t ticket = 0;
  {
    const std::lock_guard<std::mutex> lock(work_->mutex);
    work_->waiting = std::move(state);
    ticket = ++work_->ticket;
  }
  work_->changed.notify_all();
  return ticket;
}

std::optional<Update> Planner::poll() {
  const std::lock_guard<std::mutex> lock(work_->mutex);
  return std::exchange(work_->done, std::nullopt);
}

std::optional<Update> Planner::wait(double timeout_s) {
  std::unique_lock<std::mutex> lock(work_->mutex);
  const auto ended = [&] { return !work_->computing && !work_->waiting; };
  if (timeout_s < 1e6)
    work_->changed.wait_for(lock, std::chrono::duration<double>(std::max(timeout_s, 0.0)), ended);
  else  // the clock's own unit cannot count an endless time
    work_->changed.wait(lock, ended);
  return std::exchange(work_->done, std::nullopt);
}

void Planner::take_over(const Update& update) {
  if (!update.result) throw InvalidInput("update", "must have a plan", update.error);
  update.result->plan.validate();  // the caller may have changed it
  auto plan = std::make_shared<const Plan>(update.result->plan);
  const std::lock_guard<std::mutex> lock(work_->mutex);
  work_->under_way.swap(plan);
  work_->begins_s = update.begins_s;
  work_->accepted = update.result->report.status == Status::solved;
}

void Planner::set_command(std::optional<ddp::VelocityCommand> command) {
  const std::lock_guard<std::mutex> lock(work_->mutex);
  work_->options.replan.command = command;
}

void Planner::set_scene(std::optional<Scene> scene) {
  auto given = scene ? std::make_shared<const Scene>(*std::move(scene)) : nullptr;
  const std::lock_guard<std::mutex> lock(work_->mutex);
  work_->scene.swap(given);
}

void Planner::set_robots(std::vector<Robot> robots) {
  auto given = robots.empty() ? work_->own_robot : std::make_shared<const std::vector<Robot>>(std::move(robots));
  const std::lock_guard<std::mutex> lock(work_->mutex);
  work_->robots.swap(given);
}

Plan Planner::plan() const {
  std::shared_ptr<const Plan> plan;
  {
    const std::lock_guard<std::mutex> lock(work_->mutex);
    plan = work_->under_way;
  }
  return *plan;
}

double Planner::begins_s() const {
  const std::lock_guard<std::mutex> lock(work_->mutex);
  return work_->begins_s;
}

bool Planner::busy() const {
  const std::lock_guard<std::mutex> lock(work_->mutex);
  return work_->computing || work_->waiting;
}

}  // namespace mcplan::online
