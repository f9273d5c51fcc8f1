#include "rhp/pieces/contact_rows.hpp"

#include <algorithm>
#include <cmath>

namespace mcplan::rhp {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

std::vector<int> triple(int first) { return {first, first + 1, first + 2}; }

/// Whether |f_component| <= limit follows from f_z <= limit for all forces in the outer pyramid, whose edges these are.
bool implied(const Eigen::Matrix3d& axes_W, double friction, int component) {
  for (double s1 : {-1.0, 1.0})
    for (double s2 : {-1.0, 1.0}) {
      const Vector3d edge = axes_W * Vector3d(s1 * friction, s2 * friction, 1.0);
      if (edge.z() <= 0.0 || std::abs(edge[component]) > edge.z()) return false;
    }
  return true;
}

}  // namespace

void add_acceleration(nlp::Problem& problem, int acceleration, const std::vector<Placement>& placements,
                      const std::vector<ContactPoint>& points, double mass, double gravity) {
  std::vector<int> variables = triple(acceleration);
  for (const ContactPoint& point : points) append(variables, point.variable, point.count());
  MatrixXd A(3, variables.size());
  A.leftCols<3>() = mass / kForceUnit * Eigen::Matrix3d::Identity();
  int at = 3;
  for (const ContactPoint& point : points) {
    A.middleCols(at, point.count()) = -point.directions_W(placements[point.placement]);
    at += point.count();
  }
  const VectorXd weight = -mass * gravity / kForceUnit * Vector3d::UnitZ();
  problem.add_constraint(std::make_unique<nlp::LinearPiece>("acceleration", variables, A), weight, weight);
}

void add_friction(nlp::Problem& problem, const ContactPoint& point, double friction, int sides, bool outer,
                  bool turned) {
  const int rows = outer ? 4 : sides;
  MatrixXd A(rows, 3);
  for (int j = 0; j < rows; ++j) {
    const double angle = 2.0 * M_PI * (turned && !outer ? j + 0.5 : j) / rows;
    A.row(j) << std::cos(angle), std::sin(angle), -friction * (outer ? 1.0 : std::cos(M_PI / sides));
  }
  for (double& entry : A.reshaped())
    if (std::abs(entry) < 1e-12) entry = 0.0;  // the sines of multiples of pi, which would fill the sparse structure
  problem.add_constraint(std::make_unique<nlp::LinearPiece>("friction", triple(point.variable), A), -nlp::kInfinity,
                         0.0);
}

Eigen::Matrix3Xd pyramid_edges(const Placement& placement, double friction, int sides, bool outer) {
  const int count = outer ? 4 : sides;
  Eigen::Matrix3Xd edges(3, count);
  for (int j = 0; j < count; ++j) {
    const double angle = 2.0 * M_PI * (outer ? j + 0.5 : j) / count, out = outer ? std::sqrt(2.0) : 1.0;
    edges.col(j) = placement.axes_W * Vector3d(out * friction * std::cos(angle), out * friction * std::sin(angle), 1.0);
  }
  for (double& entry : edges.reshaped())
    if (std::abs(entry) < 1e-12) entry = 0.0;
  return edges;
}

void add_force_box(nlp::Problem& problem, const Placement& placement, const ContactPoint& point, double limit,
                   double friction) {
  const Eigen::Matrix3d& axes = placement.axes_W;
  const double max_force = limit / kForceUnit;
  const bool edges = point.edges_W.cols() > 0, level = std::abs(axes(2, 2) - 1.0) < 1e-12;
  if (level && !edges) problem.set_bounds(point.variable + 2, 0.0, max_force);
  std::vector<int> variables;
  append(variables, point.variable, point.count());
  for (int component : {2, 0, 1}) {
    if (component == 2 && level && !edges) continue;
    if (component != 2 && implied(axes, friction, component)) continue;
    const bool never_below = edges && point.edges_W.row(component).minCoeff() >= 0.0;
    problem.add_constraint(std::make_unique<nlp::LinearPiece>("force_box", variables,
                                                              MatrixXd(point.directions_W(placement).row(component))),
                           never_below ? -nlp::kInfinity : -max_force, max_force);
  }
}

}  // namespace mcplan::rhp
