#include "mcplan/rhp/walk.hpp"

#include "mcplan/robot/standing.hpp"

namespace mcplan::rhp {

Walk walk(const Scene& scene, const Robot& robot, const Options& options) {
  require_standing(scene, robot);
  return RecedingHorizon(scene, robot, options).walk();
}

}  // namespace mcplan::rhp
