#pragma once

#include <Eigen/Core>

namespace mcplan::ddp {

/// Minimise  1/2 z'Hz  over the last variables of z = [x, u], in place: H_uu = R R' with R upper triangular is
/// Cholesky's factorisation begun at the last variable. Of H the upper triangle is read and written. Afterwards it
/// holds
///
///     [ H_xx - Y Y'   Y ]
///     [               R ],   Y = H_xu R^-T,
///
/// the Hessian that is left of x, and what the minimiser u = -R^-T (R^-1 g_u + Y' x) needs. The strict lower triangle
/// is no longer H's. False when H_uu is not positive definite.
///
/// One pass over the matrix for what would be a factorisation, a triangular solve and a product: stages have 20 to 60
/// variables, too few for the packing of a general product to pay.
bool eliminate_last(Eigen::MatrixXd& h, int count);

}  // namespace mcplan::ddp
