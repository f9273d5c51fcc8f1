#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "mcplan/planar/sip/options.hpp"
#include "mcplan/planar/task.hpp"
#include "planar/sip/contact_gain.hpp"
#include "planar/sip/layout.hpp"
#include "planar/sip/taylor_graph.hpp"

namespace mcplan::sip {

/// Motion and forces of the robot over one interval as Taylor polynomials of the interval's parameters: everything that
/// constraints and costs are made of. Positions are relative to `origin_W`, the mean of the phase's expected contact
/// points, about which moments are taken too.
///
/// Derivatives in time are derivatives in s times powers of 2/h, which are nodes of order 0.
struct IntervalMotion {
  using Node = TaylorGraph::Node;

  struct Point {
    Node x, y;
  };
  struct Body {
    Node angle;         ///< in the world, cubic
    Node sine, cosine;  ///< of it
    Point joint, com;   ///< [m]
  };
  struct Contact {
    Point error;              ///< actual minus expected position [m]
    Node angle_error;         ///< [rad]
    bool free = true;         ///< not zero by construction
    std::vector<int> forces;  ///< indices into `forces`, point by point
  };
  struct Force {
    int contact = 0;
    Node tangential, normal;  ///< [N]
  };

  IntervalMotion(const PlanarTask& task, const Options& options, const Layout& layout, int interval);

  /// Inputs of the graph at these parameters (local.count()); with derivatives their first and second ones too.
  void set_parameters(const Eigen::Ref<const Eigen::VectorXd>& x, bool derivatives);

  /// A point of a body, relative to origin_W.
  Point point(int body, const Eigen::Vector2d& point_B);

  /// A node times the k-th power of 2/h: the k-th derivative in time of one that is the k-th derivative in s.
  Node timed(Node node, int power);

  const PlanarTask& task;
  const Options& options;
  LocalParameters local;
  TaylorGraph graph;
  Eigen::Vector2d origin_W;

  std::vector<Node> joints;  ///< positions [rad], cubic
  std::vector<Body> bodies;
  std::vector<Contact> contacts;
  std::vector<Force> forces;
  std::array<Node, 3> balance{};  ///< [m (a - g); moment] minus what the forces give, where they are parameters
  std::vector<Node> torques;      ///< [N m]; with dynamics
  Node half_length;               ///< h / 2 [s]

 private:
  /// An input c T^e of the phase's duration T.
  struct Power {
    Node node;
    double factor;
    int exponent;
  };

  struct Subtree;

  bool base_computed() const { return options.free_flyer == FreeFlyer::computed; }

  void add_inputs(const Layout& layout);
  void add_angles();
  void add_base();
  void add_contact_errors();
  void add_forces(const std::array<Node, 3>& demand);
  void add_dynamics();
  std::vector<Subtree> inertial_subtrees();
  std::array<Node, 3> demand_of(const Subtree& subtree);
  void add_contact_wrenches(std::vector<Subtree>& tree);
  void add_torques(std::vector<Subtree>& tree);
  void set_splines(const Eigen::Ref<const Eigen::VectorXd>& x, bool derivatives);
  Node linear_in(const std::vector<TaylorGraph::Term>& terms, double constant = 0.0) {
    return graph.linear(terms, constant);
  }

  std::vector<Node> splines_;                    ///< inputs: joints, then the base's
  std::vector<Power> powers_;                    ///< h/2, then (2/h)^k
  std::vector<Node> force_inputs_;               ///< of given forces: tangential and normal, point by point
  std::optional<ContactGain> gain_;              ///< where forces are computed
  std::vector<std::array<Node, 3>> gain_nodes_;  ///< by row of the gain; where it has parameters
};

}  // namespace mcplan::sip
