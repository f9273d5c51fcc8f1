#pragma once

#include <string>
#include <vector>

#include "ddp/pendulum.hpp"
#include "mcplan/base/rotation.hpp"
#include "support.hpp"

/// Pendulums of all shapes, and random states and inputs of them.
namespace pendulum_cases {

using namespace support;
using ddp::Layout;
using ddp::Model;
using ddp::Pendulum;
using ddp::StiffnessInput;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

struct Shape {
  std::string name;
  Model model;
  Layout layout;
};

/// What one end-effector can do, by the number of directions.
inline Layout::Offsets offsets(int pressure, int force_line) {
  const Matrix3d tilted = mcplan::rotation_from_rpy({0.3, -0.2, 0.5});
  return {pressure == 3 ? Matrix3Xd(Matrix3d::Identity()) : Matrix3Xd(tilted.leftCols(pressure)),
          Matrix3d::Identity().leftCols(force_line)};
}

/// Both models: soles on one plane and on several, points, point contacts without anything; few axes and none.
inline std::vector<Shape> shapes() {
  const Vector3d tilted = mcplan::rotation_from_rpy({0.3, -0.2, 0.5}).col(2);
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  const auto plain = [](int ends) { return std::vector<Layout::Offsets>(ends); };
  return {{"soles and points",
           Model::wrench,
           {{offsets(2, 2), offsets(3, 3), offsets(0, 3)},
            {0, 1, 2},
            {{0, tilted, 1.0}, {1, x, 1.0}, {1, y, 1.0}, {1, z, 1.0}}}},
          {"soles", Model::wrench, {{offsets(2, 2), offsets(2, 2)}, {0, 1, 2}, {{0, z, 1.0}, {1, z, 1.0}}}},
          {"no offsets", Model::wrench, {plain(2), {0, 1, 2}, {{1, tilted, 1.0}}}},
          {"lipm", Model::lipm, {plain(3), {0, 1, 2}, {{0, x, 1.0}, {0, y, 1.0}, {0, z, 1.0}, {2, y, 1.0}}}},
          {"lipm, yaw alone", Model::lipm, {plain(2), {2}, {{0, z, 1.0}, {1, z, 1.0}}}},
          {"lipm without a base", Model::lipm, {plain(4), {}, {}}}};
}

inline const Vector3d kInertia(0.2, 0.5, 0.3);

struct Case {
  Model model;
  Layout layout;
  Pendulum pendulum;
  VectorXd x, u;
};

/// Random state and input; mu_l of the order `scale` (lambda_l of its root), `sign` for repelling contacts. Momenta and
/// moments of the order `spin`, so that the base turns by about as many radians.
inline Case draw(Random& random, const Shape& shape, StiffnessInput input, double scale, double sign = 1.0,
                 double spin = 0.2) {
  const Layout& at = shape.layout;
  Case c{shape.model, at, Pendulum(at, kInertia, input, shape.model), noise(random, at.nx(), 1.0),
         noise(random, at.nu(), 0.5)};
  c.x.segment(at.angle(), at.axis_count()) *= 0.5;
  c.x.segment(at.momentum(), at.axis_count()) *= spin;
  for (int l = 0; l < at.end_effector_count(); ++l) {
    const double mu = scale * uniform(random, 0.5, 1.0);
    c.u[at.stiffness(l)] = input == StiffnessInput::lambda ? std::sqrt(mu) : sign * mu;
    c.u.segment(at.force_line(l), at.force_line_count(l)) *= spin;
  }
  c.u.segment(at.moment(), at.moment_count()) *= spin;
  c.u[at.duration()] = uniform(random, 0.5, 1.8);
  return c;
}

inline VectorXd next(const Case& c, const VectorXd& x, const VectorXd& u) {
  VectorXd out;
  c.pendulum.next(x, u, out);
  return out;
}

}  // namespace pendulum_cases
