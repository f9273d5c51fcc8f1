#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mcplan/plan/plan.hpp"
#include "mcplan/rhp/options.hpp"
#include "mcplan/rhp/receding_horizon.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/polygon.hpp"
#include "mcplan/scene/scene.hpp"

namespace mcplan::rhp {

/// One step: the foot (0 or 1) that swings and the surface on which it lands.
struct Footstep {
  int foot = 0;
  int surface = -1;
};

/// The order of steps. Either it ends, or the feet go on in turn on the surface of the last one.
class Footsteps {
 public:
  Footsteps() = default;
  Footsteps(std::vector<Footstep> steps, bool ends) : steps_(std::move(steps)), ends_(ends) {}

  bool ends() const { return ends_; }
  int count() const { return static_cast<int>(steps_.size()); }

  /// Step i; only below count() if it ends.
  Footstep operator[](int i) const;

 private:
  std::vector<Footstep> steps_;
  bool ends_ = false;
};

/// A foot, its reach in world axes.
struct Foot {
  int end_effector = 0;  ///< index into robot.end_effectors
  Eigen::Vector2d half_size = Eigen::Vector2d::Zero();
  double max_force = 0.0;    ///< [N]
  Polytope com_reach_W;      ///< CoM relative to this foot
  Polytope partner_reach_W;  ///< the other foot relative to this one
};

/// A scene and a robot made ready: what stays the same from cycle to cycle.
struct Walker {
  /// Throws InvalidScene, InvalidRobot or InvalidOptions; robots need exactly two end-effectors of kind "foot".
  Walker(const Scene& scene, const Robot& robot, const Options& options);

  Scene scene;
  Robot robot;
  Options options;
  Eigen::Matrix3d r_WH;  ///< heading frame: turned by scene.start.yaw
  std::array<Foot, 2> feet;
  std::vector<Polygon> surfaces;
  Range com_height_m;  ///< of the CoM over a foot in contact
  Eigen::Vector3d goal_com_W;

  /// Frame of a foot on a surface: columns t1 (the heading projected on it), t2, n.
  Eigen::Matrix3d frame_W(int surface) const;

  /// The point of the surface nearest to `desired_W` at which the whole sole of the foot fits, by repeated projection;
  /// on a surface too small for the sole, where it sticks out least.
  Eigen::Vector3d nearest_foothold_W(int foot, int surface, const Eigen::Vector3d& desired_W) const;

  /// Half size of the sole with foothold_margin_m around it, or with a half, a quarter or nothing of that where a
  /// surface is too small, or margin_ratios say so.
  Eigen::Vector2d taken_size(int foot, int surface) const;

  /// Ratios of foothold_margin_m that are tried one after another.
  static constexpr std::array<double, 4> kMarginRatios{1.0, 0.5, 0.25, 0.0};

  /// Ratio that is kept, by foot and surface, where it is below 1.
  using MarginRatios = std::map<std::pair<int, int>, double>;
  MarginRatios margin_ratios;
  void limit_margin(int foot, int surface, double ratio);  ///< to this ratio, if it is larger now

  int foot_of(int end_effector) const;  ///< 0, 1, or -1
  State start() const;                  ///< at the scene's start
};

/// Throws InvalidInput where a measured state is no state of the walker.
void require_state(const Walker& walker, const State& state);

/// The steps that the scene lists. Throws InvalidScene where there are none, or one names no foot of the robot or a
/// surface that this foot may not touch.
Footsteps footsteps_of(const Walker& walker);

/// The touch-downs of a plan, in their order. Throws InvalidPlan where both feet are off the ground, another
/// end-effector is in contact, or a surface does not exist in the walker's scene.
Footsteps footsteps_of(const Walker& walker, const Plan& plan);

/// Where a plan starts.
State start_of(const Walker& walker, const Plan& plan);

}  // namespace mcplan::rhp
