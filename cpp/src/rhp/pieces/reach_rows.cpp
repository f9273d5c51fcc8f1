#include "rhp/pieces/reach_rows.hpp"

#include <cmath>

namespace mcplan::rhp {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<int> com_and_foothold(int com, const Placement& foot) {
  std::vector<int> variables;
  append(variables, com, 3);
  append(variables, foot.variable, 2);
  return variables;
}

/// rows of `name`: A x <= upper.
void add_below(nlp::Problem& problem, const char* name, std::vector<int> variables, MatrixXd A, VectorXd upper) {
  if (upper.size() == 0) return;
  const VectorXd lower = VectorXd::Constant(upper.size(), -nlp::kInfinity);
  problem.add_constraint(std::make_unique<nlp::LinearPiece>(name, std::move(variables), std::move(A)), lower,
                         std::move(upper));
}

}  // namespace

void add_com_reach(nlp::Problem& problem, int com, const Placement& foot, const Polytope& reach_W) {
  MatrixXd A(reach_W.A.rows(), 5);
  A << reach_W.A, -reach_W.A * foot.axes_W.leftCols<2>();
  add_below(problem, "com_reach", com_and_foothold(com, foot), A, reach_W.b + reach_W.A * foot.origin_W);
}

void add_foot_reach(nlp::Problem& problem, const Placement& foot, const Placement& other, const Polytope& reach_W) {
  std::vector<int> variables;
  append(variables, other.variable, 2);
  append(variables, foot.variable, 2);
  MatrixXd A(reach_W.A.rows(), 4);
  A << reach_W.A * other.axes_W.leftCols<2>(), -reach_W.A * foot.axes_W.leftCols<2>();
  add_below(problem, "foot_reach", variables, A, reach_W.b - reach_W.A * (other.origin_W - foot.origin_W));
}

void add_com_height(nlp::Problem& problem, int com, const Placement& foot, const Range& height) {
  std::vector<int> variables{com + 2};
  append(variables, foot.variable, 2);
  MatrixXd A(1, 3);
  A << 1.0, -foot.axes_W.row(2).head<2>();
  const double z = foot.origin_W.z();
  problem.add_constraint(std::make_unique<nlp::LinearPiece>("com_height", variables, A), z + height.min,
                         z + height.max);
}

void add_foothold(nlp::Problem& problem, const Placement& foot, const Polygon& surface,
                  const Eigen::Vector2d& half_size) {
  const auto tangents = foot.axes_W.leftCols<2>();
  MatrixXd A(surface.edge_count(), 2);
  VectorXd upper(surface.edge_count());
  for (int j = 0; j < surface.edge_count(); ++j) {
    A.row(j) = surface.edge_outward_W(j).transpose() * tangents;
    upper[j] = -surface.overshoot(j, foot.origin_W) - A.row(j).cwiseAbs().dot(half_size);
  }
  add_below(problem, "foothold", {foot.variable, foot.variable + 1}, A, upper);
}

}  // namespace mcplan::rhp
