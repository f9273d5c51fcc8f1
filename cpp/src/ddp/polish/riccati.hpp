#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "ddp/polish/motion.hpp"
#include "ddp/polish/stage_costs.hpp"

namespace mcplan::ddp::polish {

/// The linear-quadratic problem about a motion, by the backward recursion of its value functions: variables [x, v] with
/// the inputs that the contacts leave, dx_{k+1} = A dx_k + B dv_k + defect_k, dx_0 = 0 but for what may vary.
class Riccati {
 public:
  explicit Riccati(const FixedSequence& fixed);

  /// The models of the knots, to be filled in before solve(), which overwrites them.
  StageModel& model(int k) { return models_[k]; }

  /// The Newton step of all variables. `proximal` is added to the Hessian of the inputs. False when one is not positive
  /// definite.
  bool solve(const Motion& motion, double proximal, std::vector<Eigen::VectorXd>& dz);

 private:
  void linearise(const Motion& motion, int k);
  bool backward(const Motion& motion, int k, double proximal);

  const FixedSequence* fixed_;
  std::vector<StageModel> models_;
  struct Stage {
    Eigen::MatrixXd jacobian;  ///< of CoM, velocity, base and momentum at the end of the phase, by Phase::moving
    Eigen::MatrixXd pushed, scattered, pulled;
    Eigen::VectorXd offset, w;
  };
  std::vector<Stage> stages_;
};

}  // namespace mcplan::ddp::polish
