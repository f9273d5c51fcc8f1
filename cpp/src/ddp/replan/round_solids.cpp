#include "ddp/replan/round_solids.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ddp/constants.hpp"
#include "ddp/replan/under_feet.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Room that a stance has, of what a walk keeps from solids, is told in these. It steps away from them by up to so many
/// strides, in one of so many directions. Chosen.
constexpr double kRooms[] = {1.0, 0.75, 0.5, 0.25};
constexpr double kAwayStrides = 1.5;
constexpr int kDirections = 16;

/// The place at this height, or near enough for a step.
std::optional<Place> place_at(const Ground& ground, const Vector2d& at, double height, double room) {
  std::optional<Place> out;
  for (const Place& place : ground.places(at, room))
    if (std::abs(place.height - height) <= ground.rise() &&
        (!out || std::abs(place.height - height) < std::abs(out->height - height)))
      out = place;
  return out;
}

bool free_at(const Ground& ground, const Vector3d& at_W, double room) {
  const std::optional<Place> place = place_at(ground, at_W.head<2>(), at_W.z(), room);
  return place && place->solid < 0;
}

double room_at(const Ground& ground, const Vector3d& at_W) {
  for (const double room : kRooms)
    if (free_at(ground, at_W, room)) return room;
  return 0.0;
}

/// Whether a solid is in the way somewhere straight on. Looked at before routes are: of ground with gaps, which steps
/// lead over, these take a grid of places.
bool obstructed(const Ground& ground, const Vector3d& from_W, const Vector3d& to_W) {
  const Vector2d way = (to_W - from_W).head<2>();
  const int count = std::max(1, static_cast<int>(std::ceil(way.norm() / (kRoadSpacing * ground.stride()))));
  for (int i = 0; i <= count; ++i) {
    const std::vector<Place> places = ground.places(from_W.head<2>() + way * i / count);
    if (!places.empty() && std::all_of(places.begin(), places.end(), [](const Place& p) { return p.solid >= 0; }))
      return true;
  }
  return false;
}

/// The nearest point that a walk can begin from, straight on from where there is less room.
std::optional<Vector3d> way_out(const Ground& ground, const Vector3d& from_W, double room) {
  const double step = kRoadSpacing * ground.stride();
  std::vector<int> open(kDirections, 1);
  for (double far = step; far <= kAwayStrides * ground.stride(); far += step)
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2.0 * M_PI * i / kDirections;
      const Vector2d at = from_W.head<2>() + far * Vector2d(std::cos(angle), std::sin(angle));
      const std::optional<Place> place = open[i] ? place_at(ground, at, from_W.z(), room) : std::nullopt;
      open[i] = place && place->solid < 0;
      if (!open[i]) continue;
      const Vector3d found(at.x(), at.y(), place->height);
      if (free_at(ground, found, 1.0)) return found;
    }
  return std::nullopt;
}

}  // namespace

RoundSolids::RoundSolids(const Scene& scene, const Robot& robot, const ResolvedStance& from, const ResolvedStance& to)
    : ground_(scene, robot, from, to, -1.0) {
  const Vector3d down(0.0, 0.0, robot.com_height), here_W = from.com_W - down;
  if (!ground_.has_feet() || !(ground_.stride() > 0.0) || !obstructed(ground_, here_W, to.com_W - down)) return;
  room_ = room_at(ground_, here_W);
  ResolvedStance begin = from;
  if (room_ < 1.0) {
    const std::optional<Vector3d> out = way_out(ground_, here_W, room_);
    if (!out) return;
    begin.com_W = *out + down;
  }
  const Routes found = find_routes(scene, robot, begin, to, -1.0);
  routes_ = found.detours;
  if (found.straight) routes_ = {{begin.com_W - down, to.com_W - down}};
  if (room_ < 1.0)
    for (Route& route : routes_) route.insert(route.begin(), here_W);
}

bool RoundSolids::is_free(const Vector3d& at_W) const { return free_at(ground_, at_W, room_); }

AlongRoute::AlongRoute(const Route& route, double yaw, double spacing) {
  double length = 0.0;
  for (std::size_t i = 1; i < route.size(); ++i) length += (route[i] - route[i - 1]).norm();
  const int count = std::max(1, static_cast<int>(std::ceil(length / spacing)));
  points_.resize(count + 1);
  for (int i = count; i >= 0; --i) {
    Point& point = points_[i];
    point.at_W = point_on(route, static_cast<double>(i) / count);
    point.yaw = yaw + turn_on(route, static_cast<double>(i) / count);
    if (i == count) continue;
    const Vector2d on = turned((points_[i + 1].at_W - point.at_W).head<2>(), -point.yaw);
    point.left = points_[i + 1].left + on.cwiseAbs();
  }
}

const AlongRoute::Point& AlongRoute::nearest(const Vector3d& at_W) const {
  return *std::min_element(points_.begin(), points_.end(), [&](const Point& a, const Point& b) {
    return (a.at_W - at_W).squaredNorm() < (b.at_W - at_W).squaredNorm();
  });
}

}  // namespace mcplan::ddp
