#include "mcplan/rhp/walk.hpp"

namespace mcplan::rhp {

Walk walk(const Scene& scene, const Robot& robot, const Options& options) {
  return RecedingHorizon(scene, robot, options).walk();
}

}  // namespace mcplan::rhp
