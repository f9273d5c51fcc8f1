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
/// Of a course that turns so many headings are looked at, where it passes a surface within so many heights of the CoM.
constexpr int kHeadings = 60;
constexpr double kPasses = 0.1;
/// Cosine of the angle to the headings on a surface, above which an edge is ahead. Chosen.
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

/// Headings of soles on each surface [rad]: where the base turns to its way, or with the turns of a route, those that
/// it has where it passes the surface, otherwise those from start to goal. `from`, `to`: the CoM there [m].
std::vector<std::vector<double>> Problem::headings_on_surfaces(const Vector3d& from, const Vector3d& to) const {
  const double start_heading = start_yaw.empty() ? goal_yaw : start_yaw.front();
  if (!course.turns()) {
    std::vector<double> all;
    for (double way : {0.0, 0.25, 0.5, 0.75, 1.0}) all.push_back(start_heading + way * (goal_yaw - start_heading));
    return std::vector<std::vector<double>>(polygons.size(), all);
  }
  const Headings headings(course, start_heading, goal_yaw, (to - from).head<2>());
  std::vector<Eigen::Vector2d> places;
  std::vector<double> yaws;
  double length = 0.0;
  for (int i = 0; i <= kHeadings; ++i) {
    const double share = static_cast<double>(i) / kHeadings;
    const Vector3d at = course.route.empty() ? Vector3d(from + share * (to - from)) : point_on(course.route, share);
    places.emplace_back(at.head<2>() / units.length);
    yaws.push_back(headings.at(share));
    if (i > 0) length += (places[i] - places[i - 1]).norm();
  }
  const double near = kPasses + 0.5 * length / kHeadings;
  std::vector<std::vector<double>> out;
  for (const Polygon& polygon : polygons) {
    Eigen::AlignedBox2d box;
    for (const Vector3d& vertex : polygon.vertices_W()) box.extend(Eigen::Vector2d(vertex.head<2>()));
    std::vector<double>& own = out.emplace_back();
    double least = std::numeric_limits<double>::infinity(), nearest = 0.0;
    for (int i = 0; i <= kHeadings; ++i) {
      const double away = box.exteriorDistance(places[i]);
      if (away <= near) own.push_back(yaws[i]);
      if (away < least) nearest = yaws[i];
      least = std::min(least, away);
    }
    if (own.empty()) own.push_back(nearest);
  }
  return out;
}

void Problem::make_foothold_margins(const Vector3d& from, const Vector3d& to) {
  const std::vector<std::vector<double>> headings = headings_on_surfaces(from, to);
  // On a course that turns a surface is left the least that a sole needs there: a corridor of 0.25 m holds both feet of
  // TALOS straight ahead and not aslant. Of soles that turn on it a corner may be over its edge.
  const bool turns = course.turns();
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
        double extent = turns ? std::numeric_limits<double>::infinity() : 0.0;
        for (double yaw : headings[surface]) {
          const Vector3d heading(std::cos(yaw), std::sin(yaw), 0.0);
          Vector3d across = polygon.normal_W().cross(heading);
          // On a wall that is faced the two are parallel: the sole's width is taken to lie level then.
          if (across.norm() < 1e-6) across = Vector3d::UnitZ().cross(heading);
          across.normalize();
          const Vector3d along = across.cross(polygon.normal_W());
          const double here = half[0] * std::abs(along.dot(outward)) + half[1] * std::abs(across.dot(outward));
          extent = turns ? std::min(extent, here) : std::max(extent, here);
        }
        // A point foot is a ball in truth, and lands with what error a controller leaves.
        const double inside = limit.balances ? kPointMargin : ratio * extent;
        const double margin = std::min(inside, std::max(kNarrow * width, width - inside));
        // Links are longer than the sole and land beside where they should. A foot comes to what is ahead of it from
        // below, and steps up from there. Of what is narrow a little more than nothing is left.
        const bool ahead = std::all_of(headings[surface].begin(), headings[surface].end(), [&](double yaw) {
          return outward.dot(Vector3d(std::cos(yaw), std::sin(yaw), 0.0)) > kAhead;
        });
        const double wall = extent > 0.0 && !ahead ? walls.beyond(static_cast<int>(surface), i) : 0.0;
        const double room = std::min(kWallRoom, kWallShare * wall);
        of_surface.push_back(std::max(margin, std::min(margin + room, kWallNarrow * width)));
      }
    }
  }
}

}  // namespace mcplan::ddp
