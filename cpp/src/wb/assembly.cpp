#include "wb/assembly.hpp"

#include <algorithm>
#include <utility>

namespace mcplan::wb {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kNoLength = 1e-12;

/// Forces along the edges of the pyramids at a contact's points, over weight, to its wrench in S: (6, edges).
MatrixXd generators(const Contact& contact) {
  const Eigen::Index points = contact.points_S.cols();
  MatrixXd out(6, kEdges * points);
  const double along[kEdges][2] = {{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}};
  for (Eigen::Index p = 0; p < points; ++p)
    for (int e = 0; e < kEdges; ++e) {
      const Vector3d force(contact.friction * along[e][0], contact.friction * along[e][1], 1.0);
      out.col(kEdges * p + e) << force, Vector3d(contact.points_S.col(p)).cross(force);
    }
  return out;
}

}  // namespace

NearestPoints nearest_points(const Vector3d& a0, const Vector3d& a1, const Vector3d& b0, const Vector3d& b1) {
  // Ericson, Real-Time Collision Detection, section 5.1.9.
  const Vector3d along = a1 - a0, other = b1 - b0, apart = a0 - b0;
  const double a = along.squaredNorm(), e = other.squaredNorm(), f = other.dot(apart), c = along.dot(apart);
  if (a <= kNoLength && e <= kNoLength) return {};
  if (a <= kNoLength) return {0.0, std::clamp(f / e, 0.0, 1.0)};
  if (e <= kNoLength) return {std::clamp(-c / a, 0.0, 1.0), 0.0};
  const double b = along.dot(other), det = a * e - b * b;
  double s = det > kNoLength * a * e ? std::clamp((b * f - c * e) / det, 0.0, 1.0) : 0.5;
  double t = (b * s + f) / e;
  if (t < 0.0 || t > 1.0) {
    t = std::clamp(t, 0.0, 1.0);
    s = std::clamp((b * t - c) / a, 0.0, 1.0);
  }
  return {s, t};
}

Assembly::Assembly(const Problem& problem, const Layout& layout, Dynamics& dynamics, Dynamics::Callback callback)
    : problem_(problem), layout_(layout), dynamics_(dynamics), callback_(std::move(callback)), kinematics_(problem) {
  const int nv = layout.velocities;
  dynamics_.resize(layout.nodes, nv, static_cast<int>(problem.end_effectors.size()));
  moving_scale_ = VectorXd::Constant(nv, 1.0 / kForceScale);
  for (int i = 6; i < nv; ++i) moving_scale_[i] = 1.0 / problem.links[i].torque_max;
  jacobian_ = other_ = MatrixXd::Zero(3, nv);
  pose_ = local_ = MatrixXd::Zero(6, nv);
  turning_ = MatrixXd::Zero(nv, nv);
  terms_.resize(layout.nodes);
  for (int k = 0; k < layout.nodes; ++k) {
    NodeTerms& out = terms_[k];
    const NodeLayout& at = layout.node[k];
    const int moving = nv + at.still, placed = layout.placed_count(k);
    out.moving = VectorXd::Zero(moving);
    out.placed = VectorXd::Zero(placed);
    out.moving_q = out.moving_v = out.moving_a = MatrixXd::Zero(moving, nv);
    out.moving_force = MatrixXd::Zero(nv, at.forces);
    out.placed_q = MatrixXd::Zero(placed, nv);
    int count = 0, column = 0;
    for (const Contact& contact : problem.nodes[k].contacts) count += contact.carries ? 6 : 0;
    out.wrench = MatrixXd::Zero(count, at.forces);
    out.wrench_error = VectorXd::Zero(count);
    count = 0;
    for (const Contact& contact : problem.nodes[k].contacts) {
      if (!contact.carries) continue;
      const MatrixXd G = generators(contact);
      out.wrench.block(count, column, 6, G.cols()) = G;
      count += 6;
      column += static_cast<int>(G.cols());
    }
  }
}

void Assembly::evaluate(const VectorXd& x, bool derivatives) {
  spread(x);
  callback_(derivatives);
  for (int k = 0; k < layout_.nodes; ++k) fill(k, derivatives);
}

