#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "mcplan/rhp/receding_horizon.hpp"
#include "rhp/pieces/contact_point.hpp"
#include "rhp/polytopes.hpp"
#include "rhp/walker.hpp"

/// A heavy robot on two feet, whose left and right are mirror images, and the ground that it walks on.
namespace walkers {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// The field that the error of `work` names.
template <typename Error>
std::string field_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.field();
  }
  return "nothing thrown";
}

enum Foot { left, right };

constexpr double kGravity = 9.80665, kFriction = 0.3;

/// Repeatable random numbers.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  VectorXd vector(int size, double scale = 1.0) {
    return VectorXd::NullaryExpr(size, [&] { return in(-scale, scale); });
  }
  Vector3d three(double scale = 1.0) { return vector(3, scale); }
  Matrix3d rotation(double tilt_max = 0.4) {
    return (Eigen::AngleAxisd(in(-M_PI, M_PI), Vector3d::UnitZ()) *
            Eigen::AngleAxisd(in(-tilt_max, tilt_max), Vector3d::UnitX()) *
            Eigen::AngleAxisd(in(-tilt_max, tilt_max), Vector3d::UnitY()))
        .toRotationMatrix();
  }

 private:
  std::mt19937 engine_;
};

/// Force of a contact point [N], written out: along t1, t2, n of its surface, or along the edges of its pyramid.
inline Vector3d force_W(const mcplan::rhp::ContactPoint& point, const mcplan::rhp::Placement& foot, const VectorXd& x) {
  Vector3d sum = Vector3d::Zero();
  if (point.edges_W.cols() == 0)
    for (int i = 0; i < 3; ++i) sum += 100.0 * x[point.variable + i] * foot.axes_W.col(i);
  else
    for (int i = 0; i < point.edges_W.cols(); ++i) sum += 100.0 * x[point.variable + i] * point.edges_W.col(i);
  return sum;
}

/// Polytope of the rows a . x <= b that are given as (a, b), a of any length.
inline mcplan::Polytope polytope(const std::vector<Eigen::Vector4d>& rows) {
  mcplan::Polytope out;
  out.A.resize(rows.size(), 3);
  out.b.resize(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double length = rows[i].head<3>().norm();
    out.A.row(i) = rows[i].head<3>().transpose() / length;
    out.b[i] = rows[i][3] / length;
  }
  return out;
}

inline mcplan::Polytope mirrored(mcplan::Polytope polytope) {
  polytope.A.col(1) *= -1.0;
  return polytope;
}

/// Where the CoM may be over a left foot: a box without its upper corners.
inline mcplan::Polytope com_over_left() {
  return polytope({{1, 0, 0, 0.6},
                   {-1, 0, 0, 0.75},
                   {0, 1, 0, 0.05},
                   {0, -1, 0, 0.40},
                   {0, 0, 1, 1.15},
                   {0, 0, -1, -0.45},
                   {1, 0, 1, 1.40},
                   {-1, 0, 1, 1.50},
                   {0, -1, 1, 1.30}});
}

/// Where a left foot may stand beside a right one: a box without the corners far ahead and far behind.
inline mcplan::Polytope left_beside_right() {
  return polytope({{1, 0, 0, 0.32},
                   {-1, 0, 0, 0.32},
                   {0, 1, 0, 0.85},
                   {0, -1, 0, -0.19},
                   {0, 0, 1, 0.35},
                   {0, 0, -1, 0.35},
                   {1, 1, 0, 0.75},
                   {-1, 1, 0, 0.75}});
}

inline mcplan::Robot robot() {
  mcplan::Robot out;
  out.name = "walker";
  out.mass = 95.0;
  out.inertia = {16.0, 13.0, 4.0};
  out.com_height = 0.75;
  for (double side : {1.0, -1.0}) {
    mcplan::EndEffector foot;
    foot.name = side > 0 ? "left_foot" : "right_foot";
    foot.half_size = {0.11, 0.06};
    foot.nominal_B = {0.0, 0.1 * side, -0.75};
    foot.reach_min_B = {-0.6, side > 0 ? -0.05 : -0.40, -1.15};
    foot.reach_max_B = {0.75, side > 0 ? 0.40 : 0.05, -0.45};
    foot.max_force = 1600.0;
    foot.com_reach = side > 0 ? com_over_left() : mirrored(com_over_left());
    foot.partner_reach[side > 0 ? "right_foot" : "left_foot"] =
        side > 0 ? mirrored(left_beside_right()) : left_beside_right();
    out.end_effectors.push_back(foot);
  }
  return out;
}

