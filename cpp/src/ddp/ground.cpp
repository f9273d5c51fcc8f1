#include "ddp/ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ddp/constants.hpp"
#include "ddp/costs/prism.hpp"
#include "ddp/leg_lines.hpp"
#include "ddp/trunk_room.hpp"
#include "mcplan/base/rotation.hpp"
#include "plan/solid_box.hpp"

namespace mcplan::ddp {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// By so much, in heights of the CoM, a robot ducks below what its trunk would touch, on two feet and on four. Chosen:
/// the G1 ducked by 0.11 m falls when it is tracked, and ANYmal ducked by 0.13 m does not.
constexpr double kDuck = 0.12, kDuckOnFour = 0.25;
/// Room about hands in their nominal place, for elbows, likewise. Chosen.
constexpr double kArmRoom = 0.1;

}  // namespace

Ground::Ground(const Scene& scene, const Robot& robot, const ResolvedStance& from, const ResolvedStance& to,
               double sole_inside, double rise_ratio) {
  stride_ = rise_ = std::numeric_limits<double>::infinity();
  height_ = robot.com_height;
  half_width_ = kTrunkRoom * robot.com_height;
  const bool turns = from.yaw != to.yaw;
  const double support = std::min(sole_inside < 0.0 ? robot.sole_support : sole_inside, 1.0);
  for (std::size_t e = 0; e < robot.end_effectors.size(); ++e) {
    if (from.contacts[e] < 0 || to.contacts[e] < 0) continue;
    const EndEffector& end = robot.end_effectors[e];
    const Vector3d size = end.usual_box().sizes();
    feet_.push_back(static_cast<int>(e));
    stride_ = std::min(stride_, size.x());
    rise_ = std::min(rise_, size.z());
    half_width_ = std::max(half_width_, std::abs(end.nominal_B.y()) + end.half_size.y() + kFootRoom * height_);
    radius_ = std::max(radius_, end.nominal_B.head<2>().norm() + end.half_size.norm() + kFootRoom * height_);
    inside_ = std::max(inside_, support * end.half_size.x());
    const Vector3d place = rotation_from_rpy({0.0, 0.0, from.yaw}) * end.nominal_B;
    nominal_.push_back(turns ? Vector2d::Zero() : Vector2d(place.head<2>()));
  }
  rise_ *= rise_ratio * (1.0 + 1e-9);  // steps just as high are no higher by rounding
  layers_.push_back({rise_, kTrunkHeight * height_, half_width_});
  const double duck = feet_.size() >= 4 ? kDuckOnFour : kDuck;
  for (const TrunkPart& part : robot.trunk) {
    const double room = room_about(part);
    const auto [low, high] = std::minmax(part.from_B.z(), part.to_B.z());
    layers_.push_back({std::max(height_ + low - part.radius, rise_), height_ + high + part.radius - duck * height_,
                       std::max(std::abs(part.from_B.y()), std::abs(part.to_B.y())) + room});
  }
  for (const EndEffector& end : robot.end_effectors) {
    const LimbLimits& leg = end.limb;
    if (!leg.given() || !(leg.radius > 0.0)) continue;
    const double hip = height_ + leg.hip_B.z();
    layers_.push_back({std::max(hip - leg.upper, rise_), hip + leg.radius,
                       std::abs(leg.hip_B.y()) + std::abs(leg.beside) + kLegRoom * leg.radius});
  }
  for (const EndEffector& end : robot.end_effectors) {
    if (robot.trunk.empty() || end.kind == "foot") continue;
    arms_ = {std::max(height_ + end.nominal_B.z(), rise_), kTrunkHeight * height_,
             std::max(arms_.within, std::abs(end.nominal_B.y()) + kArmRoom * height_)};
  }
  for (int i = 0; i < static_cast<int>(scene.surfaces.size()); ++i) {
    const Surface& surface = scene.surfaces[i];
    const Solid solid{Polygon(surface.vertices_W), surface.thickness};
    const double up = solid.polygon.normal_W().z();
    const bool holds = up > kGroundNormal && std::any_of(feet_.begin(), feet_.end(), [&](int e) {
                         return may_touch(surface, robot.end_effectors[e]);
                       });
    if (holds) {
      patches_.push_back({solid.polygon, {}, i});
      for (const Vector3d& vertex : surface.vertices_W) patches_.back().box.extend(vertex);
    }
    // A slope comes near the trunk uphill of it, and is no obstacle.
    constexpr double kStraight = 1e-3;
    if (std::abs(up) < kStraight || std::abs(up) > 1.0 - kStraight)
      solids_.push_back({solid.polygon, solid.thickness, box_of(solid), i});
  }
}

