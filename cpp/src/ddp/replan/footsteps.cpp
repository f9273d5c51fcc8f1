#include "ddp/replan/footsteps.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <queue>
#include <tuple>

#include "ddp/constants.hpp"
#include "mcplan/scene/polygon.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Strides are at most so long and steps so high, feet turn by so much a step [rad], places nearer to each other are
/// the same, all in heights of the CoM; a stride as long as may be costs so much more than a step; so many nodes are
/// looked at. Chosen.
constexpr double kWayStride = 0.4, kWayRise = 0.2, kWayTurn_rad = 0.25, kWayCell = 0.08, kWayEffort = 0.5,
                 kWayInside = 0.02;
constexpr int kWayNodes = 4000;
/// What is left counts for so much more than its least cost: ways may cost so much more than the cheapest, and are
/// found after some hundred nodes. Chosen.
constexpr double kWayGreed = 1.2;

/// Where a foot may be from the other one while both stand, in the heading between theirs.
struct Region {
  double ahead_m = 0.0;                ///< at most, either way
  double side = 1.0;                   ///< 1: to the left of the other, -1: to the right
  double low_m = 0.0, high_m = 0.0;    ///< to its side
  double usual_m = 0.0, rise_m = 0.0;  ///< how far to the side it usually is, and the highest step
};

Region region_of(const EndEffector& end, const EndEffector& other, double height_m, double ratio) {
  Region out;
  const Eigen::AlignedBox3d own = end.usual_box(), its = other.usual_box();
  const Vector3d low = own.min() - its.max(), high = own.max() - its.min();
  const double aside = end.nominal_B.y() - other.nominal_B.y();
  out.side = aside < 0.0 ? -1.0 : 1.0;
  out.usual_m = std::abs(aside);
  out.ahead_m = ratio * std::min({high.x(), -low.x(), kWayStride * height_m});
  const double near_m = out.side > 0.0 ? low.y() : -high.y(), far_m = out.side > 0.0 ? high.y() : -low.y();
  const double soles_m = end.half_size[1] + other.half_size[1];
  out.low_m = std::max({out.usual_m + kCommandStride * (near_m - out.usual_m), soles_m, 0.0});
  out.high_m = out.usual_m + kCommandStride * (std::min(far_m, out.usual_m + kWayStride * height_m) - out.usual_m);
  out.rise_m = kWayRise * height_m;
  return out;
}

/// Where the feet are, and whose turn it is.
struct Node {
  std::array<Foothold, 2> feet;
  int turn = 0;
  double cost = 0.0;
  int before = -1;  ///< the node that it comes from
};

using Key = std::tuple<int, int, int, int, int, int, int>;

class FootstepSearch {
 public:
  FootstepSearch(const Walk& walk, const Scene& scene, const Robot& robot, double ratio)
      : walk_(&walk), scene_(&scene), robot_(&robot), cell_m_(kWayCell * robot.com_height) {
    for (int i = 0; i < 2; ++i)
      regions_[i] =
          region_of(robot.end_effectors[walk.feet[i]], robot.end_effectors[walk.feet[1 - i]], robot.com_height, ratio);
    for (const Surface& surface : scene.surfaces) polygons_.emplace_back(surface.vertices_W);
    if (!walk.route.empty()) route_.emplace(walk.route, walk.to[0].yaw, cell_m_);
  }

  std::vector<Footstep> run() {
    add({walk_->from, walk_->first, 0.0, -1});
    int looked_at = 0;
    while (!open_.empty() && looked_at++ < kWayNodes) {
      const int at = open_.top().second;
      open_.pop();
      if (nodes_[at].cost > best_[key_of(nodes_[at])]) continue;
      if (arrived(nodes_[at])) return steps_to(at);
      expand(at);
    }
    return {};
  }

 private:
  bool at_goal(const Foothold& foot, int i) const {
    return foot.surface == walk_->to[i].surface && (foot.place_W - walk_->to[i].place_W).norm() < 1e-6 &&
           std::abs(foot.yaw - walk_->to[i].yaw) < 1e-6;
  }
  bool arrived(const Node& node) const { return at_goal(node.feet[0], 0) && at_goal(node.feet[1], 1); }