/// Rectangle on x0..x1, y0..y1 whose height at its centre is z and rises by the slopes.
inline mcplan::Surface patch(const std::string& name, double x0, double x1, double y0, double y1, double z = 0.0,
                             double slope_x = 0.0, double slope_y = 0.0) {
  mcplan::Surface out;
  out.name = name;
  out.friction = kFriction;
  out.end_effectors = {"foot"};
  const double x = 0.5 * (x0 + x1), y = 0.5 * (y0 + y1);
  for (const Vector2d& corner : {Vector2d(x0, y0), Vector2d(x1, y0), Vector2d(x1, y1), Vector2d(x0, y1)})
    out.vertices_W.push_back({corner.x(), corner.y(), z + slope_x * (corner.x() - x) + slope_y * (corner.y() - y)});
  return out;
}

/// Level start, two pairs of tilted patches, level end; the left foot steps first.
inline mcplan::Scene uneven() {
  mcplan::Scene scene;
  scene.name = "uneven";
  scene.gravity = kGravity;
  scene.surfaces = {patch("start", -1.0, 0.35, -0.5, 0.5),
                    patch("right_1", 0.35, 0.95, -0.5, 0.0, 0.02, 0.1, -0.15),
                    patch("left_1", 0.35, 0.95, 0.0, 0.5, -0.01, -0.15, 0.1),
                    patch("right_2", 0.95, 1.55, -0.5, 0.0, 0.0, 0.0, 0.2),
                    patch("left_2", 0.95, 1.55, 0.0, 0.5, 0.03, 0.15, 0.0),
                    patch("end", 1.55, 30.0, -0.5, 0.5)};
  scene.start.contacts = {{"foot", "start"}};
  scene.goal.position_W = {20.0, 0.0, 0.0};
  scene.goal.contacts = {{"foot", "end"}};
  scene.steps = {{"left_foot", "start"},    {"right_foot", "right_1"}, {"left_foot", "left_1"},
                 {"right_foot", "right_2"}, {"left_foot", "left_2"},   {"right_foot", "end"}};
  return scene;
}

/// Level ground without end, the left foot first.
inline mcplan::Scene plain() {
  mcplan::Scene scene = uneven();
  scene.name = "plain";
  scene.surfaces = {patch("ground", -5.0, 30.0, -3.0, 3.0)};
  scene.start.contacts = scene.goal.contacts = {{"foot", "ground"}};
  scene.steps = {{"left_foot", "ground"}};
  return scene;
}

/// Left and right exchanged, feet included.
inline mcplan::Scene mirrored(mcplan::Scene scene) {
  for (mcplan::Surface& surface : scene.surfaces) {
    for (Vector3d& vertex : surface.vertices_W) vertex.y() *= -1.0;
    surface.vertices_W = {surface.vertices_W.rbegin(), surface.vertices_W.rend()};
  }
  for (mcplan::Stance* stance : {&scene.start, &scene.goal}) {
    stance->position_W.y() *= -1.0;
    stance->yaw *= -1.0;
  }
  for (mcplan::Step& step : scene.steps)
    step.end_effector = step.end_effector == "left_foot" ? "right_foot" : "left_foot";
  return scene;
}

/// The whole world turned about the vertical and shifted.
inline mcplan::Scene moved(mcplan::Scene scene, double yaw, const Vector3d& shift_W) {
  const Eigen::AngleAxisd R(yaw, Vector3d::UnitZ());
  for (mcplan::Surface& surface : scene.surfaces)
    for (Vector3d& vertex : surface.vertices_W) vertex = R * vertex + shift_W;
  for (mcplan::Stance* stance : {&scene.start, &scene.goal}) {
    stance->position_W = R * stance->position_W + shift_W;
    stance->yaw += yaw;
  }
  return scene;
}

/// Fewer intervals than the planner's default: a cycle is two to three times as fast.
inline mcplan::rhp::Options quick(mcplan::rhp::Fidelity fidelity = mcplan::rhp::Fidelity::point, int lookahead = 2) {
  mcplan::rhp::Options options;
  options.fidelity = fidelity;
  options.lookahead = lookahead;
  options.intervals = 4;
  options.cycles = 2;
  return options;
}

}  // namespace walkers
