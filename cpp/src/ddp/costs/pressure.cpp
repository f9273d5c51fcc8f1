#include "mcplan/ddp/costs/costs.hpp"

namespace mcplan::ddp {

using Eigen::Vector3d;
using Eigen::VectorXd;

void pressure_cost(const Problem& problem, const VectorXd& x, const VectorXd& u, int l, int surface, double sole_yaw,
                   double contact_weight, Rows& rows) {
  const Layout& at = problem.layout;
  const int count = at.pressure_count(l), first = at.nx() + at.pressure(l);
  if (count == 0) return;
  const Eigen::Matrix3Xd& basis = at.offsets(l).pressure;
  const Vector3d offset = at.pressure_offset(u, l);
  const Polygon& polygon = problem.polygons[surface];
  rows.begin(Term::contact);
  const auto add = [&](double weight, double value, const Vector3d& along, bool with_end) {
    if (!rows.with_gradient()) {
      rows.add_value(weight, value);
      return;
    }
    auto g = rows.add_dense(weight, value);
    g.segment(first, count) = basis.transpose() * along;
    if (with_end) g.segment<3>(at.end(l)) = along;
  };
  const Eigen::Matrix3d sole = problem.sole_frame(surface, sole_yaw);
  for (int i = 0; i < 2; ++i) {
    const double along = sole.col(i).dot(offset), half = problem.limits[l].pressure_half[i];
    if (std::abs(along) > half)
      add(problem.options.weights.limit, along > 0 ? along - half : along + half, sole.col(i), false);
  }
  // Within the plane where the inputs alone do not see to it.
  if (count == 3) add(problem.options.weights.limit, polygon.normal_W().dot(offset), polygon.normal_W(), false);
  const Vector3d acting = x.segment<3>(at.end(l)) + offset;
  for (int i = 0; i < polygon.edge_count(); ++i) {
    const double beyond = polygon.overshoot(i, acting) + problem.pressure_margin;
    if (beyond > 0.0)
      add(contact_weight * problem.options.weights.overshoot_factor, beyond, polygon.edge_outward_W(i), true);
  }
}

}  // namespace mcplan::ddp
