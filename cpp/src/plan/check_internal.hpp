#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "mcplan/plan/checker.hpp"
#include "phase_state.hpp"
#include "plan/clearance.hpp"

/// What the files check_*.cpp share. One constraint is one small function with its equation; it offers what it measures
/// to Findings, which keep the worst of each.
namespace mcplan::checks {

enum class Constraint {
  finite,
  phase_duration,
  dynamics,
  at_consistency,
  orientation,
  contact_distance,
  contact_polygon,
  contact_permission,
  slip,
  anchor,
  center_of_pressure,
  path_continuity,
  free_force,
  stiffness_sign,
  pull,
  friction,
  force_cap,
  joint_torque,
  joint_speed,
  com_speed,
  moment,
  angular_momentum,
  reach,
  clearance,
  limb,
  trunk,
  sequence_switch,
  sequence_rule,
  start,
  goal,
};
constexpr int kConstraints = static_cast<int>(Constraint::goal) + 1;

/// Where and when something was measured; -1: not tied to a phase or to an end-effector.
struct Place {
  int phase = -1;
  int end_effector = -1;
  double time_s = 0.0;
};

/// Limits that follow from the state at an instant alone, which a measured start may violate by itself.
enum class StateLimit {
  reach,
  yaw_range,
  com_speed,
  joint_speed,
  clearance,
  limb,
  trunk,
  contact_distance,
  contact_polygon
};
constexpr int kStateLimits = static_cast<int>(StateLimit::contact_polygon) + 1;

constexpr Constraint constraint_of(StateLimit limit) {
  constexpr Constraint all[kStateLimits] = {
      Constraint::reach,          Constraint::reach, Constraint::com_speed, Constraint::joint_speed,
      Constraint::clearance,      Constraint::limb,  Constraint::trunk,     Constraint::contact_distance,
      Constraint::contact_polygon};
  return all[static_cast<int>(limit)];
}

class StartSlack;  // start_slack.hpp

/// Tolerances times the factors of their units; but `dynamics` and `boundary`, which have several, stay as they are,
/// for the caller to multiply.
Tolerances for_size(const Tolerances& tolerances, const Similarity& similarity);

const char* name_of(Constraint constraint);

/// value / tolerance, the measure by which two findings compare; a tolerance of 0 makes any excess infinite.
double severity(double value, double tolerance);

/// Largest entry, not a number if any is (Eigen's maxCoeff() may pass over a NaN).
inline double largest(const Eigen::Vector3d& v) {
  const double most = std::max(std::max(v[0], v[1]), v[2]);
  return v[0] == v[0] && v[1] == v[1] && v[2] == v[2] ? most : std::numeric_limits<double>::quiet_NaN();
}

/// What is less than this part of a square is less by more than rounding.
constexpr double kBelow = 1.0 - 1e-12;

/// An angle less whole turns, in [-pi, pi].
inline double modulo_turn(double angle) { return std::abs(angle) < M_PI ? angle : std::remainder(angle, 2.0 * M_PI); }

class Findings {
 public:
  Findings(const Tolerances& tolerances, const Similarity& similarity);

  /// Keep this measurement if it is the worst of its constraint. Not a number counts as the largest number.
  void offer(Constraint constraint, double value, const Place& place) {
    const Worst& own = worst_[static_cast<int>(constraint)];
    offer(constraint, value, place, own.own_tolerance, own.own_unit);
  }

  /// The same with a unit and a tolerance other than the constraint's own.
  void offer(Constraint constraint, double value, const Place& place, double tolerance, const char* unit) {
    const Worst& worst = worst_[static_cast<int>(constraint)];
    // Nearly all of them are no worse; of other units the product says so up to rounding, which a division settles.
    if (worst.measured &&
        (tolerance == worst.tolerance ? value <= worst.value : tolerance > 0.0 && value < worst.bar * tolerance)) {
      // Not all constraints are looked at in the order of time: what is no worse may be earlier.
      if (value > tolerance && place.time_s < kept_until_s_) kept_until_s_ = place.time_s;
      return;
    }
    compare(constraint, value, place, tolerance, unit);
  }