/// Coordinates at the nodes, and wrenches of the contacts.
void Assembly::spread(const VectorXd& x) {
  const int nv = layout_.velocities;
  Dynamics& d = dynamics_;
  for (int k = 0; k < layout_.nodes; ++k) {
    for (Dynamics::Rows* rows : {&d.q, &d.v, &d.a}) rows->row(k).setZero();
    for (int j = 0; j < 3; ++j) {
      const auto c = x.segment(layout_.window(k) + j * nv, nv).transpose();
      d.q.row(k) += layout_.spline.basis(k, 0, j) * c;
      d.v.row(k) += layout_.spline.basis(k, 1, j) * c;
      d.a.row(k) += layout_.spline.basis(k, 2, j) * c;
    }
    NodeTerms& out = terms_[k];
    out.wrench_error.noalias() = out.wrench * x.segment(layout_.node[k].first_force, layout_.node[k].forces);
    d.wrenches_S.row(k).setZero();
    int row = 0;
    kinematics_.update(d.q.row(k).transpose());
    for (const Contact& contact : problem_.nodes[k].contacts) {
      if (!contact.carries) continue;
      auto wrench = out.wrench_error.segment<6>(row);
      auto given = d.wrenches_S.row(k).segment<6>(6 * contact.end_effector).transpose();
      given = problem_.weight_N * wrench;
      if (const EndEffector& end = problem_.end_effectors[contact.end_effector]; end.is_point())
        given.head<3>() = problem_.weight_N *
                          ((kinematics_.rotation(end.link) * end.rotation).transpose() * contact.rotation_W) *
                          wrench.head<3>();
      wrench -= contact.wrench_S / problem_.weight_N;
      row += 6;
    }
  }
}

void Assembly::fill(int k, bool derivatives) {
  kinematics_.update(dynamics_.q.row(k).transpose());
  fill_moving(k, derivatives);
  fill_still(k, derivatives);
  if (derivatives) fill_forces(k);
  int row = 0;
  fill_contacts(k, row, derivatives);
  fill_tubes(k, row, derivatives);
  fill_pairs(k, row, derivatives);
  fill_swings(k, row, derivatives);
  NodeTerms& out = terms_[k];
  out.placed.segment<3>(row) = kinematics_.com() - problem_.nodes[k].com_W;
  if (!derivatives) return;
  kinematics_.com_jacobian(jacobian_);
  out.placed_q.middleRows<3>(row) = jacobian_;
}

void Assembly::fill_moving(int k, bool derivatives) {
  const int nv = layout_.velocities;
  NodeTerms& out = terms_[k];
  out.moving.head(nv) = moving_scale_.cwiseProduct(dynamics_.tau.row(k).transpose());
  if (!derivatives) return;
  out.moving_q.topRows(nv) = moving_scale_.asDiagonal() * dynamics_.dq.middleRows(k * nv, nv);
  out.moving_v.topRows(nv) = moving_scale_.asDiagonal() * dynamics_.dv.middleRows(k * nv, nv);
  out.moving_a.topRows(nv) = moving_scale_.asDiagonal() * dynamics_.da.middleRows(k * nv, nv);
}

/// Velocities of contacts that rest, at the place where they are to be.
void Assembly::fill_still(int k, bool derivatives) {
  if (layout_.node[k].still == 0) return;
  int row = layout_.velocities;
  NodeTerms& out = terms_[k];
  const auto v = dynamics_.v.row(k).transpose();
  for (const Contact& contact : problem_.nodes[k].contacts) {
    if (!contact.rests) continue;
    const EndEffector& end = problem_.end_effectors[contact.end_effector];
    const int count = pose_rows(end);
    out.moving.segment(row, count) = kinematics_.velocity(end.link, contact.position_W, v).head(count);
    if (derivatives) {
      kinematics_.velocity_derivative(end.link, contact.position_W, v, pose_);
      out.moving_q.middleRows(row, count) = pose_.topRows(count);
      kinematics_.point_jacobian(end.link, contact.position_W, jacobian_);
      out.moving_v.middleRows(row, 3) = jacobian_;
      if (count == 6) {
        kinematics_.rotation_jacobian(end.link, jacobian_);
        out.moving_v.middleRows(row + 3, 3) = jacobian_;
      }
    }
    row += count;
  }
}

/// What forces along the edges take off the generalised forces: -J_S' w.
void Assembly::fill_forces(int k) {
  NodeTerms& out = terms_[k];
  int row = 0, column = 0;
  for (const Contact& contact : problem_.nodes[k].contacts) {
    if (!contact.carries) continue;
    const EndEffector& end = problem_.end_effectors[contact.end_effector];
    Matrix3d to_S = contact.rotation_W.transpose();
    if (!end.is_point()) to_S = (kinematics_.rotation(end.link) * end.rotation).transpose();
    kinematics_.point_jacobian(end.link, kinematics_.point(end.link, end.position), jacobian_);
    local_.topRows<3>().noalias() = to_S * jacobian_;
    kinematics_.rotation_jacobian(end.link, jacobian_);
    local_.bottomRows<3>().noalias() = to_S * jacobian_;
    if (end.is_point()) add_turning(k, row, contact);
    const Eigen::Index edges = kEdges * end.points_S.cols();
    auto to = out.moving_force.middleCols(column, edges);
    to.noalias() = -problem_.weight_N * local_.transpose() * out.wrench.block(row, column, 6, edges);
    to = moving_scale_.asDiagonal() * to;
    row += 6;
    column += static_cast<int>(edges);
  }
}

