#include "ddp/over_bars.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

#include "ddp/ground.hpp"
#include "mcplan/scene/polygon.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

bool holds_feet(const Surface& surface, const Robot& robot) {
  return std::any_of(robot.end_effectors.begin(), robot.end_effectors.end(),
                     [&](const EndEffector& end) { return end.kind == "foot" && may_touch(surface, end); });
}

/// Height of a plane above or below a point.
double height_at(const Polygon& polygon, const Vector2d& at) {
  const Vector3d &n = polygon.normal_W(), &v = polygon.vertices_W().front();
  return v.z() - n.head<2>().dot(at - v.head<2>()) / n.z();
}

bool is_below(const Polygon& polygon, const Vector2d& at) {
  return polygon.normal_W().z() > 0.5 && polygon.outside({at.x(), at.y(), height_at(polygon, at)}) <= 0.0;
}

/// Where the line from `from` to `to` passes a level polygon, seen from above.
std::optional<Bar> passage(const Polygon& polygon, const Vector2d& from, const Vector2d& to) {
  const Vector2d way = to - from;
  double in = 0.0, out = 1.0;
  Bar bar;
  for (int e = 0; e < polygon.edge_count(); ++e) {
    const Vector2d outward = polygon.edge_outward_W(e).head<2>(), vertex = polygon.vertices_W()[e].head<2>();
    const double beyond = outward.dot(from - vertex), grows = outward.dot(way);
    if (grows == 0.0) {
      if (beyond > 0.0) return std::nullopt;
      continue;
    }
    const double share = -beyond / grows;
    if (grows < 0.0 && share > in) {
      in = share;
      bar.near_outward = outward;
      bar.near_point = vertex;
    }
    if (grows > 0.0 && share < out) {
      out = share;
      bar.far_outward = outward;
      bar.far_point = vertex;
    }
  }
  if (!(in > 0.0) || !(out < 1.0) || !(in < out)) return std::nullopt;
  bar.near = in * way.norm();
  bar.far = out * way.norm();
  bar.middle = from + 0.5 * (in + out) * way;
  return bar;
}

/// Feet of a stance that are on the ground lie outside of an edge.
bool feet_outside(const ResolvedStance& stance, const Robot& robot, const Vector2d& outward, const Vector2d& point) {
  for (std::size_t e = 0; e < robot.end_effectors.size(); ++e)
    if (robot.end_effectors[e].kind == "foot" && stance.contacts[e] >= 0 &&
        outward.dot(stance.end_effectors_W[e].head<2>() - point) < robot.end_effectors[e].half_size.x())
      return false;
  return true;
}

/// What of a polygon lies outside of an edge.
std::vector<Vector3d> outside_of(const std::vector<Vector3d>& polygon, const Vector2d& outward, const Vector2d& point) {
  std::vector<Vector3d> out;
  const auto beyond = [&](const Vector3d& p) { return outward.dot(p.head<2>() - point); };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d &here = polygon[i], &next = polygon[(i + 1) % polygon.size()];
    const double a = beyond(here), b = beyond(next);
    if (a >= 0.0) out.push_back(here);
    if ((a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0)) out.push_back(here + a / (a - b) * (next - here));
  }
  return out;
}

/// Length of the longest sole.
double sole_length(const Robot& robot) {
  double length = 0.0;
  for (const EndEffector& end : robot.end_effectors)
    if (end.kind == "foot") length = std::max(length, 2.0 * end.half_size.x());
  return length;
}

/// Between two feet, beyond what is usual.
double longest_step(const Robot& robot) {
  double length = std::numeric_limits<double>::infinity();
  for (const EndEffector& end : robot.end_effectors)
    if (end.kind == "foot") length = std::min(length, end.reach_max_B.x() - end.reach_min_B.x());
  return length;
}

/// A piece has room for a sole beside the edge that it was cut at.
bool has_room(const std::vector<Vector3d>& piece, const Vector2d& outward, const Vector2d& point, double sole) {
  return std::any_of(piece.begin(), piece.end(),
                     [&](const Vector3d& p) { return outward.dot(p.head<2>() - point) > sole; });
}

