#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "ddp/impossible.hpp"
#include "mcplan/base/error.hpp"
#include "mcplan/plan/checker.hpp"
#include "mcplan/robot/similarity.hpp"
#include "mcplan/scene/polygon.hpp"
#include "model/text.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// How far apart [m] two contacts may be for the way to lead from the one to the other: at the same time, ...
struct Limits {
  double step = 0.0;
  double jump = 0.0, rise = 0.0;  ///< ... or before and after a flight, and then one how far above the other
};

/// A surface that may be touched.
struct Patch {
  Polygon polygon;
  Eigen::AlignedBox3d box;
  unsigned ends = 0;  ///< bit l: end-effector l may touch it
  int kind = 0;       ///< the same for all patches with the same `ends`
};

/// Lower bound of the distance between two polygons, their distance but for rounding and slow convergence: the width
/// of the slab between them that is normal to the line of two points found by projecting from one to the other and
/// back. Any direction gives a bound. Stops once they are known to be no farther than `near`.
double apart(const Patch& a, const Patch& b, double near) {
  Vector3d x = a.polygon.nearest(b.polygon.centroid_W()), y = b.polygon.nearest(x);
  for (int i = 0; i < 50 && (y - x).norm() > near; ++i) {
    const Vector3d from = x;
    x = a.polygon.nearest(y);
    y = b.polygon.nearest(x);
    if ((x - from).norm() < 1e-12 * (1.0 + x.norm())) break;
  }
  const double distance = (y - x).norm();
  if (!(distance > near)) return distance;
  const Vector3d along = (y - x) / distance;
  double end = -std::numeric_limits<double>::infinity(), begin = -end;
  for (const Vector3d& v : a.polygon.vertices_W()) end = std::max(end, along.dot(v));
  for (const Vector3d& v : b.polygon.vertices_W()) begin = std::min(begin, along.dot(v));
  return begin - end;
}

/// How much one lies above the other, whichever; not positive where their heights overlap.
double above(const Patch& a, const Patch& b) {
  return std::max(b.box.min().z() - a.box.max().z(), a.box.min().z() - b.box.max().z());
}

/// A rule forbids that nothing is in contact: "if none of `when_free` is, all of `require` are" asks for one more.
bool forbids_flight(const Scene& scene, const Robot& robot) {
  const auto& ends = robot.end_effectors;
  const auto known = [&](const std::string& who) {
    return std::any_of(ends.begin(), ends.end(), [&](const EndEffector& e) { return addresses(who, e); });
  };
  return std::any_of(scene.rules.begin(), scene.rules.end(), [&](const ContactRule& rule) {
    return !rule.require.empty() && std::any_of(rule.when_free.begin(), rule.when_free.end(), known);
  });
}

/// Which surfaces can follow upon which others; `reached` grows from those of the start.
class Ways {
 public:
  Ways(const Scene& scene, const Robot& robot, bool flights) : robot_(&robot), flights_(flights) {
    const Tolerances tolerances;
    const Similarity size = similarity_of(robot, scene.gravity);
    reach_ = tolerances.reach * size.length;
    foothold_ = 2.0 * std::sqrt(2.0) * tolerances.contact_distance * size.length;
    same_ = tolerances.slip * size.length;
    const double speed = robot.max_com_speed + tolerances.boundary * size.velocity();
    // States may differ at each knot by the tolerance of `dynamics`, a hundred-thousandth of this.
    flight_ = speed * speed / scene.gravity + 1e-3 * size.length;
    for (const Surface& surface : scene.surfaces) {
      patches_.push_back({Polygon(surface.vertices_W), {}, 0, 0});
      for (const Vector3d& v : surface.vertices_W) patches_.back().box.extend(v);
      for (std::size_t l = 0; l < robot.end_effectors.size(); ++l)
        if (may_touch(surface, robot.end_effectors[l])) patches_.back().ends |= 1U << l;
      const unsigned ends = patches_.back().ends;
      patches_.back().kind = static_cast<int>(std::find(kinds_.begin(), kinds_.end(), ends) - kinds_.begin());
      if (patches_.back().kind == static_cast<int>(kinds_.size())) kinds_.push_back(ends);
    }
    for (unsigned from : kinds_)
      for (unsigned to : kinds_) limits_.push_back(limits_between(from, to));
  }

  /// Every surface follows upon every other one.
  bool unlimited() const { return flights_ && !std::isfinite(flight_); }
  bool flights() const { return flights_; }
  const Patch& patch(int i) const { return patches_[i]; }
  int count() const { return static_cast<int>(patches_.size()); }