double Ground::extent(const Vector2d& from) const {
  double farthest = 0.0;
  for (const Patch& patch : patches_)
    for (const Vector3d& vertex : patch.polygon.vertices_W())
      farthest = std::max(farthest, (vertex.head<2>() - from).norm());
  return farthest;
}

double Ground::gap() const { return std::max(kGapRatio * stride_ - inside_, kGapRatioMin * stride_); }

/// The point of a patch that is nearest to a point of its plane above or below `at`.
Ground::Footing Ground::footing(const Patch& patch, const Vector2d& at) const {
  const Vector3d &n = patch.polygon.normal_W(), &v = patch.polygon.vertices_W().front();
  const Vector3d point(at.x(), at.y(), v.z() - n.head<2>().dot(at - v.head<2>()) / n.z());
  if (patch.polygon.outside(point) <= 0.0) return {0.0, point.z()};
  const Vector3d nearest = patch.polygon.nearest(point);
  return {(nearest.head<2>() - at).norm(), nearest.z()};
}

/// The first solid in a layer above ground of this height.
int Ground::solid_at(const Vector2d& at, double height, const Layer& layer) const {
  const double low = height + layer.low, high = height + layer.high, within = layer.within;
  const auto found = std::find_if(solids_.begin(), solids_.end(), [&](const Standing& solid) {
    const Eigen::AlignedBox3d& box = solid.box;
    if (!(box.max().z() > low) || !(box.min().z() < high)) return false;
    const Vector2d nearest = at.cwiseMax(box.min().head<2>()).cwiseMin(box.max().head<2>());
    if (!((nearest - at).norm() < within)) return false;
    // What is flat or upright is as near at the middle of the heights that both have as at any other of them.
    const double middle = 0.5 * (std::max(low, box.min().z()) + std::min(high, box.max().z()));
    return outside_prism(solid.polygon, solid.thickness, {at.x(), at.y(), middle}).distance < within;
  });
  return found == solids_.end() ? -1 : found->surface;
}

std::vector<Place> Ground::places(const Vector2d& at, double room) const {
  double widest = 0.0;
  for (const Vector2d& place : nominal_) widest = std::max(widest, place.norm());
  const double far = gap() + widest;
  std::vector<const Patch*> near;
  for (const Patch& patch : patches_) {
    const Vector2d nearest = at.cwiseMax(patch.box.min().head<2>()).cwiseMin(patch.box.max().head<2>());
    if ((nearest - at).norm() <= far) near.push_back(&patch);
  }
  std::vector<Place> out;
  for (const Patch* patch : near) {
    const Footing below = footing(*patch, at);
    if (below.away > gap()) continue;
    const bool known = std::any_of(out.begin(), out.end(), [&](const Place& place) {
      return std::abs(place.height - below.height) < kSameHeightRatio * rise_;
    });
    if (known) continue;
    Place place{below.height, 0.0, patch->surface};
    bool stands = true;
    for (const Vector2d& foot : nominal_) {
      double away = std::numeric_limits<double>::infinity();
      for (const Patch* under : near) {
        const Footing here = footing(*under, at + foot);
        if (std::abs(here.height - below.height) <= rise_) away = std::min(away, here.away);
      }
      stands = stands && away <= gap();
      place.looseness += away / gap() / static_cast<double>(nominal_.size());
    }
    if (!stands) continue;
    // The trunk is a cylinder as wide as the feet stand, and what the robot has above it.
    for (const Layer& layer : layers_)
      if (place.solid < 0) place.solid = solid_at(at, place.height, {layer.low, layer.high, room * layer.within});
    const Layer turning{layers_.front().low, layers_.front().high, radius_};
    place.tight = place.solid >= 0 || solid_at(at, place.height, turning) >= 0 ||
                  (arms_.within > 0.0 && solid_at(at, place.height, arms_) >= 0);
    out.push_back(place);
  }
  std::sort(out.begin(), out.end(), [](const Place& a, const Place& b) { return a.height > b.height; });
  return out;
}

}  // namespace mcplan::ddp
