#include "ddp/replan/stops.hpp"

#include <algorithm>
#include <cstddef>

#include "ddp/constants.hpp"
#include "ddp/replan/under_feet.hpp"

namespace mcplan::ddp {
namespace {

/// A foot that has yet to land: the phase in which it was to, or size() where it never was, and where ground is for it.
struct Landing {
  int foot = 0;
  int due = 0;
  std::vector<Found> grounds;
};

/// Ground near to where a foot was about to land, then near to where it is now; each surface once.
std::vector<Found> grounds_for(const Scene& scene, const EndEffector& end, const Eigen::Vector3d& due_W,
                               const Eigen::Vector3d& now_W, double reach_m) {
  std::vector<Found> out;
  const auto add = [&](const Eigen::Vector3d& place_W, std::size_t count) {
    std::size_t added = 0;
    for (const Found& found : grounds_near(scene, end, place_W)) {
      const bool known =
          std::any_of(out.begin(), out.end(), [&](const Found& f) { return f.surface == found.surface; });
      if (found.distance > reach_m || added == count) return;
      if (known) continue;
      out.push_back(found);
      ++added;
    }
  };
  add(due_W, kStopGrounds);
  add(now_W, 1);
  return out;
}

std::vector<Landing> landings_of(const Rest& rest, const Scene& scene, const Robot& robot) {
  std::vector<Landing> out;
  for (int e = 0; e < static_cast<int>(robot.end_effectors.size()); ++e) {
    if (!is_foot(robot, e) || rest.surface(0, e) != kFree) continue;
    Landing landing{e, 0, {}};
    while (landing.due < rest.size() && rest.surface(landing.due, e) == kFree) ++landing.due;
    const Eigen::Vector3d now_W = rest.plan.knots.front().end_effectors_W[e];
    const Eigen::Vector3d due_W = rest.plan.knots[landing.due].end_effectors_W[e];
    landing.grounds = grounds_for(scene, robot.end_effectors[e], due_W, now_W, kStopReach * robot.com_height);
    out.push_back(std::move(landing));
  }
  std::stable_sort(out.begin(), out.end(), [](const Landing& a, const Landing& b) { return a.due < b.due; });
  return out;
}

/// The phase under way alone, at the end of which nothing changes.
Rest under_way(const Rest& rest) {
  Rest out = rest;
  out.keep_first();
  Knot& end = out.plan.knots.back();
  end.com_velocity_W.setZero();
  end.base_rpy_rate.setZero();
  end.angular_momentum_W.setZero();
  for (Eigen::Vector3d& velocity_W : end.end_effector_velocities_W) velocity_W.setZero();
  out.plan.final_contacts = rest.contacts(0);
  return out;
}

}  // namespace

bool stands_on_what_is_gone(const Rest& rest, const Scene& scene, const Robot& robot) {
  for (int e = 0; e < static_cast<int>(robot.end_effectors.size()); ++e)
    for (int k = 1; k <= rest.size(); ++k)
      if (const int surface = rest.surface(k, e);
          surface != kFree && !may_touch(scene.surfaces[surface], robot.end_effectors[e]))
        return true;
  return false;
}

bool stand_on_others(Rest& rest, const Scene& scene, const Robot& robot) {
  bool changed = false;
  for (int e = 0; e < static_cast<int>(robot.end_effectors.size()); ++e) {
    for (int k = 1; k <= rest.size(); ++k) {
      const int planned = rest.surface(k, e);
      if (planned == kFree || rest.surface(k - 1, e) == planned) continue;
      if (may_touch(scene.surfaces[planned], robot.end_effectors[e])) continue;
      const Found found = ground_at(scene, robot.end_effectors[e], rest.plan.knots[k].end_effectors_W[e]);
      if (found.surface == kFree) return false;
      int end = k;
      for (; end < rest.size() && rest.surface(end, e) == planned; ++end) {
        rest.plan.phases[end].contacts[e].surface = found.surface;
        rest.plan.knots[end].end_effectors_W[e] = found.place_W;
        rest.planned[end] = 0;
      }
      rest.plan.knots[end].end_effectors_W[e] = found.place_W;
      if (end == rest.size() && rest.plan.final_contacts[e] == planned) rest.plan.final_contacts[e] = found.surface;
      changed = true;
    }
  }
  return changed;
}

std::vector<Rest> stops(const Rest& rest, const Scene& scene, const Robot& robot, const Similarity& similarity) {
  bool stands = false;
  for (int e = 0; e < static_cast<int>(robot.end_effectors.size()); ++e)
    stands = stands || (is_foot(robot, e) && rest.surface(0, e) != kFree);
  if (!stands) return {};
  const std::vector<Landing> landings = landings_of(rest, scene, robot);
  std::size_t choices = 1;
  for (const Landing& landing : landings) {
    if (landing.grounds.empty()) return {};
    choices = std::max(choices, landing.grounds.size());
  }
  const std::vector<double> times = rest.plan.knot_times();
  std::vector<Rest> out;
  for (std::size_t choice = 0; choice < choices; ++choice) {
    Rest stop = under_way(rest);
    for (std::size_t i = 0; i < landings.size(); ++i) {
      const Landing& landing = landings[i];
      const Found& ground = landing.grounds[std::min(choice, landing.grounds.size() - 1)];
      if (i == 0) stop.plan.phases.front().duration = times[landing.due];
      stop.plan.final_contacts[landing.foot] = ground.surface;
      stop.plan.knots.back().end_effectors_W[landing.foot] = ground.place_W;
      // One contact changes at a time.
      if (i + 1 < landings.size()) stop.insert(stop.size(), stop.plan.final_contacts, kStopApart_s * similarity.time);
    }
    for (int i = 0; i < kStopPhases; ++i)
      stop.insert(stop.size(), stop.plan.final_contacts, kStanding_s * similarity.time);
    out.push_back(std::move(stop));
  }
  return out;
}

}  // namespace mcplan::ddp
