#pragma once

#include <vector>

#include "mcplan/plan/plan.hpp"
#include "scene/joined_surfaces.hpp"

namespace mcplan::ddp {

/// A scene whose surfaces are in pieces, and the same with whole ones, on which is planned: soles may stand across
/// pieces, and a search has fewer surfaces to choose from. Plans name the pieces.
class JoinedGround {
 public:
  /// Keeps a reference to the scene.
  explicit JoinedGround(const Scene& pieces) : pieces_(&pieces), joined_(join_surfaces(pieces)) {}

  bool any() const { return joined_.any(); }
  const Scene& scene() const { return joined_.scene; }

  /// Whether a plan's surfaces are those of the scene in pieces.
  bool fits(const Plan& plan) const;

  /// By end-effector and phase, of the scene in pieces.
  void join(std::vector<int>& contacts) const;
  Plan join(Plan plan) const;

  /// Each contact on the piece on which the middle of the end-effector is, from touchdown to lift-off; at the start and
  /// the goal on the one that their stances name.
  Plan take_apart(Plan plan) const;
  void take_apart(std::vector<int>& contacts) const;  ///< on the first of its pieces

 private:
  int piece_at(int surface, const Eigen::Vector3d& place_W, int named) const;

  const Scene* pieces_;
  JoinedSurfaces joined_;
};

}  // namespace mcplan::ddp
