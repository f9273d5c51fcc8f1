#include "ddp/reachable_surfaces.hpp"

#include <algorithm>

#include "ddp/constants.hpp"
#include "mcplan/scene/polygon.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

double distance_to_segment(const Vector3d& point, const Vector3d& from, const Vector3d& to) {
  const Vector3d way = to - from;
  const double length = way.squaredNorm();
  const double s = length > 0.0 ? std::clamp((point - from).dot(way) / length, 0.0, 1.0) : 0.0;
  return (point - from - s * way).norm();
}

}  // namespace

Outlook outlook(int level) {
  if (level >= kOutlooks - 1) return {};
  const int i = std::max(level, 0);
  return {kOutlookReach[i], kOutlookNearest[i], kOutlookWithin[i]};
}

double reach_of(const Robot& robot) {
  double longest = 0.0;
  for (const EndEffector& end : robot.end_effectors)
    longest = std::max(longest, (end.reach_max_B - end.reach_min_B).norm());
  return longest + robot.com_height;
}

std::vector<int> surfaces_near_way(const Scene& scene, const std::vector<Vector3d>& from,
                                   const std::vector<Vector3d>& to, double distance, const std::set<int>& needed) {
  std::vector<int> out;
  for (int i = 0; i < static_cast<int>(scene.surfaces.size()); ++i) {
    // The solid below a surface counts: a wall's top may be out of reach, and the wall in the way.
    std::vector<Vector3d> vertices = scene.surfaces[i].vertices_W;
    const Vector3d below = scene.surfaces[i].thickness * Polygon(vertices).normal_W();
    for (std::size_t n = vertices.size(), v = 0; v < n; ++v) vertices.push_back(vertices[v] - below);
    Vector3d middle = Vector3d::Zero();
    for (const Vector3d& v : vertices) middle += v / static_cast<double>(vertices.size());
    double radius = 0.0;
    for (const Vector3d& v : vertices) radius = std::max(radius, (v - middle).norm());
    bool near = needed.count(i) > 0;
    for (std::size_t e = 0; e < from.size() && !near; ++e)
      near = distance_to_segment(middle, from[e], to[e]) <= distance + radius;
    if (near) out.push_back(i);
  }
  return out;
}

Scene part_of(const Scene& scene, const std::vector<int>& surfaces) {
  Scene part;
  part.name = scene.name;
  part.description = scene.description;
  part.gravity = scene.gravity;
  for (int i : surfaces) part.surfaces.push_back(scene.surfaces[i]);
  part.start = scene.start;
  part.goal = scene.goal;
  part.rules = scene.rules;
  return part;
}

void put_back(Plan& plan, const Scene& scene, const std::vector<int>& surfaces) {
  const auto there = [&](int& surface) {
    if (surface >= 0) surface = surfaces[surface];
  };
  for (Phase& phase : plan.phases)
    for (Contact& contact : phase.contacts) there(contact.surface);
  for (int& surface : plan.final_contacts) there(surface);
  plan.scene = scene;
}

}  // namespace mcplan::ddp
