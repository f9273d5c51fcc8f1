#pragma once

#include "mcplan/scene/scene.hpp"

namespace mcplan {

constexpr double walkable = 0.5;  ///< z of the normal of ground

/// Length of the diagonal of the box around all surfaces [m].
double scene_size(const Scene& scene);

}  // namespace mcplan
