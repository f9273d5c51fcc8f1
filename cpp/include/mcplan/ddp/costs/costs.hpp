#pragma once

#include <Eigen/Core>
#include <vector>

#include "mcplan/ddp/pendulum.hpp"
#include "mcplan/ddp/problem.hpp"
#include "mcplan/ddp/rows.hpp"

/// The cost terms of the search, one function a term, one source file a function. Each writes its rows for one step.
namespace mcplan::ddp {

/// An instant inside a phase: where the CoM and the base are, and how that depends on z = [x, u]. Few instants have a
/// row that is active, so the derivatives are worked out when the first asks for them.
struct Instant {
  double fraction = 0.0;  ///< of the phase
  Eigen::Vector3d com, rpy;

  /// g += (d com/dz)' along_com + (d rpy/dz)' along_rpy. The state and input given to make_instants() must still be
  /// there.
  void add_along(const Eigen::Vector3d& along_com, const Eigen::Vector3d& along_rpy,
                 Eigen::Ref<Eigen::VectorXd> g) const;

  const Pendulum* pendulum = nullptr;
  const Eigen::VectorXd *x = nullptr, *u = nullptr;
  mutable PendulumStep step;
  mutable bool stepped = false;
};

/// Fill `out` with 0, 1/(n+1), ..., 1 of the phase (n interior points). Keeps references to pendulum, x and u.
void make_instants(const Problem& problem, const Pendulum& pendulum, const Eigen::VectorXd& x, const Eigen::VectorXd& u,
                   std::vector<Instant>& out);

// Independent of the contact state. `u` is null at the last knot.

/// Distance to the reference and size of the inputs (Tazaki, sec. III-A, the equation of L_task), as
/// 1/2 w^2 e^2 where the paper writes w^2 e^2: a common factor. With Model::wrench also |c_l|, |r_l| and the angular
/// momentum, which keep it close to the paper's model where that is good enough. Discovery weighs these more: soft ones
/// lead to needless jumps there.
void task_cost(const Problem& problem, int k, const Eigen::VectorXd& x, const Eigen::VectorXd* u, bool discovering,
               Rows& rows);

/// Durations: towards the middle of their box, and inside it (not in the paper, which leaves h unbounded; its author's
/// program has the box).
void duration_cost(const Problem& problem, int k, const Eigen::VectorXd& u, Rows& rows);

/// 0 <= mu_l <= mu_max and |tau_l| <= tau_max (Tazaki, eqs. 17-18).
void bounds_cost(const Problem& problem, const Eigen::VectorXd& u, Rows& rows);

/// p_min <= R(theta)' (p_l - p) <= p_max at the knot, for every end-effector (Tazaki, eqs. 16, 18).
void reach_cost(const Problem& problem, const Eigen::VectorXd& x, Rows& rows);

// Dependent on the contact state of one end-effector: the features that neighbours are priced by. `weight` is w_compl.

/// Contact with a surface (Tazaki, eq. 19, first and second term): on its plane, inside its polygon, not moving.
/// Deviation: eq. (19) uses the infinite plane; a finite polygon adds a row per edge that is overstepped.
void contact_cost(const Problem& problem, const Eigen::VectorXd& x, const Eigen::VectorXd* u, int l, int surface,
                  double weight, Rows& rows);

/// No contact (Tazaki, eq. 19, third term): no stiffness, no moment.
void free_cost(const Problem& problem, const Eigen::VectorXd& u, int l, double weight, Rows& rows);

/// A free end-effector stays out of the solids below the surfaces (at the knots; not in the paper): height above the
/// plane at least 0 where it is inside a polygon's outline and not far below it.
void keep_out_cost(const Problem& problem, const Eigen::VectorXd& x, int l, double weight, Rows& rows);

/// Cost of a phase without any contact, so that the robot jumps where it must and not because it may (not in the paper,
/// where walking with flight phases is a common local optimum). A constant of the contact state.
double flight_cost(const Problem& problem, const ContactState& state);

/// Duration of a phase without any contact: long enough to draw the legs up and land (the paper's lower bound of all
/// phases). Depends on the state as a whole, not on one end-effector.
void flight_duration_cost(const Problem& problem, const Eigen::VectorXd& u, Rows& rows);

/// Whether nothing is in contact.
bool in_flight(const ContactState& state);

/// Cost of the contacts made and broken between two steps, so that the robot takes no step that gains it next to
/// nothing (not in the paper). A constant of the two states; it counts at the full weights only, not in discovery.
double contact_change_cost(const Problem& problem, const ContactState& from, const ContactState& to);

/// The same over a whole sequence.
double contact_change_cost(const Problem& problem, const ContactSequence& sequence);

/// Reach between the knots, for an end-effector in contact (not in the paper, which looks at the knots alone).
void interior_reach_cost(const Problem& problem, const Eigen::VectorXd& x, const std::vector<Instant>& instants, int l,
                         double weight, Rows& rows);

/// Turn of the sole against the base within the end-effector's yaw_range at every instant: yaw_min <= yaw_l - yaw <=
/// yaw_max. Not in the paper.
void sole_turn_cost(const Problem& problem, const std::vector<Instant>& instants, int l, double sole_yaw, double weight,
                    Rows& rows);

/// Centre of pressure c_l inside the sole's rectangle and, as a_l = p_l + c_l, inside the polygon. Without the latter
/// the robot would stand on nothing with the half of a foot that sticks out over an edge. Not in the paper.
void pressure_cost(const Problem& problem, const Eigen::VectorXd& x, const Eigen::VectorXd& u, int l, int surface,
                   double sole_yaw, double contact_weight, Rows& rows);

/// Friction cone: the force points along d = p - s_l, so |d_t| <= mu_friction n.d at every instant, or t_i.d <=
/// mu_friction cos(pi/n) n.d for each side of a pyramid of n sides inside the cone. Stiffness drops out: one row
/// however large the force. Not in the paper.
void friction_cost(const Problem& problem, const Eigen::VectorXd& x, const Eigen::VectorXd& u,
                   const std::vector<Instant>& instants, int l, int surface, double weight, Rows& rows);

/// mu_l |p - s_l| <= f_max at every instant. The paper bounds the stiffness instead.
void force_cap_cost(const Problem& problem, const Pendulum& pendulum, const Eigen::VectorXd& x,
                    const Eigen::VectorXd& u, const std::vector<Instant>& instants, int l, double weight, Rows& rows);

/// What friction under a sole makes of its force: largest moment about the normal per normal force [length], with the
/// sole's half width for a lever. Infinite for moments that nothing bears down on (grasp, points).
double torsion_arm(const Problem& problem, int l, int surface);

/// Whether a moment input is one that a contact with this surface can have: with Model::wrench about its normal alone.
bool about_normal(const Problem& problem, const Layout::Moment& moment, int surface);

/// |tau_l| <= torsion_arm mu_l n.(p - s_l) at every instant: a foot that hardly presses cannot twist. Not in the paper.
void torsion_cost(const Problem& problem, const Pendulum& pendulum, const Eigen::VectorXd& x, const Eigen::VectorXd& u,
                  const std::vector<Instant>& instants, int l, int surface, double weight, Rows& rows);

}  // namespace mcplan::ddp