  /// The same of a limit of the state: what is beyond it, less the slack of the measured start.
  void offer(StateLimit limit, double value, const Place& place) {
    const Worst& own = worst_[static_cast<int>(constraint_of(limit))];
    offer(limit, value, place, own.own_tolerance, own.own_unit);
  }
  void offer(StateLimit limit, double value, const Place& place, double tolerance, const char* unit) {
    offer(constraint_of(limit), slack_ ? less_slack(limit, value, place, tolerance, unit) : value, place, tolerance,
          unit);
  }

  /// Slack to measure, or to give; null: none.
  void set_slack(StartSlack* slack) { slack_ = slack; }

  /// Time of the earliest measurement beyond its tolerance; infinite: there is none.
  double kept_until_s() const { return kept_until_s_; }

  /// What a value of the constraint has to exceed to be kept, in its own unit: who can tell cheaply that his does not
  /// need not measure it. Minus infinity where nothing is said. Of what is looked at in the order of time.
  double kept(Constraint constraint) const {
    const Worst& worst = worst_[static_cast<int>(constraint)];
    constexpr double kNothing = -std::numeric_limits<double>::infinity();
    if (!worst.measured) return kNothing;
    if (worst.tolerance == worst.own_tolerance) return worst.value;
    return worst.own_tolerance > 0.0 ? worst.bar * worst.own_tolerance : kNothing;
  }

  /// The same of a limit of the state, in any order of time: where there may be slack, and where a violation before
  /// the earliest one so far counts, too.
  double kept(StateLimit limit, const Place& place) const {
    const Constraint constraint = constraint_of(limit);
    const double value = place.time_s < kept_until_s_
                             ? std::min(kept(constraint), worst_[static_cast<int>(constraint)].own_tolerance)
                             : kept(constraint);
    return slack_ ? plus_slack(limit, value, place) : value;
  }

  /// The first `count` constraints, in the order of the enumeration.
  std::vector<Violation> violations(int count, const Robot& robot) const;

 private:
  struct Worst {
    double value = 0.0, tolerance = 0.0, severity = 0.0;  ///< the tolerance that this value was measured by
    const char* unit = "";
    Place place;
    bool measured = false;
    double own_tolerance = 0.0;  ///< of the constraint
    const char* own_unit = "";
    double bar = -std::numeric_limits<double>::infinity();  ///< a little less than the severity
  };
  void compare(Constraint constraint, double value, const Place& place, double tolerance, const char* unit);
  double less_slack(StateLimit limit, double value, const Place& place, double tolerance, const char* unit) const;
  double plus_slack(StateLimit limit, double kept, const Place& place) const;

  std::array<Worst, kConstraints> worst_;
  double kept_until_s_ = std::numeric_limits<double>::infinity();
  StartSlack* slack_ = nullptr;
};

struct Problem {
  const Plan& plan;
  const Scene& scene;
  const Robot& robot;
  const Tolerances& tolerances;                     ///< for_size(): those with one unit are the robot's own
  Similarity similarity;                            ///< for those with several, and for thresholds
  std::vector<Solid> solids;                        ///< one per surface
  std::vector<std::vector<FreeStretch>> stretches;  ///< per end-effector
  std::vector<double> knot_times;

  // How far the plan is looked at: phases that begin before until_s, knots that come no later.
  double until_s = std::numeric_limits<double>::infinity();
  int end_phase = 0;  ///< the phase after the last of them
  int last_knot = 0;

  /// Of knot_times and until_s.
  void set_end();

  bool has_points(int k) const { return plan.phases[k].has_points(); }
  bool has_wrenches(int k) const { return plan.phases[k].has_wrenches(); }
  bool has_momentum(int k) const { return plan.phases[k].has_momentum(); }
  int phase_count() const { return static_cast<int>(plan.phases.size()); }
  int end_effector_count() const { return static_cast<int>(robot.end_effectors.size()); }

  /// Surface of an end-effector in phase k, after the last phase for k = phases.
  int surface(int k, int l) const {
    return k < phase_count() ? plan.phases[k].contacts[l].surface : plan.final_contacts[l];
  }

