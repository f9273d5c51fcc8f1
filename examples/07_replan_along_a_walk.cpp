// Replan 100 times along a walk, every time from a state that is off, and draw all plans into one page.

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <mcplan/mcplan.hpp>
#include <random>
#include <vector>

namespace {

constexpr int kReplans = 100, kSeed = 1;
constexpr double kComNoise_m = 0.005, kVelocityNoise_m_s = 0.03;  // standard deviations

/// What a state estimator would say: the planned state with noise, and what each end-effector touches.
mcplan::ddp::Measured measure(const mcplan::Plan& plan, double t, std::mt19937& random) {
  std::normal_distribution<double> noise;
  const mcplan::PlanState now = plan.at(t);
  mcplan::ddp::Measured out;
  out.state.com_W = now.com_W + kComNoise_m * Eigen::Vector3d(noise(random), noise(random), 0.0);
  out.state.com_velocity_W =
      now.com_velocity_W + kVelocityNoise_m_s * Eigen::Vector3d(noise(random), noise(random), 0.0);
  out.state.base_rpy = now.base_rpy;
  out.state.base_rpy_rate = now.base_rpy_rate;
  out.state.angular_momentum_W = now.angular_momentum_W;
  for (const mcplan::EndEffectorState& end : now.end_effectors) {
    out.state.end_effectors_W.push_back(end.position_W);
    out.state.end_effector_velocities_W.push_back(end.velocity_W);
    out.state.end_effector_yaw.push_back(end.yaw);
    out.contacts.push_back(end.surface);
  }
  return out;
}

/// The CoM of every plan from above, from blue (first) to red (last), and where the feet stand.
void write_page(const std::vector<mcplan::Plan>& plans, const char* path) {
  std::ofstream page(path);
  page
      << "<!doctype html><meta charset='utf-8'><title>100 replans of a walk</title><p>CoM (lines) and footholds (dots) "
         "of every plan from above, from the first (blue) to the last (red).</p><svg viewBox='40 130 720 140' "
         "width='100%'>";
  const auto x = [](const Eigen::Vector3d& point_W) { return 60.0 + 300.0 * point_W.x(); };
  const auto y = [](const Eigen::Vector3d& point_W) { return 200.0 - 300.0 * point_W.y(); };
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const mcplan::Plan& plan = plans[i];
    const int hue = 240 - static_cast<int>(240 * i / (plans.size() - 1));
    page << "<polyline fill='none' stroke='hsl(" << hue << ",80%,45%)' stroke-opacity='0.5' points='";
    for (int j = 0; j < 60; ++j) {
      const Eigen::Vector3d com_W = plan.at(plan.duration() * j / 59).com_W;
      page << x(com_W) << ',' << y(com_W) << ' ';
    }
    page << "'/>";
    for (std::size_t k = 0; k < plan.phases.size(); ++k)
      for (std::size_t e = 0; e < plan.phases[k].contacts.size(); ++e) {
        if (plan.phases[k].contacts[e].surface < 0) continue;
        const Eigen::Vector3d& foot_W = plan.knots[k].end_effectors_W[e];
        page << "<circle r='2' fill='hsl(" << hue << ",80%,45%)' fill-opacity='0.4' cx='" << x(foot_W) << "' cy='"
             << y(foot_W) << "'/>";
      }
  }
  page << "</svg>";
}

}  // namespace

int main() {
  const mcplan::Scene scene = mcplan::load_scene("flat");
  const mcplan::Robot robot = mcplan::load_robot("humanoid44");
  mcplan::Plan plan = mcplan::ddp::plan(scene, robot).plan;
  std::vector<mcplan::Plan> plans{plan};
  std::vector<double> times_ms;
  std::mt19937 random(kSeed);
  const double period_s = plan.duration() / kReplans;
  int solved = 0;
  for (int i = 0; i < kReplans; ++i) {
    const double t = std::min(period_s, plan.duration());
    const mcplan::PlanResult result = mcplan::ddp::replan(plan, t, measure(plan, t, random));
    times_ms.push_back(1e3 * result.report.time_s);
    solved += result.report.status == mcplan::Status::solved;
    if (result.report.kept_until_s > period_s) plan = result.plan;  // otherwise the plan under way goes on
    plans.push_back(plan);
  }
  write_page(plans, "replans.html");
  std::sort(times_ms.begin(), times_ms.end());
  std::printf("seed %d: %d of %d solved, %.1f ms in the median, %.1f at most\n", kSeed, solved, kReplans,
              times_ms[times_ms.size() / 2], times_ms.back());
  std::printf("all plans are drawn in replans.html\n");
  return solved >= 0.97 * kReplans ? 0 : 1;
}
