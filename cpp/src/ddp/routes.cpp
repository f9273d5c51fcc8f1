#include "ddp/routes.hpp"

// Nothing of the library is linked, only its headers are used.
#define LEMON_ONLY_TEMPLATES
#include <lemon/dijkstra.h>
#include <lemon/smart_graph.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ddp/constants.hpp"
#include "ddp/ground.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Point at a share of the length, corners as they are.
Vector3d along(const Route& route, double share) {
  double left = 0.0;
  for (std::size_t i = 1; i < route.size(); ++i) left += share * (route[i] - route[i - 1]).norm();
  for (std::size_t i = 1; i < route.size(); ++i) {
    const double piece = (route[i] - route[i - 1]).norm();
    if (left <= piece && piece > 0.0) return route[i - 1] + left / piece * (route[i] - route[i - 1]);
    left -= piece;
  }
  return route.back();
}

double cost_of(const Place& place) { return 1.0 + kLooseness * place.looseness + (place.tight ? kTight : 0.0); }

/// A line followed from place to place, each at most a step higher or lower than the one before.
struct Followed {
  bool walkable = false, obstructed = false;
  double cost = 0.0;
};

Followed follow(const Ground& ground, const Vector3d& from, const Vector3d& to, double spacing) {
  Followed line;
  const int count = std::max(1, static_cast<int>(std::ceil((to - from).head<2>().norm() / spacing)));
  const double piece = (to - from).norm() / count;
  double height = from.z();
  for (int i = 0; i <= count; ++i) {
    const std::vector<Place> places = ground.places(from.head<2>() + (to - from).head<2>() * i / count);
    const auto off = [&](const Place& p) { return std::abs(p.height - height); };
    const auto next =
        std::min_element(places.begin(), places.end(), [&](const Place& a, const Place& b) { return off(a) < off(b); });
    if (next == places.end() || off(*next) > ground.rise()) return {};
    line.obstructed = line.obstructed || next->solid >= 0;
    line.cost += piece * cost_of(*next);
    height = next->height;
  }
  line.walkable = !line.obstructed && std::abs(height - to.z()) <= ground.rise();
  return line;
}

