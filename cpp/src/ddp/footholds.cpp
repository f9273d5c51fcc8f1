#include "ddp/footholds.hpp"

#include <algorithm>

namespace mcplan::ddp {

using Eigen::Vector3d;

void snap_positions(const Problem& problem, const ContactSequence& sequence, Trajectory& t) {
  const Layout& at = problem.layout;
  const int n = problem.steps;
  const int fixed = at.nx() - (problem.model == Model::wrench ? 0 : at.angle());
  t.x[0].tail(fixed) = problem.start.tail(fixed);
  for (int l = 0; l < at.end_effector_count(); ++l) {
    for (int k = 0; k <= n; ++k) {
      if (sequence[k][l] == kFree) continue;
      // Phases first..k are one contact; it holds the knots first..last_knot.
      const int first = k, surface = sequence[k][l];
      while (k < n && sequence[k + 1][l] == surface) ++k;
      const int last_knot = std::min(k + 1, n);
      Vector3d foothold = t.x[first].segment<3>(at.end(l));
      if (first > 0) {
        foothold.setZero();
        for (int j = first; j <= last_knot; ++j) foothold += t.x[j].segment<3>(at.end(l));
        foothold = problem.polygons[surface].nearest(foothold / (last_knot - first + 1));
      }
      for (int j = first; j <= last_knot; ++j) t.x[j].segment<3>(at.end(l)) = foothold;
    }
    for (int k = 0; k < n; ++k)
      t.u[k].segment<3>(at.stride(l)) = t.x[k + 1].segment<3>(at.end(l)) - t.x[k].segment<3>(at.end(l));
  }
}

}  // namespace mcplan::ddp
