#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "mcplan/nlp/problem.hpp"
#include "mcplan/rhp/pieces/contact_point.hpp"
#include "mcplan/rhp/walker.hpp"

namespace mcplan::rhp {

/// The nonlinear program of one cycle, and where its variables are. Positions in it are relative to shift_W, so that the
/// numbers do not grow with the distance walked.
struct Horizon {
  /// An instant of the states; -1: not a variable.
  struct Node {
    int com = -1, velocity = -1, momentum = -1;
  };
  /// An instant of the forces. A node between two phases has two under linear forces: before and after.
  struct Control {
    int node = 0;
    int acceleration = -1, rate = -1;
    std::vector<ContactPoint> points;  ///< of the feet in contact, foot by foot
    std::vector<int> psi;              ///< first of six variables for each point, where psi is lifted
  };
  struct Phase {
    int step = 0;
    int swing = -1;                 ///< foot in the air, or -1
    bool centroidal = true;         ///< else one of the reduced models
    bool single_force = false;      ///< one force a foot, at its centre
    int duration = -1;              ///< variable
    std::array<int, 2> placements{-1, -1};  ///< of each foot, -1 in the air
    int first_node = 0, first_control = 0, control_count = 0;
  };

  nlp::Problem problem;
  Eigen::Vector3d shift_W = Eigen::Vector3d::Zero();
  std::vector<Placement> placements;  ///< of the feet at the start, then one for each step
  std::vector<Node> nodes;
  std::vector<Control> controls;
  std::vector<Phase> phases;  ///< three for each step
  int steps = 0;

  Eigen::Vector3d position_W(const Eigen::VectorXd& x, int placement) const;  ///< of a foot's centre
};

/// Build the program of `steps` steps from `state` on, the first of them footsteps[first].
///
/// footholds_W: for each step a point of its surface from which its foothold is measured, the guess. `rest`: the CoM
/// stands still at the end, the last step being the last of the walk.
Horizon build_horizon(const Walker& walker, const State& state, const Footsteps& footsteps, int first, int steps,
                      const std::vector<Eigen::Vector3d>& footholds_W, bool rest);

}  // namespace mcplan::rhp
