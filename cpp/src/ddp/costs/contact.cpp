#include <algorithm>

#include "mcplan/ddp/costs/costs.hpp"

namespace mcplan::ddp {

using Eigen::Vector3d;
using Eigen::VectorXd;

void contact_cost(const Problem& problem, const VectorXd& x, const VectorXd* u, int l, int surface, double weight,
                  Rows& rows) {
  const Layout& at = problem.layout;
  const Polygon& polygon = problem.polygons[surface];
  const Vector3d p = x.segment<3>(at.end(l));
  rows.begin(Term::contact);
  const auto along = [&](double w, double value, const Vector3d& direction) {
    if (rows.with_gradient())
      rows.add_dense(w, value).segment<3>(at.end(l)) = direction;
    else
      rows.add_value(w, value);
  };
  along(weight, polygon.height(p), polygon.normal_W());
  // Without the extra weight a foot stretches over the edge instead of the hands taking hold (measured: 0 of 108 runs
  // of gap_with_rail find the hands at factor 1, 16 of 16 at 2).
  const bool paper = problem.options.method == Method::paper;
  const double edge_weight = weight * (paper ? 1.0 : problem.options.weights.overshoot_factor);
  const double margin = paper ? 0.0 : problem.edge_margin;
  for (int i = 0; i < polygon.edge_count(); ++i) {
    const double beyond = polygon.overshoot(i, p) + margin + (paper ? 0.0 : problem.sole_margin[l][surface][i]);
    if (beyond > 0.0) along(edge_weight, beyond, polygon.edge_outward_W(i));
  }
  if (!u) return;
  for (int i = 0; i < 3; ++i) rows.add_single(weight, (*u)[at.stride(l) + i], at.nx() + at.stride(l) + i);
}

void free_cost(const Problem& problem, const VectorXd& u, int l, double weight, Rows& rows) {
  const Layout& at = problem.layout;
  rows.begin(Term::free);
  rows.add_single(weight, u[at.stiffness(l)], at.nx() + at.stiffness(l));
  for (int i = 0; i < at.moment_count(); ++i)
    if (at.moments()[i].end_effector == l) rows.add_single(weight, u[at.moment(i)], at.nx() + at.moment(i));
}

void keep_out_cost(const Problem& problem, const VectorXd& x, int l, double weight, Rows& rows) {
  const Vector3d p = x.segment<3>(problem.layout.end(l));
  rows.begin(Term::free);
  for (std::size_t i = 0; i < problem.polygons.size(); ++i) {
    const Polygon& polygon = problem.polygons[i];
    const double height = polygon.height(p);
    if (height >= 0.0 || height < -problem.keep_out_depth[i] || polygon.outside(p) > 0.0) continue;
    if (rows.with_gradient())
      rows.add_dense(weight, height).segment<3>(problem.layout.end(l)) = polygon.normal_W();
    else
      rows.add_value(weight, height);
  }
}

bool in_flight(const ContactState& state) {
  return std::all_of(state.begin(), state.end(), [](int contact) { return contact == kFree; });
}

double flight_cost(const Problem& problem, const ContactState& state) {
  const double w = problem.options.method == Method::paper || !in_flight(state) ? 0.0 : problem.options.weights.flight;
  return 0.5 * w * w;
}

double contact_change_cost(const Problem& problem, const ContactState& from, const ContactState& to) {
  const double w = problem.options.method == Method::paper ? 0.0 : problem.options.weights.contact_change;
  double cost = 0.0;
  for (std::size_t l = 0; l < from.size(); ++l)
    if (from[l] != to[l]) cost += 0.5 * w * w;
  return cost;
}

double contact_change_cost(const Problem& problem, const ContactSequence& sequence) {
  double cost = 0.0;
  for (std::size_t k = 1; k < sequence.size(); ++k) cost += contact_change_cost(problem, sequence[k - 1], sequence[k]);
  return cost;
}

}  // namespace mcplan::ddp