/// Places on a grid about the way, which goes along it, so that a turned world has turned routes; joined where one step
/// leads from one to the other.
class Roadmap {
 public:
  /// `margin` [m]: how far they lie beside the way and beyond its ends.
  Roadmap(const Ground& ground, const Vector3d& from, const Vector3d& to, double margin)
      : ground_(&ground), length_(graph_) {
    const Vector2d way = (to - from).head<2>();
    const double length = way.norm();
    if (length > 0.0) along_ = way / length;
    const Vector2d size(length + 2.0 * margin, 2.0 * margin);
    low_ = from.head<2>() - margin * along_ - margin * across();
    spacing_ = std::max(kRoadSpacing * ground.stride(), std::sqrt(size.x() * size.y() / kRoadCellsMax));
    columns_ = 1 + static_cast<int>(size.x() / spacing_);
    rows_ = 1 + static_cast<int>(size.y() / spacing_);
    cells_.resize(static_cast<std::size_t>(columns_) * rows_);
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column) add_places(row, column);
    start_ = add_end(from);
    goal_ = add_end(to);
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column)
        for (const auto& [down, right] : {std::pair(0, 1), std::pair(1, -1), std::pair(1, 0), std::pair(1, 1)})
          if (row + down < rows_ && column + right >= 0 && column + right < columns_)
            join(cell(row, column), cell(row + down, column + right));
  }

  double spacing() const { return spacing_; }

  /// The cheapest way, pulled straight where that is no worse; empty: there is none.
  Route cheapest() const {
    lemon::Dijkstra<lemon::SmartGraph, lemon::SmartGraph::EdgeMap<double>> search(graph_, length_);
    if (!search.run(graph_.nodeFromId(start_), graph_.nodeFromId(goal_))) return {};
    std::vector<int> ids;
    for (lemon::SmartGraph::Node node = graph_.nodeFromId(goal_); node != lemon::INVALID; node = search.predNode(node))
      ids.push_back(graph_.id(node));
    std::reverse(ids.begin(), ids.end());
    return straightened(ids);
  }

  /// Where no way leads from the start to the goal, what ends the straight one.
  std::optional<Barrier> barrier() const {
    lemon::Dijkstra<lemon::SmartGraph, lemon::SmartGraph::EdgeMap<double>> search(graph_, length_);
    search.run(graph_.nodeFromId(start_));
    const auto led_to = [&](const Vector2d& at, double height) {
      for (std::size_t i = 0; i < nodes_.size(); ++i)
        if ((nodes_[i].at.head<2>() - at).norm() <= spacing_ &&
            std::abs(nodes_[i].at.z() - height) <= ground_->rise() &&
            search.reached(graph_.nodeFromId(static_cast<int>(i))))
          return true;
      return false;
    };
    const Vector2d from = nodes_[start_].at.head<2>(), way = nodes_[goal_].at.head<2>() - from;
    const int count = std::max(1, static_cast<int>(std::ceil(way.norm() / spacing_)));
    for (int i = count - 1; i >= 0; --i) {
      const Vector2d at = from + way * i / count;
      const std::vector<Place> places = ground_->places(at), beyond = ground_->places(from + way * (i + 1) / count);
      const auto last = std::find_if(places.begin(), places.end(),
                                     [&](const Place& p) { return p.solid < 0 && led_to(at, p.height); });
      if (last == places.end()) continue;
      const auto off = [&](const Place& p) { return std::abs(p.height - last->height); };
      const auto next = std::min_element(beyond.begin(), beyond.end(),
                                         [&](const Place& a, const Place& b) { return off(a) < off(b); });
      if (next == beyond.end()) return std::nullopt;  // a gap
      const bool steep = off(*next) > ground_->rise();
      if (!steep && next->solid < 0) return std::nullopt;
      return Barrier{steep ? -1 : next->solid,    last->surface,  next->surface, last->height,
                     next->height - last->height, ground_->rise()};
    }
    return std::nullopt;
  }

  /// Make dear what lies near a route, but not near its ends, so that the next one goes elsewhere.
  void avoid(const Route& route) {
    const double near = ground_->stride();
    std::vector<Vector3d> samples;
    for (int s = 0; s <= kRoadSamples; ++s) samples.push_back(point_on(route, static_cast<double>(s) / kRoadSamples));
    std::vector<char> close(nodes_.size(), 0);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const Vector3d& at = nodes_[i].at;
      if ((at - route.front()).norm() < near || (at - route.back()).norm() < near) continue;
      close[i] = std::any_of(samples.begin(), samples.end(),
                             [&](const Vector3d& sample) { return (at - sample).norm() < kNearRoute * near; });
    }
    for (lemon::SmartGraph::EdgeIt edge(graph_); edge != lemon::INVALID; ++edge)
      if (close[graph_.id(graph_.u(edge))] || close[graph_.id(graph_.v(edge))]) length_[edge] *= kAvoided;
  }

 private:
  struct Node {
    Vector3d at;
    double cost;
  };

  std::vector<int>& cell(int row, int column) { return cells_[static_cast<std::size_t>(row) * columns_ + column]; }

  int add(const Vector3d& at, double cost) {
    nodes_.push_back({at, cost});
    return graph_.id(graph_.addNode());
  }

  void add_places(int row, int column) {
    const Vector2d at = low_ + spacing_ * (column * along_ + row * across());
    for (const Place& place : ground_->places(at))
      if (place.solid < 0) cell(row, column).push_back(add({at.x(), at.y(), place.height}, cost_of(place)));
  }

  /// The start or the goal, joined with the places around it.
  int add_end(const Vector3d& at) {
    const int end = add(at, 1.0);
    const Vector2d off = at.head<2>() - low_, middle = Vector2d(off.dot(along_), off.dot(across())) / spacing_;
    for (int row = static_cast<int>(middle.y()); row <= static_cast<int>(middle.y()) + 1; ++row)
      for (int column = static_cast<int>(middle.x()); column <= static_cast<int>(middle.x()) + 1; ++column)
        if (row < rows_ && column < columns_) join({end}, cell(row, column));
    return end;
  }

  void join(const std::vector<int>& some, const std::vector<int>& others) {
    for (int a : some)
      for (int b : others) {
        const Vector3d way = nodes_[b].at - nodes_[a].at;
        if (std::abs(way.z()) > ground_->rise()) continue;
        const lemon::SmartGraph::Edge edge = graph_.addEdge(graph_.nodeFromId(a), graph_.nodeFromId(b));
        length_[edge] = way.norm() * 0.5 * (nodes_[a].cost + nodes_[b].cost);
      }
  }

  /// From each corner on to the farthest node to which the straight line costs no more than the way along the nodes.
  Route straightened(const std::vector<int>& ids) const {
    std::vector<double> cost(ids.size(), 0.0);
    for (std::size_t i = 1; i < ids.size(); ++i) {
      const Node &a = nodes_[ids[i - 1]], &b = nodes_[ids[i]];
      cost[i] = cost[i - 1] + (b.at - a.at).norm() * 0.5 * (a.cost + b.cost);
    }
    Route route{nodes_[ids.front()].at};
    for (std::size_t i = 0; i + 1 < ids.size();) {
      std::size_t next = ids.size() - 1;
      for (; next > i + 1; --next) {
        const Followed line = follow(*ground_, nodes_[ids[i]].at, nodes_[ids[next]].at, spacing_ / 3.0);
        if (line.walkable && line.cost <= kStraighter * (cost[next] - cost[i]) + spacing_) break;
      }
      route.push_back(nodes_[ids[next]].at);
      i = next;
    }
    return route;
  }

  Vector2d across() const { return {-along_.y(), along_.x()}; }

  const Ground* ground_;
  Vector2d low_, along_ = Vector2d::UnitX();
  double spacing_ = 0.0;
  int columns_ = 0, rows_ = 0, start_ = 0, goal_ = 0;
  lemon::SmartGraph graph_;
  lemon::SmartGraph::EdgeMap<double> length_;
  std::vector<Node> nodes_;              // by the id of the graph's
  std::vector<std::vector<int>> cells_;  // their ids
};

