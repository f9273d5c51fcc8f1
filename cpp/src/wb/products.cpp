#include "wb/products.hpp"

#include <algorithm>

namespace mcplan::wb {

using Eigen::VectorXd;

void NodeVector::resize(const Layout& layout, const NodeTerms& terms, int k) {
  for (VectorXd* part : {&q, &v, &a}) part->resize(layout.velocities);
  moving.resize(terms.moving.size());
  placed.resize(terms.placed.size());
  wrench.resize(terms.wrench.rows());
  force.resize(layout.node[k].forces);
}

void NodeVector::set_zero() {
  for (VectorXd* part : {&q, &v, &a, &moving, &placed, &wrench, &force}) part->setZero();
}

Products::Products(const Problem& problem, const Layout& layout, const Assembly& assembly)
    : problem_(problem), layout_(layout), assembly_(assembly) {
  velocity_scale_.resize(layout.joints);
  for (int i = 0; i < layout.joints; ++i) velocity_scale_[i] = 1.0 / problem.links[6 + i].velocity_max;
  work_.resize(layout.velocities);
  for (int k = 0; k < layout.nodes; ++k) cost_.push_back(cost_weights_of(k));
}

NodeVector Products::make(int k) const {
  NodeVector out;
  out.resize(layout_, assembly_.node(k), k);
  out.set_zero();
  return out;
}

NodeVector Products::cost_weights_of(int k) const {
  const Weights& w = problem_.weights;
  const NodeLayout& at = layout_.node[k];
  const double weight = layout_.weight[k];
  const int joints = layout_.joints;
  NodeVector out = make(k);
  out.q.segment<3>(3).setConstant(weight * w.base);
  out.q.tail(joints).setConstant(weight * w.posture);
  out.v.tail(joints).setConstant(weight * w.velocity);
  out.a.setConstant(weight * problem_.nodes[k].acceleration * w.acceleration);
  out.moving.segment(6, joints).setConstant(weight * problem_.nodes[k].torque * w.torque);
  int row = at.poses + at.tubes + at.pairs;
  for (const Swing& swing : problem_.nodes[k].swings) {
    const int count = pose_rows(problem_.end_effectors[swing.end_effector]);
    out.placed.segment(row, count).setConstant(weight * swing.weight * w.swing_rotation);
    out.placed.segment<3>(row).setConstant(weight * swing.weight * w.swing);
    row += count;
  }
  out.placed.segment<3>(row).setConstant(weight * w.com);
  out.wrench.setConstant(weight * w.wrench);
  out.force.setConstant(weight * w.force);
  return out;
}

void Products::image(int k, const VectorXd& x, NodeVector& out) const {
  const int nv = layout_.velocities;
  const NodeTerms& terms = assembly_.node(k);
  const NodeLayout& at = layout_.node[k];
  out.q.setZero();
  out.v.setZero();
  out.a.setZero();
  for (int j = 0; j < 3; ++j) {
    const auto c = x.segment(layout_.window(k) + j * nv, nv);
    out.q += layout_.spline.basis(k, 0, j) * c;
    out.v += layout_.spline.basis(k, 1, j) * c;
    out.a += layout_.spline.basis(k, 2, j) * c;
  }
  out.force = x.segment(at.first_force, at.forces);
  out.moving.noalias() = terms.moving_q * out.q;
  out.moving.noalias() += terms.moving_v * out.v;
  out.moving.noalias() += terms.moving_a * out.a;
  out.moving.head(nv).noalias() += terms.moving_force * out.force;
  out.placed.noalias() = terms.placed_q * out.q;
  out.wrench.noalias() = terms.wrench * out.force;
}

void Products::add_transposed(int k, const NodeVector& y, VectorXd& out) {
  const int nv = layout_.velocities;
  const NodeTerms& terms = assembly_.node(k);
  const NodeLayout& at = layout_.node[k];
  const auto spread = [&](int order) {
    for (int j = 0; j < 3; ++j)
      out.segment(layout_.window(k) + j * nv, nv) += layout_.spline.basis(k, order, j) * work_;
  };
  work_ = y.q;
  work_.noalias() += terms.moving_q.transpose() * y.moving;
  work_.noalias() += terms.placed_q.transpose() * y.placed;
  spread(0);
  work_ = y.v;
  work_.noalias() += terms.moving_v.transpose() * y.moving;
  spread(1);
  work_ = y.a;
  work_.noalias() += terms.moving_a.transpose() * y.moving;
  spread(2);
  auto force = out.segment(at.first_force, at.forces);
  force += y.force;
  force.noalias() += terms.moving_force.transpose() * y.moving.head(nv);
  force.noalias() += terms.wrench.transpose() * y.wrench;
}

void Products::values(int k, const VectorXd& x, NodeVector& out) const {
  const NodeTerms& terms = assembly_.node(k);
  const NodeLayout& at = layout_.node[k];
  const Dynamics& d = assembly_.dynamics();
  out.q = d.q.row(k).transpose();
  out.q.segment<3>(3) -= problem_.nodes[k].base_zyx;
  out.q.tail(layout_.joints) -= problem_.posture;
  out.v = d.v.row(k).transpose();
  out.a = d.a.row(k).transpose();
  out.moving = terms.moving;
  out.placed = terms.placed;
  out.wrench = terms.wrench_error;
  out.force = x.segment(at.first_force, at.forces);
}

void Products::to_equalities(int k, const NodeVector& from, VectorXd& out) const {
  const NodeLayout& at = layout_.node[k];
  int row = at.first_equality;
  const auto put = [&](const auto& part) {
    out.segment(row, part.size()) = part;
    row += static_cast<int>(part.size());
  };
  put(from.moving.head<6>());
  put(from.placed.head(at.poses));
  put(from.moving.tail(at.still));
  if (at.at_rest) put(from.v);
}

void Products::add_equalities(int k, const VectorXd& from, NodeVector& out) const {
  const NodeLayout& at = layout_.node[k];
  int row = at.first_equality;
  const auto take = [&](auto part) {
    part += from.segment(row, part.size());
    row += static_cast<int>(part.size());
  };
  take(out.moving.head(6));
  take(out.placed.head(at.poses));
  take(out.moving.tail(at.still));
  if (at.at_rest) take(out.v.head(layout_.velocities));
}

void Products::add_to_equalities(int k, double value, NodeVector& out) const {
  const NodeLayout& at = layout_.node[k];
  out.moving.head<6>().array() += value;
  out.placed.head(at.poses).array() += value;
  out.moving.tail(at.still).array() += value;
  if (at.at_rest) out.v.array() += value;
}

void Products::to_inequalities(int k, const NodeVector& from, VectorXd& out) const {
  const NodeLayout& at = layout_.node[k];
  const int joints = layout_.joints;
  out.segment(at.first_row, joints) = from.q.tail(joints);
  out.segment(at.first_row + joints, joints) = from.v.tail(joints).cwiseProduct(velocity_scale_);
  out.segment(at.first_row + 2 * joints, joints) = from.moving.segment(6, joints);
  out.segment(at.first_row + 3 * joints, at.tubes + at.pairs) = from.placed.segment(at.poses, at.tubes + at.pairs);
  int row = at.first_row + layout_.limit_count(k);
  for (const int load : at.loads) out[row++] = from.wrench[6 * load + 2];
}

void Products::add_inequalities(int k, const VectorXd& from, bool squared, NodeVector& out) const {
  const NodeLayout& at = layout_.node[k];
  const int joints = layout_.joints;
  out.q.tail(joints) += from.segment(at.first_row, joints);
  for (int i = 0; i < joints; ++i) {
    const double scale = squared ? velocity_scale_[i] * velocity_scale_[i] : velocity_scale_[i];
    out.v[6 + i] += scale * from[at.first_row + joints + i];
  }
  out.moving.segment(6, joints) += from.segment(at.first_row + 2 * joints, joints);
  out.placed.segment(at.poses, at.tubes + at.pairs) += from.segment(at.first_row + 3 * joints, at.tubes + at.pairs);
  int row = at.first_row + layout_.limit_count(k);
  for (const int load : at.loads) out.wrench[6 * load + 2] += from[row++];
}

}  // namespace mcplan::wb
