#pragma once

#include <vector>

#include "mcplan/scene/polygon.hpp"

namespace mcplan::ddp {

/// Ground that is higher than the edge of a surface beside it: a wall for a foot that stands there, whose heel and
/// shank reach further than its sole.
class Walls {
 public:
  /// Keeps references. `unit`: the length of a metre for a robot of a person's size.
  Walls(const std::vector<Polygon>& polygons, const std::vector<double>& thickness, double unit);

  /// Height of the highest one beyond an edge of a surface; 0: there is none.
  double beyond(int surface, int edge) const;

 private:
  const std::vector<Polygon>* polygons_;
  const std::vector<double>* thickness_;
  double unit_;
  std::vector<std::vector<int>> higher_beside_;  ///< by surface, those near it that rise above its lowest edge
};

}  // namespace mcplan::ddp