/// Two routes are one and the same where ground leads from each point of the one to the nearest of the other.
bool same(const Ground& ground, const Route& a, const Route& b, double spacing) {
  for (int i = 1; i < kRoadSamples; ++i) {
    const Vector3d here = along(a, static_cast<double>(i) / kRoadSamples);
    Vector3d there = b.front();
    for (int j = 1; j <= 2 * kRoadSamples; ++j) {
      const Vector3d other = along(b, 0.5 * j / kRoadSamples);
      if ((other - here).norm() < (there - here).norm()) there = other;
    }
    if ((there - here).norm() > spacing && !follow(ground, here, there, spacing).walkable) return false;
  }
  return true;
}

}  // namespace

Vector3d point_on(const Route& route, double share) {
  // The mean over a stretch about the point, as long as there is room for on both sides.
  constexpr int kHalf = 4;
  const double half = std::min({share, 1.0 - share, kRounding});
  Vector3d sum = Vector3d::Zero();
  for (int i = -kHalf; i <= kHalf; ++i) sum += along(route, share + half * i / kHalf);
  return sum / (2 * kHalf + 1);
}

double turn_on(const Route& route, double share) {
  if (route.size() < 3) return 0.0;
  const Vector2d straight = (route.back() - route.front()).head<2>();
  const double before = std::max(share - kLookAlong, 0.0), after = std::min(share + kLookAlong, 1.0);
  const Vector2d here = (point_on(route, after) - point_on(route, before)).head<2>();
  if (!(straight.norm() > 0.0) || !(here.norm() > 0.0)) return 0.0;
  double aside = 0.0;  // of the straight line, over its length
  for (const Vector3d& at : route) {
    const Vector2d off = (at - route.front()).head<2>();
    aside = std::max(aside, std::abs(straight.x() * off.y() - straight.y() * off.x()) / straight.squaredNorm());
  }
  const double worth = std::clamp(aside / kTurnAside - 1.0, 0.0, 1.0);
  const double turn = std::atan2(straight.x() * here.y() - straight.y() * here.x(), straight.dot(here));
  const double in = std::min(std::min(share, 1.0 - share) / kTurnShare, 1.0);
  return worth * in * in * (3.0 - 2.0 * in) * std::clamp(turn, -0.5 * M_PI, 0.5 * M_PI);
}

