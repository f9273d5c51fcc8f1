#pragma once

#include <vector>

#include "ddp/layout.hpp"
#include "ddp/problem.hpp"
#include "mcplan/scene/polygon.hpp"

namespace mcplan::ddp {

/// The layout of Model::wrench. `surfaces`: those that each end-effector may touch.
Layout wrench_layout(const std::vector<EndLimits>& limits, const std::vector<Polygon>& polygons,
                     const std::vector<std::vector<int>>& surfaces);

/// The layout of the paper's model: axes that no moment drives are left out, unless `all_axes`.
Layout lipm_layout(const std::vector<EndLimits>& limits, bool all_axes);

}  // namespace mcplan::ddp
