#pragma once

#include <array>
#include <vector>

namespace mcplan::ddp {

/// Where each quantity lies in the state x and the input u (Tazaki, eq. 13).
///
///     x = [ com p (3), velocity v (3), base angles theta (a), rates omega (a), end-effectors p_l (3 each) ]
///     u = [ strides dp_l (3 each), stiffness mu_l or lambda_l (1 each), moments tau (m), duration h (1) ]
///
/// The paper's t_k is left out: no cost reads it, so it is only the running sum of the durations. Base axes that no
/// contact moment can drive (a < 3) are left out as well; they would keep their initial value for ever.
/// z = [x, u] stacks the two.
class Layout {
 public:
  struct Moment {
    int end_effector;
    int axis;  ///< position in axes()
  };

  Layout() = default;
  Layout(int end_effectors, std::vector<int> axes, std::vector<Moment> moments)
      : ends_(end_effectors), axes_(std::move(axes)), moments_(std::move(moments)) {}

  int ends() const { return ends_; }
  const std::vector<int>& axes() const { return axes_; }           ///< active base axes: 0 roll, 1 pitch, 2 yaw
  const std::vector<Moment>& moments() const { return moments_; }  ///< which moments are inputs
  int axis_count() const { return static_cast<int>(axes_.size()); }
  int moment_count() const { return static_cast<int>(moments_.size()); }

  int nx() const { return 6 + 2 * axis_count() + 3 * ends_; }
  int nu() const { return 4 * ends_ + moment_count() + 1; }
  int nz() const { return nx() + nu(); }

  // Offsets in x.
  static constexpr int com() { return 0; }
  static constexpr int velocity() { return 3; }
  static constexpr int angle(int a = 0) { return 6 + a; }
  int rate(int a = 0) const { return 6 + axis_count() + a; }
  int end(int l) const { return 6 + 2 * axis_count() + 3 * l; }

  // Offsets in u.
  static constexpr int stride(int l) { return 3 * l; }
  int stiffness(int l = 0) const { return 3 * ends_ + l; }
  int moment(int i = 0) const { return 4 * ends_ + i; }
  int duration() const { return 4 * ends_ + moment_count(); }

 private:
  int ends_ = 0;
  std::vector<int> axes_;
  std::vector<Moment> moments_;
};

}  // namespace mcplan::ddp
