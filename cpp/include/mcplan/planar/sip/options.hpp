#pragma once

#include <limits>

#include "mcplan/base/deadline.hpp"
#include "mcplan/base/logging.hpp"
#include "mcplan/base/range.hpp"
#include "mcplan/nlp/solver.hpp"

namespace mcplan::sip {

/// Where contact forces come from (Lengagne et al., secs. III-C and IV-D).
enum class Forces {
  uniform,     ///< weighted least norm, all weights 1: case 1
  per_body,    ///< one weight for each contact of a phase, a parameter: case 2
  per_point,   ///< one weight for each point of a contact, a parameter: case 3
  parameters,  ///< cubic polynomials of time over each interval, balance as constraints
};

/// How an end-effector in contact is held where it should be.
enum class ContactMode {
  tube,    ///< position and angle stay within a tube at every instant
  band,    ///< polynomial coefficients 0..neq of position and angle within a band
  strict,  ///< the same coefficients zero; one contact of a phase left out, whose error is that of the others
};

/// How an inequality is kept at every instant of an interval.
enum class Continuous {
  hull,      ///< every Bernstein coefficient within the limits: sufficient, smooth
  extremum,  ///< the polynomial's extrema within the limits: exact, not smooth
  grid,      ///< at grid_points instants, the classical method: nothing is said about the time between
};

/// The trajectory of the base.
enum class FreeFlyer {
  computed,       ///< from the joints (eqs. 9-12)
  parameterised,  ///< three more splines (Table I)
};

/// Where second derivatives come from.
enum class HessianChoice {
  automatic,       ///< as suits the problem, and another one where that fails
  exact,           ///< of cost and constraints
  gauss_newton,    ///< of the cost alone, without its curvature
  limited_memory,  ///< L-BFGS
};

using mcplan::Range;

/// Options of the semi-infinite planner.
struct Options {
  Forces forces = Forces::per_point;
  double torque_weight = 1.0;         ///< cost: integral of the squared torques [1/(N m)^2 s]
  double duration_weight = 0.0;       ///< cost: duration [1/s]
  double jerk_weight = 0.0;           ///< cost: integral of the squared joint jerks [s^5]
  bool free_durations = true;         ///< a duration for each phase; else one for the motion, shared by intervals
  Range total_duration_s{1.0, 20.0};  ///< where free_durations is off
  Range phase_duration_s{0.2, 5.0};   ///< where it is on; the task's own limits hold as well

  ContactMode contact = ContactMode::tube;
  double tube_m = 1e-3;    ///< half width of the tube or of the band [m]
  double tube_rad = 5e-3;  ///< [rad]
  int neq = 2;             ///< highest coefficient of band and strict, 0..order

  Continuous continuous = Continuous::hull;
  int grid_points = 10;  ///< per interval, both ends included
  int order = 8;         ///< of the Taylor polynomials, 3..12
  FreeFlyer free_flyer = FreeFlyer::computed;

  bool dynamics = true;           ///< contact forces in their cones; off: kinematics alone (Tables I and II)
  bool torque_limits = true;      ///< Table III has none
  bool clearance = true;          ///< swinging end-effectors outside of all solids
  bool self_collision = false;    ///< of the robot's collision pairs
  double clearance_m = -1e-3;     ///< least height of swinging points: at lift-off they are at zero to the tube
  double min_normal_force = 0.0;  ///< at every point [N]
  double margin = 0.0;            ///< kept to joint, torque and force limits, relative
  double log_weight_max = 5.0;    ///< bound of the logarithms of weights

  bool kinematics_first = true;  ///< with dynamics: find contacts and joints within limits first, forces from there
  bool feasible_first = true;    ///< with a cost: solve without it first, and start from that
  nlp::Solver solver = nlp::Solver::ipopt;
  HessianChoice hessian = HessianChoice::automatic;
  double tolerance = 1e-4, constraint_tolerance = 1e-5;           ///< of the solver
  int max_iterations = 1000;                                      ///< of each of its runs
  double time_limit_s = std::numeric_limits<double>::infinity();  ///< wall clock, of the whole solve

  Logger logger;     ///< a line an iteration; null: silent
  StopRequest stop;  ///< polled every iteration; null: never
  Clock clock;       ///< what time_limit_s is measured by; null: the steady clock

  /// Whether there is anything to minimise: torques are known with dynamics only.
  bool has_cost() const { return (dynamics && torque_weight > 0.0) || duration_weight > 0.0 || jerk_weight > 0.0; }

  /// Throws InvalidOptions naming all that is out of its range.
  void validate() const;
};

}  // namespace mcplan::sip
