#pragma once

#include <Eigen/Core>

namespace mcplan::ipm {

/// Nothing times what is not finite is nan.
inline bool all_finite(const Eigen::Ref<const Eigen::VectorXd>& values) { return (0.0 * values).sum() == 0.0; }

}  // namespace mcplan::ipm