  /// Proof: gap_too_wide().
  const Limits& limits(int i, int j) const { return limits_[patches_[i].kind * kinds_.size() + patches_[j].kind]; }

  bool follows(int i, int j) const {
    const Patch &a = patches_[i], &b = patches_[j];
    const Limits& limit = limits(i, j);
    const bool low = above(a, b) <= limit.rise;
    const double far = low ? std::max(limit.step, limit.jump) : limit.step;
    if (!(a.box.squaredExteriorDistance(b.box) <= far * far)) return false;
    return a.box.merged(b.box).sizes().squaredNorm() <= far * far || apart(a, b, far) <= far;
  }

 private:
  Limits limits_between(unsigned from, unsigned to) const {
    Limits limit;
    const auto& ends = robot_->end_effectors;
    for (std::size_t l = 0; l < ends.size(); ++l)
      for (std::size_t m = 0; m < ends.size(); ++m)
        if ((from >> l & 1U) && (to >> m & 1U)) add(ends[l], ends[m], l == m, limit);
    return limit;
  }

  void add(const EndEffector& l, const EndEffector& m, bool same, Limits& limit) const {
    const double unlimited = std::numeric_limits<double>::infinity(), slack = 2.0 * std::sqrt(3.0) * reach_ + foothold_;
    const bool boxes = !l.com_reach.given() && !m.com_reach.given();
    const Vector3d apart_B =
        (l.reach_max_B - m.reach_min_B).cwiseAbs().cwiseMax((m.reach_max_B - l.reach_min_B).cwiseAbs());
    limit.step = std::max(limit.step, same ? same_ + foothold_ : boxes ? apart_B.norm() + slack : unlimited);
    if (!flights_) return;
    const double offsets = boxes ? farthest_reach(l) + farthest_reach(m) + slack : unlimited;
    limit.jump = std::max(limit.jump, offsets + flight_);
    limit.rise = std::max(limit.rise, offsets + 0.5 * flight_);
  }

  const Robot* robot_;
  bool flights_;
  double reach_, foothold_, same_, flight_;
  std::vector<Patch> patches_;
  std::vector<unsigned> kinds_;  ///< `ends` by kind
  std::vector<Limits> limits_;   ///< by the kinds of both
};

/// By surface, whether a way leads to it; those nearest to the goal are looked at first, and no more once all of the
/// goal's are reached.
std::vector<bool> reached_from(const Ways& ways, const std::vector<int>& start, const std::vector<int>& goal) {
  std::vector<bool> reached(ways.count(), false);
  std::vector<std::pair<double, int>> ahead;  // a heap: minus the distance to the goal
  const auto reach = [&](int i) {
    reached[i] = true;
    ahead.emplace_back(-ways.patch(i).box.squaredExteriorDistance(ways.patch(goal.front()).box), i);
    std::push_heap(ahead.begin(), ahead.end());
  };
  for (int i : start)
    if (!reached[i]) reach(i);
  while (!ahead.empty() && !std::all_of(goal.begin(), goal.end(), [&](int g) { return reached[g]; })) {
    std::pop_heap(ahead.begin(), ahead.end());
    const int i = ahead.back().second;
    ahead.pop_back();
    for (int j = 0; j < ways.count(); ++j)
      if (!reached[j] && ways.follows(i, j)) reach(j);
  }
  return reached;
}

/// The narrowest gap between what is reached and what is not.
struct Gap {
  int from = -1, to = -1;
  double width = std::numeric_limits<double>::infinity();
};
Gap narrowest(const Ways& ways, const std::vector<bool>& reached) {
  Gap gap;
  for (int i = 0; i < ways.count(); ++i)
    for (int j = 0; j < ways.count(); ++j) {
      if (!reached[i] || reached[j] || ways.patch(j).ends == 0) continue;
      const Patch &a = ways.patch(i), &b = ways.patch(j);
      if (std::sqrt(a.box.squaredExteriorDistance(b.box)) >= gap.width) continue;
      const double width = apart(a, b, 0.0);
      if (width < gap.width) gap = {i, j, width};
    }
  return gap;
}

std::vector<int> surfaces_of(const ResolvedStance& stance) {
  std::vector<int> surfaces;
  for (int surface : stance.contacts)
    if (surface >= 0) surfaces.push_back(surface);
  return surfaces;
}

}  // namespace