/// A name that no surface has.
std::string name_behind(const Scene& scene, const std::string& name) {
  std::string out = name + ", behind";
  while (scene.surface_index(out) >= 0) out += "'";
  return out;
}

}  // namespace

std::vector<Bar> bars_across(const Scene& scene, const Robot& robot, double sole_inside) {
  const ResolvedStance from = resolve_stance(scene, robot, scene.start, "start");
  const ResolvedStance to = resolve_stance(scene, robot, scene.goal, "goal");
  const Ground ground(scene, robot, from, to, sole_inside);
  std::vector<Bar> bars;
  if (!ground.has_feet()) return bars;
  for (int i = 0; i < static_cast<int>(scene.surfaces.size()); ++i) {
    const Surface& surface = scene.surfaces[i];
    const Polygon polygon(surface.vertices_W);
    constexpr double kLevel = 0.999;
    if (holds_feet(surface, robot) || polygon.normal_W().z() < kLevel) continue;
    std::optional<Bar> bar = passage(polygon, from.com_W.head<2>(), to.com_W.head<2>());
    if (!bar || bar->far - bar->near + sole_length(robot) > longest_step(robot)) continue;
    bar->solid = i;
    const double top = height_at(polygon, bar->middle);
    const auto stands_low = [&](const Surface& below) {
      const Polygon floor(below.vertices_W);
      if (!holds_feet(below, robot) || !is_below(floor, bar->middle)) return false;
      const double rise = top - height_at(floor, bar->middle);
      return rise > 0.0 && rise <= ground.rise();
    };
    if (std::none_of(scene.surfaces.begin(), scene.surfaces.end(), stands_low)) continue;
    if (!feet_outside(from, robot, bar->near_outward, bar->near_point) ||
        !feet_outside(to, robot, bar->far_outward, bar->far_point))
      return {};
    bars.push_back(*bar);
  }
  std::sort(bars.begin(), bars.end(), [](const Bar& a, const Bar& b) { return a.near < b.near; });
  return bars;
}

void cut_at(const std::vector<Bar>& bars, const Robot& robot, Scene& scene, std::vector<int>& surfaces) {
  const double sole = sole_length(robot);
  for (const Bar& bar : bars) {
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
      const Surface whole = scene.surfaces[i];
      if (!holds_feet(whole, robot) || !is_below(Polygon(whole.vertices_W), bar.middle)) continue;
      Surface before = whole, behind = whole;
      before.vertices_W = outside_of(whole.vertices_W, bar.near_outward, bar.near_point);
      behind.vertices_W = outside_of(whole.vertices_W, bar.far_outward, bar.far_point);
      if (!has_room(before.vertices_W, bar.near_outward, bar.near_point, sole) ||
          !has_room(behind.vertices_W, bar.far_outward, bar.far_point, sole))
        continue;
      behind.name = name_behind(scene, whole.name);
      for (auto& [who, surface] : scene.goal.contacts)
        if (surface == whole.name) surface = behind.name;
      scene.surfaces[i] = before;
      const auto at = static_cast<std::ptrdiff_t>(i) + 1;
      scene.surfaces.insert(scene.surfaces.begin() + at, behind);
      surfaces.insert(surfaces.begin() + at, surfaces[i]);
      ++i;
    }
  }
}

void name_pieces(const Problem& problem, const std::vector<int>& surfaces, Incumbent& motion) {
  for (std::size_t k = 0; k < motion.sequence.size(); ++k)
    for (std::size_t l = 0; l < motion.sequence[k].size(); ++l) {
      int& named = motion.sequence[k][l];
      if (named == kFree) continue;
      const Vector3d place = motion.trajectory.x[k].segment<3>(problem.layout.end(static_cast<int>(l)));
      for (int i = 0; i < static_cast<int>(surfaces.size()); ++i)
        if (surfaces[i] == surfaces[named] &&
            problem.polygons[i].outside(place) < problem.polygons[named].outside(place))
          named = i;
    }
}

}  // namespace mcplan::ddp
