#pragma once

#include <vector>

#include "mcplan/scene/scene.hpp"

namespace mcplan {

/// A scene in which surfaces are one that are pieces of one: a floor of tiles, the convex pieces of a segmented plane.
struct JoinedSurfaces {
  Scene scene;             ///< the joined ones have the name of their first piece; stances and steps name them
  std::vector<int> index;  ///< in it, of each surface of the given scene

  bool any() const { return scene.surfaces.size() < index.size(); }
};

/// Join surfaces in one plane, within 0.1 mm, that touch or overlap, as long as what comes out is convex: nothing is
/// ground that was not, but for slits of 2 mm. They have friction, thickness and end-effectors in common; what may be
/// held is left as it is. The others stay as they are, in order.
JoinedSurfaces join_surfaces(const Scene& given);

}  // namespace mcplan
