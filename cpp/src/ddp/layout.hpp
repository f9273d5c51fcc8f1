#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace mcplan::ddp {

/// Where each quantity lies in the state x and the input u (Tazaki, eq. 13).
///
///     x = [ com p (3), velocity v (3), base angles theta (a), angular momentum L (a), end-effectors p_l (3 each) ]
///     u = [ strides dp_l (3 each), stiffness mu_l or lambda_l (1 each), centres of pressure c_l, force lines r_l,
///           moments tau, duration h (1) ]
///
/// The paper's t_k is left out: no cost reads it, so it is only the running sum of the durations. Base axes that
/// nothing can drive (a < 3, in the paper's model) are left out as well; they would keep their initial value for ever.
/// How many numbers c_l, r_l and tau are, and what they stand for, the Problem decides: none in the paper's model,
/// whose forces act at p_l and point at the CoM. z = [x, u] stacks the two.
class Layout {
 public:
  /// What one end-effector can do besides pushing along the line to the CoM. A column a direction, world axes.
  struct Offsets {
    Eigen::Matrix3Xd pressure;    ///< c_l = pressure * (its inputs): from p_l to where the force acts
    Eigen::Matrix3Xd force_line;  ///< r_l = force_line * (its inputs): from there to the line through the CoM
  };
  struct Moment {
    int end_effector;
    Eigen::Vector3d direction_W;  ///< unit vector
    double max;                   ///< largest absolute value, in units of the problem
  };

  Layout() = default;
  Layout(std::vector<Offsets> end_effectors, std::vector<int> axes, std::vector<Moment> moments)
      : end_effectors_(std::move(end_effectors)), axes_(std::move(axes)), moments_(std::move(moments)) {
    int next = 4 * end_effector_count();
    for (const Offsets& e : end_effectors_) {
      pressure_.push_back(next);
      next += static_cast<int>(e.pressure.cols());
    }
    for (const Offsets& e : end_effectors_) {
      force_line_.push_back(next);
      next += static_cast<int>(e.force_line.cols());
    }
    first_moment_ = next;
  }

  int end_effector_count() const { return static_cast<int>(end_effectors_.size()); }
  const Offsets& offsets(int l) const { return end_effectors_[l]; }
  const std::vector<int>& axes() const { return axes_; }           ///< active base axes: 0 roll, 1 pitch, 2 yaw
  const std::vector<Moment>& moments() const { return moments_; }  ///< which moments are inputs
  int axis_count() const { return static_cast<int>(axes_.size()); }
  int moment_count() const { return static_cast<int>(moments_.size()); }
  int pressure_count(int l) const { return static_cast<int>(end_effectors_[l].pressure.cols()); }
  int force_line_count(int l) const { return static_cast<int>(end_effectors_[l].force_line.cols()); }

  int nx() const { return 6 + 2 * axis_count() + 3 * end_effector_count(); }
  int nu() const { return first_moment_ + moment_count() + 1; }
  int nz() const { return nx() + nu(); }

  // Offsets in x.
  static constexpr int com() { return 0; }
  static constexpr int velocity() { return 3; }
  static constexpr int angle(int a = 0) { return 6 + a; }
  int momentum(int a = 0) const { return 6 + axis_count() + a; }
  int end(int l) const { return 6 + 2 * axis_count() + 3 * l; }

  // Offsets in u.
  static constexpr int stride(int l) { return 3 * l; }
  int stiffness(int l = 0) const { return 3 * end_effector_count() + l; }
  int pressure(int l) const { return pressure_[l]; }
  int force_line(int l) const { return force_line_[l]; }
  int moment(int i = 0) const { return first_moment_ + i; }
  int duration() const { return first_moment_ + moment_count(); }

  /// c_l, from the end-effector to where its force acts.
  Eigen::Vector3d pressure_offset(const Eigen::VectorXd& u, int l) const {
    return end_effectors_[l].pressure * u.segment(pressure(l), pressure_count(l));
  }
  /// r_l, from where the force acts to the line on which it points at the CoM.
  Eigen::Vector3d line_offset(const Eigen::VectorXd& u, int l) const {
    return end_effectors_[l].force_line * u.segment(force_line(l), force_line_count(l));
  }
  /// a_l = p_l + c_l, where the force acts: the centre of pressure.
  Eigen::Vector3d acting_point(const Eigen::VectorXd& x, const Eigen::VectorXd& u, int l) const {
    return x.segment<3>(end(l)) + pressure_offset(u, l);
  }
  /// s_l = a_l + r_l, from which the force points at the CoM.
  Eigen::Vector3d line_point(const Eigen::VectorXd& x, const Eigen::VectorXd& u, int l) const {
    return acting_point(x, u, l) + line_offset(u, l);
  }
  /// g += (d a_l / dz)' along.
  void add_along_acting_point(int l, const Eigen::Vector3d& along, Eigen::Ref<Eigen::VectorXd> g) const {
    g.segment<3>(end(l)) += along;
    g.segment(nx() + pressure(l), pressure_count(l)) += end_effectors_[l].pressure.transpose() * along;
  }
  /// g += (d s_l / dz)' along.
  void add_along_line_point(int l, const Eigen::Vector3d& along, Eigen::Ref<Eigen::VectorXd> g) const {
    add_along_acting_point(l, along, g);
    g.segment(nx() + force_line(l), force_line_count(l)) += end_effectors_[l].force_line.transpose() * along;
  }

  /// Size of a difference between states, the same in a turned world: norms of vectors, sum of angles.
  double distance(const Eigen::VectorXd& difference) const {
    double sum = difference.segment<3>(com()).norm() + difference.segment<3>(velocity()).norm() +
                 difference.segment(angle(), axis_count()).lpNorm<1>() +
                 difference.segment(momentum(), axis_count()).norm();
    for (int l = 0; l < end_effector_count(); ++l) sum += difference.segment<3>(end(l)).norm();
    return sum;
  }

 private:
  std::vector<Offsets> end_effectors_;
  std::vector<int> axes_;
  std::vector<Moment> moments_;
  std::vector<int> pressure_, force_line_;
  int first_moment_ = 0;
};

}  // namespace mcplan::ddp
