#include "ddp/replan/hands.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "ddp/replan/under_feet.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// A hand that catches a push holds on for so many phases; it is tried where the CoM is pushed to its side by at least
/// so much [m/s] and what it would touch is no further than this out of the box of its reach [m]. Chosen.
constexpr int kHandPhases = 3;
constexpr double kHandPush_m_s = 0.2, kHandSpare_m = 0.1;

/// A hand, and where it can hold on.
struct Hold {
  int hand = 0;
  Found place;
  double towards = 0.0;  ///< [m/s] by which the CoM is pushed to that side
};

/// Whether the rest never uses an end-effector.
bool never_used(const Rest& rest, int e) {
  for (int k = 0; k <= rest.size(); ++k)
    if (rest.surface(k, e) != kFree) return false;
  return true;
}

/// Places that hands reach by the time at which they get there, if the CoM moves on as it does.
std::vector<Hold> holds(const Rest& rest, const Scene& scene, const Robot& robot, const Vector3d& pushed_W,
                        double ahead_s, const Similarity& similarity) {
  const Knot& now = rest.plan.knots.front();
  const Vector3d com_W = now.com_W + ahead_s * now.com_velocity_W;
  const Eigen::AngleAxisd heading(now.base_rpy.z(), Vector3d::UnitZ());
  std::vector<Hold> out;
  for (int e = 0; e < static_cast<int>(robot.end_effectors.size()); ++e) {
    const EndEffector& end = robot.end_effectors[e];
    if (is_foot(robot, e) || !never_used(rest, e)) continue;
    const Vector3d middle_B = 0.5 * (end.reach_min_B + end.reach_max_B);
    const Vector3d side_W = heading * Vector3d(0.0, middle_B.y() < 0.0 ? -1.0 : 1.0, 0.0);
    const double towards = side_W.dot(pushed_W);
    if (towards < kHandPush_m_s * similarity.velocity()) continue;
    const std::vector<Found> found = grounds_near(scene, end, com_W + heading * middle_B);
    if (found.empty()) continue;
    const Vector3d place_B = heading.inverse() * (found.front().place_W - com_W);
    const Vector3d beyond = (place_B - end.reach_max_B).cwiseMax(end.reach_min_B - place_B);
    if (beyond.maxCoeff() <= kHandSpare_m * similarity.length) out.push_back({e, found.front(), towards});
  }
  std::stable_sort(out.begin(), out.end(), [](const Hold& a, const Hold& b) { return a.towards > b.towards; });
  return out;
}

/// Put a phase in before phase k like the one before it, but for one end-effector, which carries nothing yet.
void insert_like_before(Rest& rest, int k, int hand, const Found& place, double duration_s) {
  ContactState contacts = rest.contacts(k - 1);
  contacts[hand] = place.surface;
  rest.insert(k, contacts, duration_s);
  rest.plan.phases[k].contacts = rest.plan.phases[k - 1].contacts;
  Contact& contact = rest.plan.phases[k].contacts[hand] = Contact();
  contact.surface = place.surface;
  contact.anchor_W = contact.center_of_pressure_W = place.place_W;
}

/// The hand touches during phase `at`, some time after its begin, and lets go again.
Rest held(Rest rest, const Hold& hold, int at, double after_s, double shortest_s) {
  const double left_s = rest.plan.phases[at].duration - after_s;
  rest.plan.phases[at].duration = after_s;
  insert_like_before(rest, at + 1, hold.hand, hold.place, std::max(left_s, shortest_s));
  const int release = std::min(at + 1 + kHandPhases, rest.size());
  for (int k = at + 2; k < release; ++k) {
    Contact& contact = rest.plan.phases[k].contacts[hold.hand] = Contact();
    contact.surface = hold.place.surface;
    contact.anchor_W = contact.center_of_pressure_W = hold.place.place_W;
  }
  for (int k = at + 1; k <= release; ++k) rest.plan.knots[k].end_effectors_W[hold.hand] = hold.place.place_W;
  insert_like_before(rest, release, hold.hand, Found(), shortest_s);
  return rest;
}

}  // namespace

std::vector<Rest> with_hands(const Rest& rest, const Scene& scene, const Robot& robot, const Vector3d& pushed_W,
                             double committed_s, const Similarity& similarity) {
  const Eigen::Vector2d box_s = phase_duration_of(robot, similarity);
  const double reaching_s = swing_duration_of(box_s);
  std::vector<Rest> out;
  for (const Hold& hold : holds(rest, scene, robot, pushed_W, reaching_s, similarity)) {
    double begin_s = 0.0;
    for (int at = 0; at < std::min(rest.size(), 2); ++at) {
      const double end_s = begin_s + rest.plan.phases[at].duration;
      // What ends a phase within the committed time would come later.
      if (end_s > committed_s) out.push_back(held(rest, hold, at, std::max(reaching_s - begin_s, box_s[0]), box_s[0]));
      begin_s = end_s;
    }
  }
  return out;
}

}  // namespace mcplan::ddp
