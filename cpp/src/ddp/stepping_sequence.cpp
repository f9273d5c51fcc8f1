#include "ddp/stepping_sequence.hpp"

#include <algorithm>
#include <limits>

#include "crawl.hpp"
#include "plan/clearance.hpp"
#include "surface_boxes.hpp"

namespace mcplan::ddp {

using Eigen::Vector3d;

namespace {

void sort_as_crawl(const Problem& problem, std::vector<int>& movers) {
  Vector3d ahead = (problem.reference.x.back() - problem.reference.x.front()).segment<3>(problem.layout.com());
  const Eigen::Matrix3d heading = rotation_from_rpy({0.0, 0.0, problem.base_rpy.z()});
  ahead.z() = 0.0;
  if (ahead.norm() < 1e-6) ahead = heading.col(0);
  const auto turn = [&](int l) {
    const Vector3d at = heading * problem.limits[l].nominal;
    return crawl_turn(ahead.head<2>(), at.head<2>());
  };
  std::stable_sort(movers.begin(), movers.end(), [&](int a, int b) { return turn(a) < turn(b); });
}

/// Whether a place on a surface is in the solid of another one.
bool is_buried(const Problem& problem, const SurfaceBoxes& boxes, int surface, const Vector3d& place) {
  constexpr double kDeep = 0.02;  // in CoM heights: what is thinner than that lies on it
  for (int i = 0; i < static_cast<int>(problem.polygons.size()); ++i) {
    const double thickness = problem.thickness[i];
    if (i == surface || boxes.min_squared_distance(i, place) > thickness * thickness) continue;
    const double depth = -problem.polygons[i].height(place);
    if (depth > kDeep && depth < thickness + kDeep && problem.polygons[i].outside(place) < 0.0) return true;
  }
  return false;
}

}  // namespace

bool balances_on_points(const Problem& problem) {
  const auto balancing = [](const EndLimits& limits) { return limits.balances; };
  return std::count_if(problem.limits.begin(), problem.limits.end(), balancing) >= 4;
}

ContactSequence stepping_sequence(const Problem& problem, int first_mover) {
  const int n = problem.steps;
  std::vector<int> movers;
  for (int l = 0; l < problem.layout.end_effector_count(); ++l)
    if (problem.start_contacts[l] != kFree && problem.goal_contacts[l] != kFree) movers.push_back(l);
  if (movers.empty()) return {};
  if (balances_on_points(problem)) sort_as_crawl(problem, movers);

  // Swings at steps 1, 3, 5, ...; each mover's stance lasts until its next turn.
  const int count = static_cast<int>(movers.size());
  const SurfaceBoxes boxes(problem.polygons);
  ContactSequence sequence(n + 1, problem.start_contacts);
  ContactState now = problem.start_contacts;
  int turn = first_mover;
  for (int k = 1; k < n; k += 2, ++turn) {
    const int l = movers[turn % count];
    sequence[k] = now;
    sequence[k][l] = kFree;
    const int next_swing = k + 2 * count;
    if (next_swing >= n) {
      now[l] = problem.goal_contacts[l];
    } else {
      // In the middle of its stance the end-effector should be where the reference is.
      const int middle = std::min((k + 1 + next_swing) / 2, n);
      const Vector3d desired = problem.reference.x[middle].segment<3>(problem.layout.end(l));
      double nearest = std::numeric_limits<double>::infinity();
      for (int surface : problem.rules.surfaces(l)) {
        if (boxes.min_squared_distance(surface, desired) > nearest * nearest) continue;
        const Vector3d place = problem.polygons[surface].nearest(desired);
        const double distance = (place - desired).norm();
        if (distance >= nearest || is_buried(problem, boxes, surface, place)) continue;
        nearest = distance;
        now[l] = surface;
      }
    }
    if (k + 1 <= n) sequence[k + 1] = now;
  }
  for (int k = 0; k <= n; ++k)
    if (k == n) sequence[k] = problem.goal_contacts;
  return problem.rules.valid(sequence) ? sequence : ContactSequence{};
}

}  // namespace mcplan::ddp
