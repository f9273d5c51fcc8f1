#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "ddp/constants.hpp"
#include "ddp/problem.hpp"
#include "ddp/walls.hpp"

/// How far inside their surfaces footholds are planned.
namespace mcplan::ddp {

using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// Footholds are so much further from a wall, in heights of the CoM: 0.04 m of TALOS, within this ratio of the
/// surface's width. Measured on tilted patches: heels of TALOS are 16 mm longer than its sole, swings that fall steeply
/// beside a wall land 20 mm off and late, and with 0.03 m one still caught its edge. The G1's plans cost 0.6 times what
/// they do with 0.04 m.
constexpr double kWallRoom = 0.04 / 0.877, kWallShare = 0.5, kWallNarrow = 0.48;
/// Cosine of the angle to the headings of start and goal, above which an edge is ahead. Chosen.
constexpr double kAhead = 0.7;

}  // namespace

double Problem::foothold_margin(int l, int surface, int edge, double extra_margin) const {
  const double margin = foothold_margins_[l][surface][edge];
  double further = margin + edge_margin;
  // A hand without a surface of its own takes hold where it can.
  if (extra_margin > 0.0 && (limits[l].half_width > 0.0 || robot.end_effectors[active[l]].kind == "foot"))
    further = std::max(further, std::min(margin + extra_margin, kNarrow * widths_[surface][edge]) + edge_margin);
  return std::max(margin, std::min(further, slack_[l][surface][edge]));
}

double Problem::margin_of_given(int l, int surface, int edge, const Vector3d& place, double margin,
                                Vector3d* by_place) const {
  const auto relax = [&](const ContactState& contacts, const VectorXd& x) {
    if (contacts[l] != surface) return;
    const Vector3d given = x.segment<3>(layout.end(l)), off = place - given;
    const double inside = std::max(0.0, -polygons[surface].overshoot(edge, given)), distance = off.norm();
    if (!(inside + distance < margin)) return;
    margin = inside + distance;
    if (by_place) *by_place = distance > 0.0 ? Vector3d(off / distance) : Vector3d::Zero();
  };
  relax(start_contacts, start);
  relax(goal_contacts, reference.x.back());
  return margin;
}

/// How far inside each edge the end-effectors have to stand at the start and at the goal: no margin may ask for more.
void Problem::make_slack() {
  slack_.clear();
  for (int l = 0; l < layout.end_effector_count(); ++l) {
    std::vector<std::vector<double>>& of_end = slack_.emplace_back();
    for (std::size_t i = 0; i < polygons.size(); ++i) {
      std::vector<double>& of_surface = of_end.emplace_back();
      for (int edge = 0; edge < polygons[i].edge_count(); ++edge) {
        double slack = std::numeric_limits<double>::infinity();
        const auto stands = [&](const ContactState& contacts, const VectorXd& x) {
          if (contacts[l] == static_cast<int>(i))
            slack = std::min(slack, std::max(0.0, -polygons[i].overshoot(edge, x.segment<3>(layout.end(l)))));
        };
        stands(start_contacts, start);
        stands(goal_contacts, reference.x.back());
        of_surface.push_back(slack);
      }
    }
  }
}

void Problem::make_foothold_margins() {
  const double start_heading = start_yaw.empty() ? goal_yaw : start_yaw.front();
  const double ratio = options.sole_inside < 0.0 ? robot.sole_support : options.sole_inside;
  for (const Polygon& polygon : polygons) {
    std::vector<double>& of_surface = widths_.emplace_back();
    for (int i = 0; i < polygon.edge_count(); ++i) {
      double width = 0.0;
      for (const Vector3d& vertex : polygon.vertices_W()) width = std::max(width, -polygon.overshoot(i, vertex));
      of_surface.push_back(width);
    }
  }
  const double unit = similarity.length / units.length;
  const Walls walls(polygons, thickness, unit);
  for (const EndLimits& limit : limits) {
    const Eigen::Vector2d half = limit.half_size;
    std::vector<std::vector<double>>& of_end = foothold_margins_.emplace_back();
    for (std::size_t surface = 0; surface < polygons.size(); ++surface) {
      const Polygon& polygon = polygons[surface];
      std::vector<double>& of_surface = of_end.emplace_back();
      for (int i = 0; i < polygon.edge_count(); ++i) {
        const Vector3d& outward = polygon.edge_outward_W(i);
        const double width = widths_[surface][i];
        double extent = 0.0;
        for (double way : {0.0, 0.25, 0.5, 0.75, 1.0}) {
          const double yaw = start_heading + way * (goal_yaw - start_heading);
          const Vector3d heading(std::cos(yaw), std::sin(yaw), 0.0);
          Vector3d across = polygon.normal_W().cross(heading);
          // On a wall that is faced the two are parallel: the sole's width is taken to lie level then.
          if (across.norm() < 1e-6) across = Vector3d::UnitZ().cross(heading);
          across.normalize();
          const Vector3d along = across.cross(polygon.normal_W());
          extent = std::max(extent, half[0] * std::abs(along.dot(outward)) + half[1] * std::abs(across.dot(outward)));
        }
        // A point foot is a ball in truth, and lands with what error a controller leaves.
        const double inside = limit.balances ? kPointMargin : ratio * extent;
        const double margin = std::min(inside, std::max(kNarrow * width, width - inside));
        // Links are longer than the sole and land beside where they should. A foot comes to what is ahead of it from
        // below, and steps up from there. Of what is narrow a little more than nothing is left.
        const bool ahead = outward.dot(Vector3d(std::cos(start_heading), std::sin(start_heading), 0.0)) > kAhead &&
                           outward.dot(Vector3d(std::cos(goal_yaw), std::sin(goal_yaw), 0.0)) > kAhead;
        const double wall = extent > 0.0 && !ahead ? walls.beyond(static_cast<int>(surface), i) : 0.0;
        const double room = std::min(kWallRoom, kWallShare * wall);
        of_surface.push_back(std::max(margin, std::min(margin + room, kWallNarrow * width)));
      }
    }
  }
}

}  // namespace mcplan::ddp
