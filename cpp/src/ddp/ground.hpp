#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/polygon.hpp"
#include "mcplan/scene/scene.hpp"

namespace mcplan::ddp {

/// Where a robot can be on foot, seen from above: at one height, with the ground below it or near enough.
struct Place {
  double height = 0.0;     ///< [m] of the ground
  double looseness = 0.0;  ///< level distance of the feet from ground, on average: 0 on it, 1 as far as may be
  int surface = -1;        ///< of the scene, that the ground belongs to
  int solid = -1;          ///< of the scene, one that stands where the trunk would be, or -1
  bool tight = false;      ///< a solid is so near that the robot could not turn on the spot
};

/// The ground that the feet can touch, those end-effectors that stand at both start and goal, and the solids that stand
/// on it. All lengths in metres, in the world.
class Ground {
 public:
  /// `sole_inside`: Options::sole_inside. Steps are at most so high, as a ratio of what the robot can make.
  Ground(const Scene& scene, const Robot& robot, const ResolvedStance& from, const ResolvedStance& to,
         double sole_inside, double rise_ratio = 1.0);

  bool has_feet() const { return !feet_.empty(); }

  /// The places with the CoM above this point, highest first: those heights of surfaces within gap() of it at which
  /// every foot, in its nominal place, finds one within gap() as well. `room`: how near solids may be, over what a walk
  /// keeps from them.
  std::vector<Place> places(const Eigen::Vector2d& at, double room = 1.0) const;

  double stride() const { return stride_; }  ///< the longest step of all feet
  double rise() const { return rise_; }      ///< and the highest one
  /// Level distance from this point to the farthest corner of what holds the feet.
  double extent(const Eigen::Vector2d& from) const;
  double gap() const;  ///< how far from ground a foot may be in its nominal place

 private:
  struct Patch {
    Polygon polygon;
    Eigen::AlignedBox3d box;
    int surface;
  };
  struct Footing {
    double away = 0.0, height = 0.0;
  };
  Footing footing(const Patch& patch, const Eigen::Vector2d& at) const;
  /// Where the trunk would be: heights above the ground, and so near to the CoM's axis.
  struct Layer {
    double low = 0.0, high = 0.0, within = 0.0;
  };
  int solid_at(const Eigen::Vector2d& at, double height, const Layer& layer) const;

  std::vector<int> feet_;                   // of the robot
  std::vector<Eigen::Vector2d> nominal_;    // from the CoM in the heading of the walk; where it changes, the CoM's
  double stride_ = 0.0, rise_ = 0.0;        // the least of all feet
  double inside_ = 0.0;                     // how far soles stay inside of their surface
  double half_width_ = 0.0, height_ = 0.0;  // of the trunk and the feet beside it
  std::vector<Layer> layers_;               // the first up to above the CoM, then those of the parts of the trunk
  Layer arms_;                              // of hands that hang, beside which there is little room
  double radius_ = 0.0;                     // about the CoM, of all of the feet
  std::vector<Patch> patches_;              // surfaces that hold the feet
  struct Standing {
    Polygon polygon;
    double thickness;
    Eigen::AlignedBox3d box;
    int surface;
  };
  std::vector<Standing> solids_;  // what may stand in the way
};

}  // namespace mcplan::ddp