  /// The start of phase k; the end of the last phase that is looked at for k = end_phase.
  Place at_knot(int k, int l) const { return {k < end_phase ? k : k - 1, l, knot_times[k]}; }
};

/// CoM, base and angular momentum, integrated by the checker itself. Under the pendulum the momentum stays zero here,
/// since the base carries it. Under contact wrenches the base's orientation is integrated as a quaternion; the angles
/// and their rates are no numbers then, and what the plan states is compared with orientation and momentum.
struct Replay {
  Eigen::Vector3d com_W, com_velocity_W, rpy, rpy_rate, momentum_W;
  Eigen::Vector4d quat_wxyz{0.0, 0.0, 0.0, 0.0};

  bool has_quaternion() const { return !quat_wxyz.isZero(); }
};

/// What the instants of a phase share: looked up once a phase, so that a sample costs the same in long plans.
struct PhaseView {
  PhaseFrame frame;
  std::vector<const FreeStretch*> stretches;     ///< per end-effector, null in contact
  std::vector<Eigen::AlignedBox3d> reach_boxes;  ///< per end-effector, in frame B about the CoM [m]
};
PhaseView phase_view(const Problem& problem, int phase);  // check_space.cpp

/// An instant of a phase.
struct Sample {
  const PhaseView* view = nullptr;
  int phase = 0;
  double since_start_s = 0.0, time_s = 0.0;
  Replay replay;            ///< what the checker integrated
  Eigen::Matrix3d r_WB;     ///< of the replay
  double yaw = 0.0;         ///< of the replay's base
  std::vector<char> still;  ///< per end-effector: in contact and, to the last bit, as at the instant before it in this
                            ///< phase, so that what depends on its place alone has been measured
  PlanState at;             ///< what the plan says
  Eigen::Matrix3d r_at_WB;  ///< of the angles that it says
  std::vector<Eigen::Vector3d> forces_W;   ///< per end-effector, from replay.com_W or from its points [N]
  std::vector<Eigen::Vector3d> moments_W;  ///< per end-effector in contact, about where the plan has it [N m]
  std::vector<std::vector<Eigen::Vector3d>> cone_forces_W;  ///< per end-effector, what friction holds one by one: the
                                                            ///< forces at its points, or the one of the pendulum
};

/// check_replay.cpp: the steps in which a phase is looked at, none of which crosses an instant between two intervals of
/// forces; orientation and heading of the replay; whether it can go on; the force of each contact.
int sample_count(const Problem& problem, int phase);
void set_orientation(Sample& sample);
bool has_numbers(const Replay& replay);
void contact_forces(const Problem& problem, Sample& sample);
void check_dynamics(const Problem& problem, const Sample& phase_end, Findings& findings);
void check_at_consistency(const Problem& problem, const Sample& sample, Findings& findings);

/// check_numbers.cpp: both return whether the rest can be evaluated.
bool check_finite(const Problem& problem, Findings& findings);
bool check_phase_duration(const Problem& problem, Findings& findings);

/// check_contacts.cpp
void check_contact_place(const Problem& problem, const Sample& sample, Findings& findings);
void check_contact_place_at_end(const Problem& problem, const Sample& last, Findings& findings);
void check_contact_permission(const Problem& problem, Findings& findings);

/// Heading of a sole: its own where the knots say it, otherwise the base's.
double sole_yaw(const Problem& problem, const Sample& sample, int l);

/// Distance from a point to the sole, a rectangle about the end-effector's position: `offset` is between the two.
double beyond_sole(const Eigen::Vector2d& half_size, const Eigen::Vector3d& normal_W, double yaw,
                   const Eigen::Vector3d& offset_W);

/// Distance from the projection of a point to the polygon; inside, less than zero: minus the distance to the boundary.
double beyond_polygon(const Polygon& polygon, const Eigen::Vector3d& position_W);

/// The same of a surface and those beside it that go on in its plane, on which a sole that stands on it may press, too:
/// with the same friction or more, for this end-effector. What lies on or about it does not, nor does what is further
/// than `within` [m] from the surface that is named: a foot is not on one while it stands on another.
double beyond_ground(const Problem& problem, int surface, int l, const Eigen::Vector3d& position_W, double within);

/// How far an end-effector may be beside the surface that its contact names [m], on ground that goes on there.
constexpr double beside_named_m = 0.021;

/// An end-effector at an instant of a phase.
struct Seen {
  double since_start_s = 0.0;
  Eigen::Vector3d position_W, velocity_W;
  double yaw = 0.0;
};

/// Remembers where each end-effector touched down and was last seen.
class Travel {
 public:
  /// Sets sample.still; before check() of that sample.
  void find_still(const Problem& problem, Sample& sample) const;
  void check(const Problem& problem, const Sample& sample, Findings& findings);