/// Dynamics hold forces in frames that turn with links. That of a point is held in its contact's frame, and turns the
/// other way in the link's: -J_p' [f] J_r. `local_` has both Jacobians in the contact's axes.
void Assembly::add_turning(int k, int row, const Contact& contact) {
  NodeTerms& out = terms_[k];
  const Vector3d f =
      problem_.weight_N * (out.wrench_error.segment<3>(row) + contact.wrench_S.head<3>() / problem_.weight_N);
  Matrix3d cross;
  cross << 0.0, -f.z(), f.y(), f.z(), 0.0, -f.x(), -f.y(), f.x(), 0.0;
  pose_.topRows<3>().noalias() = cross * local_.bottomRows<3>();
  const int nv = layout_.velocities;
  turning_.noalias() = local_.topRows<3>().transpose() * pose_.topRows<3>();
  out.moving_q.topRows(nv).noalias() -= moving_scale_.asDiagonal() * turning_;
}

/// Distance to a pose and rotation off it, in the pose's own axes, over a scale.
void Assembly::fill_pose(const EndEffector& end, const Vector3d& position_W, const Matrix3d& rotation_W, double scale,
                         NodeTerms& out, int row, bool derivatives) {
  const Vector3d at = kinematics_.point(end.link, end.position);
  out.placed.segment<3>(row) = rotation_W.transpose() * (at - position_W) / scale;
  if (derivatives) {
    kinematics_.point_jacobian(end.link, at, jacobian_);
    out.placed_q.middleRows<3>(row).noalias() = (rotation_W.transpose() / scale) * jacobian_;
  }
  if (end.is_point()) return;
  const Matrix3d R = kinematics_.rotation(end.link) * end.rotation;
  const Vector3d log = rotation_log(rotation_W.transpose() * R);
  out.placed.segment<3>(row + 3) = log / scale;
  if (!derivatives) return;
  kinematics_.rotation_jacobian(end.link, jacobian_);
  const Matrix3d factor = rotation_log_jacobian(log) * R.transpose() / scale;
  out.placed_q.middleRows<3>(row + 3).noalias() = factor * jacobian_;
}

void Assembly::fill_contacts(int k, int& row, bool derivatives) {
  for (const Contact& contact : problem_.nodes[k].contacts) {
    const EndEffector& end = problem_.end_effectors[contact.end_effector];
    fill_pose(end, contact.position_W, contact.rotation_W, kPoseScale, terms_[k], row, derivatives);
    row += pose_rows(end);
  }
}

/// Points of end-effectors in the air, off where the plan has them.
void Assembly::fill_tubes(int k, int& row, bool derivatives) {
  NodeTerms& out = terms_[k];
  for (const Swing& swing : problem_.nodes[k].swings) {
    if (!swing.in_tube) continue;
    const EndEffector& end = problem_.end_effectors[swing.end_effector];
    for (Eigen::Index p = 0; p < end.points_S.cols(); ++p, row += 3) {
      const Vector3d in_S = end.points_S.col(p);
      const Vector3d at = kinematics_.point(end.link, end.position + end.rotation * in_S);
      out.placed.segment<3>(row) = (at - swing.position_W - swing.rotation_W * in_S) / kDistanceScale;
      if (!derivatives) continue;
      kinematics_.point_jacobian(end.link, at, jacobian_);
      out.placed_q.middleRows<3>(row) = jacobian_ / kDistanceScale;
    }
  }
}

/// Distances between capsules, less those that they keep: along the line between their nearest points.
void Assembly::fill_pairs(int k, int& row, bool derivatives) {
  NodeTerms& out = terms_[k];
  for (const CapsulePair& pair : problem_.pairs) {
    const Capsule &one = problem_.capsules[pair.first], &two = problem_.capsules[pair.second];
    const Vector3d a0 = kinematics_.point(one.link, one.start), a1 = kinematics_.point(one.link, one.end);
    const Vector3d b0 = kinematics_.point(two.link, two.start), b1 = kinematics_.point(two.link, two.end);
    const NearestPoints nearest = nearest_points(a0, a1, b0, b1);
    const Vector3d a = a0 + nearest.first * (a1 - a0), b = b0 + nearest.second * (b1 - b0);
    const double apart = (a - b).norm();
    out.placed[row] = (apart - one.radius - two.radius - pair.distance_min) / kDistanceScale;
    if (derivatives) {
      const Vector3d normal = apart > kNoLength ? Vector3d((a - b) / apart) : Vector3d(Vector3d::UnitZ());
      kinematics_.point_jacobian(one.link, a, jacobian_);
      kinematics_.point_jacobian(two.link, b, other_);
      out.placed_q.row(row).noalias() = (normal.transpose() / kDistanceScale) * (jacobian_ - other_);
    }
    ++row;
  }
}

void Assembly::fill_swings(int k, int& row, bool derivatives) {
  for (const Swing& swing : problem_.nodes[k].swings) {
    const EndEffector& end = problem_.end_effectors[swing.end_effector];
    fill_pose(end, swing.position_W, swing.rotation_W, 1.0, terms_[k], row, derivatives);
    row += pose_rows(end);
  }
}

}  // namespace mcplan::wb