  /// What it costs at least where feet head as they are to: a step of the longest stride costs least for its length.
  double at_least(const Node& node) const {
    double rounds = 0.0;
    for (int i = 0; i < 2; ++i) {
      const Vector2d off = turned((walk_->to[i].place_W - node.feet[i].place_W).head<2>(), -walk_->to[i].yaw);
      rounds = std::max(rounds, rounds_for(off, i));
    }
    if (route_) {
      const Vector3d here_W = middle(node);
      const AlongRoute::Point& on = route_->nearest(here_W);
      const Vector2d off = turned((on.at_W - here_W).head<2>(), -on.yaw);
      rounds = std::max(rounds, rounds_for(off.cwiseAbs() + on.left, 0));
    }
    return (1.0 + kWayEffort) * std::max(2.0 * rounds - 1.0, 0.0);
  }

  /// Of one step by each foot.
  double rounds_for(const Vector2d& off, int i) const {
    return std::max(std::abs(off.x()) / (2.0 * regions_[i].ahead_m),
                    std::abs(off.y()) / (regions_[i].high_m - regions_[i].low_m));
  }

  static Vector3d middle(const Node& node) { return 0.5 * (node.feet[0].place_W + node.feet[1].place_W); }

  Key key_of(const Node& node) const {
    const auto cell = [&](double x) { return static_cast<int>(std::lround(x / cell_m_)); };
    const Foothold &a = node.feet[0], &b = node.feet[1];
    const int ends = 2 * at_goal(a, 0) + at_goal(b, 1);
    return {2 * a.surface + node.turn,
            cell(a.place_W.x()),
            cell(a.place_W.y()),
            b.surface,
            cell(b.place_W.x()),
            cell(b.place_W.y()),
            ends};
  }

  void add(Node node) {
    const auto [known, fresh] = best_.try_emplace(key_of(node), node.cost);
    if (!fresh && known->second <= node.cost) return;
    known->second = node.cost;
    open_.push({node.cost + kWayGreed * at_least(node), static_cast<int>(nodes_.size())});
    nodes_.push_back(std::move(node));
  }

  void expand(int at) {
    const Node node = nodes_[at];
    const int i = node.turn;
    for (const Foothold& onto : footholds(node, at == 0)) {
      double price = price_of(onto, node.feet[1 - i], i);
      if (at == 0 && !walk_->offered.empty())
        price += walk_->elsewhere * (onto.place_W - walk_->offered.front().place_W).norm() / robot_->com_height;
      if (!std::isfinite(price)) continue;
      Node next = node;
      next.feet[i] = onto;
      if (route_ && !is_free(middle(next))) continue;
      next.turn = 1 - i;
      next.cost += price;
      next.before = at;
      add(std::move(next));
    }
  }

  /// The nearest place of a polygon, a little inside where there is room: solvers begin there.
  Vector3d inside(const Polygon& polygon, const Vector3d& due_W) const {
    const Vector3d place_W = polygon.nearest(due_W), inward_W = polygon.centroid_W() - place_W;
    const double room_m = kWayInside * robot_->com_height, far_m = inward_W.norm();
    if (polygon.outside(place_W) < -room_m || far_m < room_m) return place_W;
    return place_W + room_m / far_m * inward_W;
  }

