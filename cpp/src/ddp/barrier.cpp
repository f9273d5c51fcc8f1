#include "ddp/barrier.hpp"

#include <cmath>

#include "mcplan/base/error.hpp"
#include "mcplan/scene/polygon.hpp"
#include "model/text.hpp"
#include "plan/solid_box.hpp"

namespace mcplan::ddp {

std::string text_of(const Barrier& barrier, const Scene& scene, const std::string& robot_name) {
  const auto metres = [](double value) { return model::digits(value, "%.3g") + " m"; };
  const auto name = [&](int surface) { return text(scene.surfaces[surface].name); };
  const std::string robot_steps = ", and no way round it was found: without hands or a jump a level " + robot_name +
                                  " puts no foot more than " + metres(barrier.step) + " above the other";
  if (barrier.solid >= 0) {
    const Surface& solid = scene.surfaces[barrier.solid];
    const Eigen::AlignedBox3d box = box_of({Polygon(solid.vertices_W), solid.thickness});
    const double top = box.max().z() - barrier.height, bottom = box.min().z() - barrier.height;
    if (bottom > barrier.step)
      return name(barrier.solid) + ", " + metres(bottom) + " above " + name(barrier.from) +
             ", leaves no room for the trunk on the way to the goal, and no way round it was found";
    return name(barrier.solid) + " stands " + metres(top) + " above " + name(barrier.from) +
           " across the way to the goal" + robot_steps;
  }
  return "on the way to the goal the ground " + std::string(barrier.rise > 0.0 ? "rises" : "falls") + " by " +
         metres(std::abs(barrier.rise)) + " from " + name(barrier.from) + " to " + name(barrier.to) + robot_steps;
}

}  // namespace mcplan::ddp