namespace {

/// From where the start's feet are on the ground to where the goal's are.
struct Ends {
  Vector3d from, to;

  double length() const { return (to - from).head<2>().norm(); }
};

/// Up to `most` ways over this ground, the cheapest one first, none of which could be shifted into another one.
std::vector<Route> ways_over(const Ground& ground, Roadmap& roadmap, int most) {
  std::vector<Route> ways;
  for (int i = 0; i < 2 * kDetours && static_cast<int>(ways.size()) < most; ++i) {
    const Route route = roadmap.cheapest();
    if (route.empty()) break;
    roadmap.avoid(route);
    const bool known = std::any_of(ways.begin(), ways.end(),
                                   [&](const Route& other) { return same(ground, route, other, roadmap.spacing()); });
    if (!known) ways.push_back(route);
  }
  return ways;
}

double margin_of(const Ground& ground, const Ends& ends) {
  return std::max(kRoadMargin * ground.stride(), 0.5 * ends.length());
}

/// Farther and farther from the straight line, until there is a way or no ground is left.
void find_detours(const Ground& ground, const Ends& ends, Routes& routes) {
  const double widest =
      std::max(ground.extent(ends.from.head<2>()), ground.extent(ends.to.head<2>())) + ground.stride();
  for (double margin = margin_of(ground, ends);; margin *= kWiderRoad) {
    Roadmap roadmap(ground, ends.from, ends.to, std::min(margin, std::max(widest, margin_of(ground, ends))));
    routes.detours = ways_over(ground, roadmap, kDetours);
    if (!routes.detours.empty()) return;
    if (margin >= widest || roadmap.spacing() > kRoadSpacingMax * ground.stride()) {
      routes.barrier = roadmap.barrier();
      return;
    }
  }
}

}  // namespace

Routes find_routes(const Scene& scene, const Robot& robot, double sole_inside) {
  return find_routes(scene, robot, resolve_stance(scene, robot, scene.start, "start"),
                     resolve_stance(scene, robot, scene.goal, "goal"), sole_inside);
}

Routes find_routes(const Scene& scene, const Robot& robot, const ResolvedStance& from, const ResolvedStance& to,
                   double sole_inside) {
  Routes routes;
  const Ground ground(scene, robot, from, to, sole_inside);
  if (!ground.has_feet() || !(ground.stride() > 0.0)) return routes;
  const Vector3d down(0.0, 0.0, robot.com_height);
  const Ends ends{from.com_W - down, to.com_W - down};
  const double spacing = kRoadSpacing * ground.stride();
  const Followed line = follow(ground, ends.from, ends.to, spacing);
  routes.straight = line.walkable;
  routes.obstructed = line.obstructed;
  if (!line.walkable) {
    find_detours(ground, ends, routes);
    return routes;
  }
  const Ground level(scene, robot, from, to, sole_inside, kLevelRise);
  if (follow(level, ends.from, ends.to, spacing).walkable) return routes;
  Roadmap roadmap(level, ends.from, ends.to, margin_of(level, ends));
  routes.detours = ways_over(level, roadmap, kLevelDetours);
  return routes;
}

}  // namespace mcplan::ddp