/// A plan goes from contact to contact. Of two contacts, of end-effectors l and m, that follow upon each other,
///
/// - either there is an instant at which both are there: p_l and p_m are then in their boxes about the same CoM, of the
///   same base, and as far apart as two points of the two boxes at most,
///
///       |p_l - p_m| <= max |d_l - d_m|        (a step),
///
/// - or all end-effectors are free in between, and the CoM flies from p_0 to p_1 with p'' = -g. With the speed
///   v <= max_com_speed at both ends, and z_1 >= z_0 (otherwise seen in reverse), the parabola of safety of speed v
///   gives |p_1 - p_0| + (z_1 - z_0) <= v^2 / g. Each contact is no farther from the CoM than the farthest corner of
///   its box, r, so
///
///       |p_l - p_m| <= r_l + r_m + v^2 / g,   |z_l - z_m| <= r_l + r_m + v^2 / (2 g)        (a jump).
///
/// An end-effector that goes from surface to surface at one instant does so at one place. To each come the checker's
/// tolerances: `reach` sqrt(3) times, for each of the two; footholds beside their polygons by sqrt(2) times
/// `contact_distance`; `com_speed`; `path_continuity`. Where a rule forbids that all are free, there are no jumps. What
/// no chain of such pairs joins with the start's surfaces cannot be touched. Of end-effectors whose contacts are held
/// to com_reach instead of the box nothing is said, nor of stances without contacts.
std::optional<Impossible> gap_too_wide(const Scene& scene, const Robot& robot, bool allow_flight) {
  const bool forbidden = forbids_flight(scene, robot);
  const Ways ways(scene, robot, allow_flight && !forbidden);
  if (ways.unlimited()) return std::nullopt;
  const std::vector<int> start = surfaces_of(resolve_stance(scene, robot, scene.start, "start"));
  const std::vector<int> goal = surfaces_of(resolve_stance(scene, robot, scene.goal, "goal"));
  if (start.empty() || goal.empty()) return std::nullopt;
  const std::vector<bool> reached = reached_from(ways, start, goal);
  if (std::all_of(goal.begin(), goal.end(), [&](int g) { return reached[g]; })) return std::nullopt;

  const Gap gap = narrowest(ways, reached);
  const Limits& limit = ways.limits(gap.from, gap.to);
  const auto metres = [](double value) { return model::digits(value, "%.3g") + " m"; };
  const std::string from = text(scene.surfaces[gap.from].name), to = text(scene.surfaces[gap.to].name);
  const double rise = above(ways.patch(gap.from), ways.patch(gap.to));
  const bool high = ways.flights() && rise > limit.rise && gap.width <= limit.jump;
  const double largest = high ? limit.rise : ways.flights() ? std::max(limit.step, limit.jump) : limit.step;
  const std::string why = ways.flights() ? ", with the CoM at " + model::digits(robot.max_com_speed, "%.3g") + " m/s"
                          : forbidden    ? ", for the scene's rules forbid flights"
                                         : ", and flights are not allowed";
  return Impossible{(high ? from + " and " + to + " are " + metres(rise) + " apart in height, more"
                          : "the gap of " + metres(gap.width) + " between " + from + " and " + to + " is wider") +
                        " than any " + (ways.flights() ? "jump" : "step") + " of " + robot.name + ": at most " +
                        metres(largest) + why,
                    {"contact_sequence", -1, "", 0.0, (high ? rise : gap.width) - largest, 0.0, "m"}};
}

/// A way without jumps does not exist: gap_too_wide() without them. Every way out of what steps reach then has a
/// flight, over no less than the narrowest gap around it.
std::string flight_needed(const Scene& scene, const Robot& robot) {
  const Ways ways(scene, robot, false);
  const std::vector<int> start = surfaces_of(resolve_stance(scene, robot, scene.start, "start"));
  const std::vector<int> goal = surfaces_of(resolve_stance(scene, robot, scene.goal, "goal"));
  if (start.empty() || goal.empty()) return "";
  const std::vector<bool> reached = reached_from(ways, start, goal);
  if (std::all_of(goal.begin(), goal.end(), [&](int g) { return reached[g]; })) return "";
  const Gap gap = narrowest(ways, reached);
  return "no steps lead to the goal: it takes a flight over " + model::digits(gap.width, "%.3g") +
         " m at least, as between " + text(scene.surfaces[gap.from].name) + " and " + text(scene.surfaces[gap.to].name);
}

}  // namespace mcplan::ddp