  /// Where the foot whose turn it is may land, by the foot that stands.
  std::vector<Foothold> footholds(const Node& node, bool first) const {
    const int i = node.turn;
    const Region& region = regions_[i];
    const Foothold& standing = node.feet[1 - i];
    std::vector<Foothold> out{walk_->to[i]};
    if (first) out.insert(out.end(), walk_->offered.begin(), walk_->offered.end());
    const EndEffector& end = robot_->end_effectors[walk_->feet[i]];
    const double there = route_ ? route_->nearest(middle(node)).yaw : walk_->to[i].yaw;
    const double yaw = standing.yaw + std::clamp(there - standing.yaw, -kWayTurn_rad, kWayTurn_rad);
    for (std::size_t s = 0; s < polygons_.size(); ++s) {
      if (!may_touch(scene_->surfaces[s], end)) continue;
      const Vector3d nearest_W = polygons_[s].nearest(standing.place_W);
      if ((nearest_W - standing.place_W).head<2>().norm() > std::hypot(region.ahead_m, region.high_m)) continue;
      for (const double ahead : {1.0, 0.5, 0.0, -0.5})
        for (const double aside_m : {region.usual_m, region.high_m}) {
          const Vector2d stride = turned({ahead * region.ahead_m, region.side * aside_m}, 0.5 * (standing.yaw + yaw));
          Vector3d due_W = standing.place_W;
          due_W.head<2>() += stride;
          due_W.z() = nearest_W.z();
          const Foothold found{static_cast<int>(s), inside(polygons_[s], due_W), yaw};
          const auto same = [&](const Foothold& f) {
            return f.surface == found.surface && (f.place_W - found.place_W).norm() < 0.5 * cell_m_;
          };
          if (std::none_of(out.begin(), out.end(), same)) out.push_back(found);
        }
    }
    return out;
  }

  /// Whether there is room for the trunk; told once for each place.
  bool is_free(const Vector3d& middle_W) {
    const auto cell = [&](double x) { return static_cast<int>(std::lround(x / (0.5 * cell_m_))); };
    const std::array<int, 3> place{cell(middle_W.x()), cell(middle_W.y()), cell(middle_W.z())};
    const auto [known, fresh] = free_.try_emplace(place, true);
    if (fresh) known->second = walk_->round->is_free(middle_W);
    return known->second;
  }

  /// Of a step beside a foot that stands; infinite where it is out of reach. One step costs 1, a stride as long, as
  /// wide or as high as may be so much more.
  double price_of(const Foothold& onto, const Foothold& standing, int i) const {
    const Region& region = regions_[i];
    const double turn = onto.yaw - standing.yaw;
    const Vector2d off = turned((onto.place_W - standing.place_W).head<2>(), -0.5 * (onto.yaw + standing.yaw));
    const double aside_m = region.side * off.y(), rise_m = onto.place_W.z() - standing.place_W.z();
    constexpr double kRounding_m = 1e-6;
    if (std::abs(off.x()) > region.ahead_m + kRounding_m || aside_m < region.low_m - kRounding_m ||
        aside_m > region.high_m + kRounding_m || std::abs(rise_m) > region.rise_m ||
        std::abs(turn) > kWayTurn_rad + kRounding_m)
      return std::numeric_limits<double>::infinity();
    const double wide = (aside_m - region.usual_m) / (region.high_m - region.usual_m);
    const double ahead = off.x() / region.ahead_m, high = rise_m / region.rise_m;
    return 1.0 + kWayEffort * (ahead * ahead + wide * wide + high * high);
  }

  std::vector<Footstep> steps_to(int at) const {
    std::vector<Footstep> out;
    for (; nodes_[at].before >= 0; at = nodes_[at].before) {
      const int moved = nodes_[nodes_[at].before].turn;
      out.push_back({walk_->feet[moved], nodes_[at].feet[moved]});
    }
    std::reverse(out.begin(), out.end());
    return out;
  }

  const Walk* walk_;
  const Scene* scene_;
  const Robot* robot_;
  double cell_m_;
  std::array<Region, 2> regions_;
  std::vector<Polygon> polygons_;
  std::vector<Node> nodes_;
  std::map<Key, double> best_;
  std::optional<AlongRoute> route_;
  std::map<std::array<int, 3>, bool> free_;
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
};

}  // namespace

std::vector<Footstep> footsteps(const Walk& walk, const Scene& scene, const Robot& robot, double ratio) {
  return FootstepSearch(walk, scene, robot, ratio).run();
}

}  // namespace mcplan::ddp
