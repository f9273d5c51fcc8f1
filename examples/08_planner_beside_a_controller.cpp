// A control loop of 500 Hz with a planner in a thread of its own: states in ten times a second, plans out.

#include <chrono>
#include <cstdio>
#include <mcplan/mcplan.hpp>
#include <thread>

namespace {

constexpr double kControl_s = 0.002, kReplan_s = 0.1;
constexpr double kPush_s = 1.0, kPush_m_s = 0.05;  // to the left, at that time

/// What a state estimator would say; here the robot does what is planned, but for a push.
mcplan::online::MeasuredState estimate(const mcplan::Plan& plan, double began_s, double now_s, double push_m_s) {
  const mcplan::PlanState planned = plan.at(now_s - began_s);
  mcplan::online::MeasuredState out;
  out.time_s = now_s;
  mcplan::Knot& robot = out.measured.state;
  robot.com_W = planned.com_W;
  robot.com_velocity_W = planned.com_velocity_W + Eigen::Vector3d(0.0, push_m_s, 0.0);
  robot.base_rpy = planned.base_rpy;
  robot.base_rpy_rate = planned.base_rpy_rate;
  robot.angular_momentum_W = planned.angular_momentum_W;
  for (const mcplan::EndEffectorState& end : planned.end_effectors) {
    robot.end_effectors_W.push_back(end.position_W);
    robot.end_effector_velocities_W.push_back(end.velocity_W);
    robot.end_effector_yaw.push_back(end.yaw);
    out.measured.contacts.push_back(end.surface);
  }
  return out;
}

}  // namespace

int main() {
  mcplan::Plan plan = mcplan::ddp::plan(mcplan::load_scene("flat"), mcplan::load_robot("humanoid44")).plan;
  double began_s = 0.0;
  mcplan::online::PlannerOptions options;
  options.replan.search.time_limit_s = 0.08;
  mcplan::online::Planner planner(plan, began_s, options);

  const auto start = std::chrono::steady_clock::now();
  double replan_s = 0.0;
  int used = 0, unusable = 0;
  bool pushed = false;
  for (int tick = 0; tick < 1500; ++tick) {
    const double now_s = tick * kControl_s;
    if (const auto update = planner.poll()) {
      if (update->usable) {
        planner.take_over(*update);  // the next plans are made from this one
        plan = update->result->plan;
        began_s = update->begins_s;
      }
      ++(update->usable ? used : unusable);
    }
    if (now_s >= replan_s) {
      const bool now = !pushed && now_s >= kPush_s;
      planner.submit(estimate(plan, began_s, now_s, now ? kPush_m_s : 0.0));
      pushed |= now;
      replan_s += kReplan_s;
    }
    (void)plan.at(now_s - began_s);  // the references of this instant, for the controller
    std::this_thread::sleep_until(start + std::chrono::duration<double>((tick + 1) * kControl_s));
  }
  std::printf("3 s of control: %d plans followed, %d not; the plan under way began at %.1f s\n", used, unusable,
              began_s);
  return used > 0 ? 0 : 1;
}
