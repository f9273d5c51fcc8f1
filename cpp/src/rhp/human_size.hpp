#pragma once

#include "mcplan/rhp/options.hpp"
#include "mcplan/rhp/receding_horizon.hpp"
#include "plan/similar.hpp"
#include "rhp/walker.hpp"

namespace mcplan::rhp {

/// The programs of rhp are in SI, with bounds, costs and tolerances for robots of human size. A robot of another size
/// walks as the paper's does, and everything that comes out is taken back. Those of human size are taken as they are.
class HumanSize {
 public:
  /// Throws InvalidScene, InvalidRobot or InvalidOptions. `Options::paper` has absolute boxes and is not resized.
  HumanSize(const Scene& scene, const Robot& robot, const Options& options);

  /// What the programs are made of. Lengths and durations among the options go with the robot's size at their default
  /// and are meant as they stand otherwise.
  Walker walker() const;

  State to_human(const State& state) const;
  State to_own(const State& state) const;

  /// A plan of the programs as one of the robot on its scene.
  Plan to_own(const Plan& plan) const;

  const Similarity& own() const { return own_; }
  const Scene& scene() const { return scene_; }
  const Robot& robot() const { return robot_; }

 private:
  Scene scene_;
  Robot robot_;
  Options options_;
  Similarity own_, human_;
};

}  // namespace mcplan::rhp