 private:
  bool smooth(const Problem& problem, const Sample& sample, int l, const Findings& findings) const;
  void check_continuity(const Problem& problem, const Sample& sample, int l, Findings& findings);
  double jump(const Problem& problem, const Sample& sample, int l, const Seen& a, const Seen& b);

  std::vector<int> surface_;
  std::vector<Eigen::Vector3d> touched_W_;
  std::vector<Seen> last_;
  std::vector<double> touched_yaw_;
  int phase_ = -1;
  int looked_closer_ = 0;  ///< instants between samples
};

/// check_forces.cpp
void check_free_force(const Problem& problem, Findings& findings);
void check_stiffness_sign(const Problem& problem, Findings& findings);
void check_pull(const Problem& problem, const Sample& sample, Findings& findings);
void check_friction(const Problem& problem, const Sample& sample, Findings& findings);
void check_force_cap(const Problem& problem, const Sample& sample, Findings& findings);
void check_momentum(const Problem& problem, const Sample& sample, Findings& findings);

/// check_space.cpp
void check_reach(const Problem& problem, const Sample& sample, Findings& findings);
void check_reach_at_knots(const Problem& problem, Findings& findings);
void check_soles(const Problem& problem, Findings& findings);
void check_com_speed(const Problem& problem, const Sample& sample, Findings& findings);
void check_yaw_range(const Problem& problem, const Sample& sample, Findings& findings);

/// The solids around swinging end-effectors: those out of an end-effector's reach until it has moved on are not looked
/// at again and again.
class Surroundings {
 public:
  void check_clearance(const Problem& problem, const Sample& sample, Findings& findings);

 private:
  struct Near {
    Eigen::Vector3d center_W;
    std::vector<Solid> solids;  ///< all that a point of the end-effector within kMove of the centre can be in
    bool known = false;
  };
  static constexpr double kMove = 0.25;  ///< [m]

  const std::vector<Solid>& around(const Problem& problem, int l, const Eigen::Vector3d& position_W);

  std::vector<Eigen::AlignedBox3d> boxes_;  ///< of the problem's solids
  std::vector<Near> near_;                  ///< per end-effector
};

/// check_joints.cpp: where the hip of a leg with joint limits is [m], p + R (hip_B + shift moved_B), with moved_B the
/// sum of R^T (p_m - p) - nominal_m over all legs with limits, in contact or not.
Eigen::Vector3d feet_moved(const Problem& problem, const Sample& sample);
Eigen::Vector3d hip_of(const Sample& sample, const LimbLimits& limb, const Eigen::Vector3d& feet_moved_B);

/// check_joints.cpp: torques and speeds of the joints of legs in contact.
class Joints {
 public:
  void check(const Problem& problem, const Sample& sample, Findings& findings);

 private:
  static constexpr double kMinLeverRatio = 0.15;  ///< of the shorter link: legs are no longer than with such a lever

  struct Seen {
    int phase = -1;
    double since_start_s = 0.0, length = 0.0;
  };
  std::vector<Seen> last_;  ///< per end-effector
};

/// check_sequence.cpp
void check_sequence_switch(const Problem& problem, Findings& findings);
void check_sequence_rule(const Problem& problem, Findings& findings);

/// check_ends.cpp
void check_start(const Problem& problem, Findings& findings);
void check_goal(const Problem& problem, Findings& findings);

}  // namespace mcplan::checks
