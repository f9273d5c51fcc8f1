#pragma once

#include <set>
#include <vector>

#include "mcplan/plan/plan.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/scene.hpp"

namespace mcplan::ddp {

/// How much of a scene a search looks at. Few surfaces of a large scene lie near the way, and each one that is looked
/// at costs set-up, prices and memory; so a search begins with the nearest, and is repeated with more of them when no
/// plan comes out of it. The last one looks at all: no scene is made unsolvable.
struct Outlook {
  double reach = 0.0;   ///< surfaces further than this many reaches of the robot from the way are set aside; 0: none
  int nearest = 0;      ///< a contact is looked for among this many surfaces nearest to where it is due; 0: all
  double within = 0.0;  ///< of which those nearer than so many diagonals of its reach; 0: all
};
constexpr int kOutlooks = 3;
Outlook outlook(int level);  ///< level 0: the nearest, kOutlooks - 1: all surfaces

/// Length by which an end-effector may lie beside the way from start to goal [m]: the longest diagonal of a reach box,
/// and a CoM height for the CoM that swings out.
double reach_of(const Robot& robot);

/// Surfaces, by index and in order, whose solid, taken as a ball, lies within `distance` [m] of the straight way of an
/// end-effector, or that are in `needed`. `from` and `to`: end-effectors at start and goal [m], by end-effector.
std::vector<int> surfaces_near_way(const Scene& scene, const std::vector<Eigen::Vector3d>& from,
                                   const std::vector<Eigen::Vector3d>& to, double distance,
                                   const std::set<int>& needed);

/// The scene with these surfaces alone, and without the steps of a walk that is planned elsewhere.
Scene part_of(const Scene& scene, const std::vector<int>& surfaces);

/// A plan on part_of(scene, surfaces), as one on the scene: its contacts name the scene's surfaces.
void put_back(Plan& plan, const Scene& scene, const std::vector<int>& surfaces);

}  // namespace mcplan::ddp
