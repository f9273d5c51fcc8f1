#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <set>
#include <tuple>
#include <vector>

#include "mcplan/nlp/problem.hpp"
#include "rhp/pieces/contact_point.hpp"
#include "rhp/pieces/linear_force_step.hpp"
#include "rhp/walker.hpp"

namespace mcplan::rhp {

/// A face of com_reach at a node for a foot in contact.
struct ReachRow {
  int node = 0, placement = 0, row = 0;

  bool operator<(const ReachRow& other) const {
    return std::tie(node, placement, row) < std::tie(other.node, other.placement, other.row);
  }
};

/// The nonlinear program of one cycle, and where its variables are. Positions in it are relative to shift_W, so that
/// the numbers do not grow with the distance walked.
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
    int swing = -1;                         ///< foot in the air, or -1
    bool centroidal = true;                 ///< else one of the reduced models
    bool single_force = false;              ///< one force a foot, at its centre
    int duration = -1;                      ///< variable
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
  Eigen::VectorXd guess;
  std::vector<ReachRow> left_out;

  Eigen::Vector3d position_W(const Eigen::VectorXd& x, int placement) const;  ///< of a foot's centre

  /// Interval k of a phase, under linear forces; a phase has `intervals`.
  LinearForceInterval interval(const Phase& phase, int k, int intervals) const;
};

/// What a horizon is built from.
struct HorizonRequest {
  State state;                               ///< at its start
  int first = 0, steps = 0;                  ///< from footsteps[first] on
  std::vector<Eigen::Vector3d> footholds_W;  ///< a point of each step's surface from which its foothold is measured
  bool rest = false;  ///< the CoM stands still at the end, the last step being the last of the walk
  std::function<Eigen::VectorXd(const Horizon&)> guess;  ///< called once all variables exist
  std::set<ReachRow> reach_rows;                         ///< not to be left out, whatever the guess
};

/// Build the program. Faces of com_reach from which the guess stays kReachMargin_m away are left out (unless
/// options.all_faces): most of the rows, none of which is ever active. The caller checks the solution against them.
Horizon build_horizon(const Walker& walker, const Footsteps& footsteps, const HorizonRequest& request);

/// The face left out that x violates most.
nlp::Problem::Worst worst_left_out(const Walker& walker, const Horizon& horizon, const Eigen::VectorXd& x);

/// Faces left out that x violates by more than tolerance [m].
std::set<ReachRow> violated_reach(const Walker& walker, const Horizon& horizon, const Eigen::VectorXd& x,
                                  double tolerance);

}  // namespace mcplan::rhp
