#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "mcplan/base/deadline.hpp"
#include "mcplan/base/logging.hpp"

namespace mcplan {
class Plan;
}

namespace mcplan::ddp {

/// Receives what a search has, in SI units and as it is: contacts are not met exactly yet, nothing is checked.
using PlanWatch = std::function<void(const Plan&)>;

/// Which search runs.
enum class Method {
  standard,  ///< ours: proximal switched DDP with merit acceptance, low-rank pricing, whole-sequence moves, polish
  paper,     ///< Tazaki's Algorithms 1 and 2 as published
};

/// What a contact can do.
enum class Model {
  wrench,  ///< forces act within the sole and need not point at the CoM: angular momentum, turning, friction as it is
  lipm,    ///< the paper's: every force acts at its end-effector and points at the CoM, the base barely turns
};

/// What finds the motion of a contact sequence that is given.
enum class Polish {
  penalty,         ///< Gauss-Newton on the cost with contacts and limits as weights, by a merit function
  interior_point,  ///< contacts exact, limits by an elastic barrier, by a filter
};

/// How the contact stiffness enters as an input.
enum class StiffnessInput {
  mu,  ///< mu = lambda^2 >= 0: contact forces are linear in it, so a free end-effector can see what contact would give
  lambda,  ///< the paper's lambda; its derivative vanishes at lambda = 0
};

/// Weights w of the cost terms 1/2 w^2 e^2 (Tazaki, Table I). They apply to non-dimensional quantities: lengths in
/// units of the CoM height, time in sqrt(height / gravity), mass 1. `_end` holds at the first and the last knot.
struct Weights {
  double com = 0.1, com_end = 100.0;                     ///< w_p
  double velocity = 1.0, velocity_end = 100.0;           ///< w_v
  double rotation = 100.0, rotation_end = 100.0;         ///< w_theta, w_omega; inside, of Model::lipm alone
  double angle = 1.0;                                    ///< on the base's angles inside, of Model::wrench
  double momentum = 0.3;                                 ///< on the angular momentum inside, likewise
  double center_of_pressure = 0.5;                       ///< on c_l, from the end-effector to where its force acts
  double force_line = 0.3;                               ///< on r_l, from there to the line that points at the CoM
  double end_effector = 0.01, end_effector_end = 100.0;  ///< w_p,l: not in Table I; the value of the author's program
  double stride = 0.01;                                  ///< on the end-effector's travel within a phase, likewise
  double stiffness = 0.01;                               ///< w_lambda
  double moment = 0.01;                                  ///< w_tau
  double limit = 100.0;                                  ///< w_lim: reach, stiffness, moment, force, friction, duration
  double duration = 0.1;                                 ///< towards the middle of the duration box
  double contact_min = 0.01, contact_max = 100.0;        ///< w_compl
  double contact_growth = 2.0;                           ///< gamma
  double overshoot_factor = 2.0;                         ///< on leaving a finite polygon sideways, times w_compl

  /// Weights that belong to one term alone, by its name, where they are not the term's usual ones: "flight",
  /// "contact_change" (docs/theory/ddp.md, "Costs").
  std::map<std::string, double, std::less<>> own;
};

/// Options of the contact-sequence search. Defaults serve all built-in scenes.
struct Options {
  int phases = 0;  ///< N; 0: as many as footsteps take, or 18 as in the paper, or more where the way asks for more
  Method method = Method::standard;
  Model model = Model::wrench;  ///< Method::paper always takes Model::lipm
  StiffnessInput stiffness_input = StiffnessInput::mu;
  Polish polish = Polish::interior_point;  ///< Method::paper has none
  Weights weights;

  double duration_min_s = 0.0, duration_max_s = 0.0;  ///< soft box of the phase durations; 0: the robot's
  double flight_duration_min_s = 0.40;  ///< lower bound of phases without any contact (the paper's for all)
  double duration_initial_s = 0.0;      ///< first guess of all phases; 0: the middle of their box, 0.45 for Model::lipm
  double proximal_weight = 30.0;        ///< first weight on the change of the inputs; adapts
  int interior_points = 4;              ///< instants inside each phase at which reach, force and friction are held
  double reach_margin_m = 0.003;        ///< the reach box is planned smaller by this
  double sole_inside = -1.0;            ///< ratio of a sole that footholds keep on their surface; negative: the robot's
  bool friction = true;                 ///< hold the friction cones
  bool joint_limits = true;      ///< hold the limb limits that the robot has; without, it is planned as if it had none
  double friction_ratio = -1.0;  ///< of the friction that plans use; negative: 0.8 on tracked point feet, else 1
  double load_ratio = -1.0;      ///< least load of tracked point feet over an equal share of the weight; negative: 0.3
  int friction_sides = 0;        ///< of the pyramid inside the cone that is held instead of it; 0: the cone itself
  bool whole_sequence_moves = true;  ///< dynamic programming over (step, contact state) where it pays
  bool stepping_guesses = true;      ///< first guesses with end-effectors that step in turn, beside those of the search
  bool allow_flight = true;          ///< phases without any contact; where steps lead to the goal, they come last
  int min_contacts = -1;             ///< at any time; negative: two for robots on four feet where that will do, or none
  bool detours = true;               ///< ways round what steps cannot cross, beside the straight one
  bool one_switch_per_step = true;   ///< Tazaki's eq. (32)
  int restarts = 3;                  ///< further attempts from other settings while the checker rejects the plan

  int max_iterations = 5000;  ///< over all attempts; to mend a near miss a tenth more
  double time_limit_s = std::numeric_limits<double>::infinity();  ///< wall clock
  int threads = 1;         ///< for ways, first guesses, changed sequences, pricing; the result does not depend on it
  std::uint64_t seed = 0;  ///< of the order in which restarts vary the settings

  std::vector<std::vector<int>>
      initial_sequence;  ///< phases+1 rows (or empty): surface index per end-effector, -1 free

  bool record_history = false;  ///< keep the contact sequence of every iteration in the report
  Logger logger;                ///< iteration table and decisions, line by line; null: silent
  PlanWatch watch;              ///< every iterate of a search but those of the interior point; by the caller's thread
  StopRequest stop;             ///< polled every iteration; null: never
  Clock clock;                  ///< what time_limit_s is measured by; null: the steady clock

  /// The model that is in force.
  Model effective_model() const { return method == Method::paper ? Model::lipm : model; }

  /// Throws InvalidOptions naming all that is out of its range.
  void validate() const;
};

}  // namespace mcplan::ddp
