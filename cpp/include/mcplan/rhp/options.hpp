#pragma once

#include <cstdint>
#include <limits>

#include "mcplan/base/deadline.hpp"
#include "mcplan/base/logging.hpp"
#include "mcplan/base/range.hpp"
#include "mcplan/nlp/solver.hpp"

namespace mcplan::rhp {

/// Model of the steps that are predicted but not executed (Wang et al., sec. IV). The executed step always has the
/// full centroidal dynamics.
enum class Fidelity {
  single,     ///< centroidal dynamics, free timing: the baseline
  com,        ///< candidate 1: linear CoM dynamics, no angular momentum
  rectangle,  ///< candidate 2: convex relaxation of the angular momentum's rate, four corner forces per foot
  point,      ///< candidate 3: the same with one force per foot
};

/// How the continuous motion becomes algebraic equations.
enum class Transcription {
  trapezoidal,  ///< forces linear between nodes, CoM and angular momentum integrated exactly
  euler,        ///< the paper's forward Euler; a replay of its forces drifts by centimetres a step
};

using mcplan::Range;

/// The paper's absolute box of the CoM's height, and how far its terrains go above and below zero [m].
inline constexpr Range kPaperComHeight{0.7, 0.8};
inline constexpr double kPaperTerrain_m = 0.06;

/// Options of the receding-horizon planner. Where numbers are not in the paper they come from its authors' published
/// research code; docs/theory/rhp.md lists them.
struct Options {
  Fidelity fidelity = Fidelity::point;
  int lookahead = 3;  ///< steps in the horizon, 1..10: one executed, the others predicted
  int cycles = 14;    ///< steps to execute
  Transcription transcription = Transcription::trapezoidal;
  bool paper = false;          ///< absolute CoM box, outer friction pyramid, no rest at the end, all as published
  bool lifted_psi = false;     ///< keep the bounds psi of the relaxation as variables instead of eliminating them
  bool friction_rows = false;  ///< friction pyramids with faces across t1 and t2, instead of edges along them
  bool all_faces = false;      ///< keep faces of the reach polytopes that others imply

  int intervals = 7;                 ///< per phase
  Range double_support_s{0.1, 0.3};  ///< duration of a phase on two feet
  Range single_support_s{0.8, 1.2};  ///< duration of a phase on one foot
  double landing_s = 0.0;            ///< by which a horizon's first phase may last longer: what is left of a landing
  double predicted_double_support_s = 0.2;  ///< fixed durations of predicted phases of the reduced models
  double predicted_single_support_s = 0.6;
  double com_velocity_max = 1.5;   ///< [m/s] each component
  double momentum_max = 2.5;       ///< [kg m^2/s] each component of L
  double momentum_rate_max = 3.5;  ///< [N m] each component of L'
  Range com_height{0.87, 1.15};    ///< of the CoM above every foot in contact, over robot.com_height [-]
  double sole_ratio = 0.80;     ///< of the sole that forces make use of, `paper`: all; the rest is for those who track
  double friction_ratio = 1.0;  ///< of the friction coefficient, likewise: less for ground that may be slippery
  double foothold_margin_m = 0.03;  ///< of the sole to the edges of a surface where it has room, for swings to clear
  double psi_max = 0.55;            ///< bound of the relaxation's |a +- d|^2 [-]
  double goal_weight = 10.0;        ///< on the squared distance of the horizon's end to the goal [1/m^2]
  int friction_sides = 8;           ///< of the inner friction pyramid; `paper` takes the outer one of 4

  double tolerance = 1e-5, constraint_tolerance = 1e-6;           ///< of the solver
  int max_iterations = 400;                                       ///< of a cycle
  double time_limit_s = std::numeric_limits<double>::infinity();  ///< of a cycle, wall clock
  nlp::Solver solver = nlp::Solver::automatic;
  bool automatic_ordering = false;  ///< Ipopt's linear solver's own choice of pivot order, slower here than AMD

  Logger logger;     ///< a line a cycle; null: silent
  StopRequest stop;  ///< polled every iteration; null: never
  Clock clock;       ///< what time_limit_s is measured by; null: the steady clock

  /// Throws InvalidOptions naming all that is out of its range.
  void validate() const;
};

}  // namespace mcplan::rhp
