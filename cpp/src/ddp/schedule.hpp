#pragma once

#include <vector>

#include "ddp/problem.hpp"

namespace mcplan::ddp {

/// Weights that change from iteration to iteration, and the tuning of the attempt that they belong to.
struct Schedule {
  Tuning tuning;
  double contact_weight = 0.01;   ///< w_compl
  double interior_weight = 0.0;   ///< on reach, friction and force inside the phases
  bool discovering = false;       ///< the weights that Model::wrench has in discovery
  double proximal_weight = 30.0;  ///< on the change of the input: 1/2 r |du|^2, a part of the model's cost

  /// Not null: only the least change that closes the dynamics defects is sought, whatever it costs. Held (by a
  /// weight so large that their change is rounding) are the base and the end-effectors at the start and, at every step,
  /// the inputs that are marked here.
  const std::vector<std::vector<char>>* fixed_inputs = nullptr;
};

}  // namespace mcplan::ddp
