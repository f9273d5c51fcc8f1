#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "ddp/constants.hpp"
#include "ddp/contact_sequence.hpp"
#include "ddp/headings.hpp"
#include "ddp/layout.hpp"
#include "ddp/swing_arcs.hpp"
#include "mcplan/ddp/options.hpp"
#include "mcplan/plan/plan.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/robot/similarity.hpp"
#include "mcplan/scene/polygon.hpp"
#include "mcplan/scene/scene.hpp"

namespace mcplan::ddp {

/// Units in which the planner computes: length = CoM height, time = sqrt(height / gravity), mass = the robot's. Gravity
/// is then 1, and so is the total stiffness of standing. The weights of Table I apply to these numbers.
struct Units {
  double length = 1.0;  ///< [m]
  double time = 1.0;    ///< [s]
  double mass = 1.0;    ///< [kg]

  double velocity() const { return length / time; }
  double stiffness() const { return 1.0 / (time * time); }  ///< of mu = lambda^2
  double force() const { return mass * length / (time * time); }
  double moment() const { return force() * length; }
  double angular_momentum() const { return mass * length * velocity(); }
};

/// A motion at the knots: x_0..x_N and u_0..u_{N-1}, non-dimensional.
struct Trajectory {
  std::vector<Eigen::VectorXd> x, u;
  std::vector<std::vector<double>> sole_yaw;  ///< by step and end-effector [rad]: given, not optimised; see Problem
  std::vector<std::vector<double>> knot_yaw;  ///< the same; of a sole that has just left, that of its last foothold
  SwingArcs swing_arcs;                       ///< likewise; empty: every phase is taken for a whole swing
};

/// What the attempts of one search differ in; the problem is the same for all of them.
struct Tuning {
  double limit_weight = Weights().limit;  ///< on limits at the knots and, at the full weights, between them
  double duration_initial = 0.0;          ///< first guess of all phases
  double extra_margin = 0.0;              ///< further margin of soles, where one has caught an edge
  bool clear_swings = false;              ///< hold swings out of solids, where one has caught an edge
  bool hold_joints = false;               ///< hold the limb limits, where a plan has exceeded them
  bool exact = false;                     ///< polish by interior point whatever the options say, in few phases
  bool penalty = false;                   ///< polish by the penalty, where the interior point has found no plan
};

/// Limits and nominal position of an end-effector, non-dimensional.
struct EndLimits {
  Eigen::Vector3d nominal, reach_min, reach_max;
  int cuts = 0;  ///< faces cut_A x <= cut_b of the reach box
  Eigen::Matrix<double, kReachCuts, 3, Eigen::RowMajor> cut_A;
  Eigen::Matrix<double, kReachCuts, 1> cut_b;
  double force_max = 0.0;
  Eigen::Vector2d half_size{0.0, 0.0};      ///< half length and half width of the sole
  Eigen::Vector2d pressure_half{0.0, 0.0};  ///< and of the part of it that holds the centre of pressure
  double half_width = 0.0;                  ///< the shorter of the two
  Eigen::Vector3d moment_max;
  double yaw_min = 0.0, yaw_max = 0.0;  ///< [rad] of the sole against the base
  LimbLimits limb;                      ///< none where the options do without
  double usual_stride = 0.0;            ///< length of the usual reach
  double leg_max = 0.0;                 ///< from hip to ankle, where there are limb limits
  bool balances = false;                ///< a point foot on which a robot that is tracked keeps its balance

  /// Length of the leg in the nominal stance.
  double nominal_leg() const { return (limb.hip_B - nominal - limb.ankle).norm(); }
  /// Plan it shorter at most, but not than in the nominal stance.
  void shorten_leg(double by) { leg_max = std::max(leg_max - by, std::min(leg_max, nominal_leg())); }
};

/// The robot that is planned for: without limb limits where the options do without joint limits.
Robot robot_for(Robot robot, const Options& options);

/// Scene, robot and options worked out for the planner: non-dimensional, by index. The end-effectors here are the
/// `active` ones; those that may touch nothing are carried along at their nominal place and cost no variables
/// (Method::paper keeps them all).
class Problem {
 public:
  /// `course`: what the reference follows from the start to the goal.
  Problem(const Scene& scene, const Robot& robot, const Options& options, const Course& course = {});

  Scene scene;
  Robot robot;
  Options options;
  Course course;
  Units units;
  Similarity similarity;  ///< what margins and durations stated for a robot of human size are multiplied by
  Layout layout;
  int steps = 0;                  ///< N
  std::vector<int> active;        ///< end-effector of the robot behind each of the problem's
  std::vector<Polygon> polygons;  ///< by scene surface
  Model model = Model::wrench;
  std::vector<double> friction;                       ///< by scene surface; infinite where it may be held (grasp)
  std::vector<std::vector<Eigen::Vector3d>> pyramid;  ///< by scene surface: tangents t of the sides t.d <= friction n.d
  double pyramid_ratio = 1.0;                         ///< of the cone's opening that lies inside every side
  double edge_margin = 0.0;                           ///< footholds are planned this much inside their polygon
  double pressure_margin = 0.0;                       ///< and centres of pressure
  double torsion_ratio = 1.0;                         ///< of what friction under a sole can twist that is planned with
  double load_min = 0.0;                              ///< least stiffness of point feet in contact that are `balances`
  std::vector<double> keep_out_depth;  ///< by scene surface: a free end-effector below it is pushed up from here on
  std::vector<double> thickness;       ///< by scene surface, of the solid below it
  double swing_height = 0.0;           ///< by which an end-effector is lifted usually
  double swing_room = kPathRoom;       ///< that soles keep from solids where swings are held out of them
  double reach_room = 0.0;             ///< contacts keep inside of their reach between the knots
  bool watch_swings = false;           ///< swings are held out of solids from the first attempt on
  std::vector<Eigen::Vector3d> idle_hands;       ///< hands that may touch nothing, folded in
  std::vector<int> standing_solids;              ///< surfaces whose solids come near the reference of the CoM
  std::vector<int> trunk_solids;                 ///< and those that come near the trunk there, of a robot that has one
  std::vector<Eigen::AlignedBox3d> solid_boxes;  ///< about the solids, where there are such
  std::vector<TrunkPart> trunk;                  ///< in units of length
  std::vector<std::vector<double>> trunk_rooms;  ///< that its line keeps: by part and solid of trunk_solids
  std::vector<int> leg_solids;                   ///< and those near legs, of a robot whose legs are bodies
  std::vector<std::vector<double>> leg_rooms;    ///< that their lines keep: by active end-effector and leg_solids
  std::vector<EndLimits> limits;                 ///< by active end-effector
  /// Active end-effectors with limb limits, and the sum of their nominal positions.
  struct Jointed {
    std::vector<int> ends;
    Eigen::Vector3d nominal_sum = Eigen::Vector3d::Zero();
  };
  Jointed jointed;
  Eigen::Vector3d inertia;           ///< in units of mass length^2
  double first_duration = 0.0;       ///< what is left of the first phase when replanning, else 0
  bool first_duration_kept = false;  ///< likewise: it ends when it was to end
  /// A place where a contact begins, or that a free foot passes, when replanning: the cost term "kept".
  struct Foothold {
    int knot = 0, l = 0;
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    double weight = 0.0;
  };
  std::vector<Foothold> kept;
  bool free_end = false;    ///< it ends at rest wherever that is, likewise: places at the end are as free as others
  bool pinned_end = false;  ///< it ends in the state of reference.x.back(), which another plan goes on from
  /// Soles that are kept apart along a given level axis, from the other's to the one's, at the knot at which a foot
  /// lands that steps across the other.
  struct Across {
    int knot = 0, l = 0, other = 0;
    Eigen::Vector2d axis = Eigen::Vector2d::Zero();
  };
  std::vector<Across> across;
  bool measured = false;                                ///< starts from a measured state
  std::vector<Eigen::Vector3d> start_end_velocities_W;  ///< [m/s] by end-effector of the robot, where measured
  double start_slack = 0.0;  ///< time within which what a measured start violates by itself is made good
  double flight_duration_min = 0.0;
  double duration_min = 0.0, duration_max = 0.0, duration_initial = 0.0;
  Eigen::Vector3d base_rpy;  ///< angles of the axes that are not in the layout
  ContactRules rules;
  ContactState start_contacts, goal_contacts;
  std::vector<double> start_yaw;  ///< [rad] by end-effector: headings of the soles at the start
  double goal_yaw = 0.0;          ///< [rad] and at the goal
  std::vector<double> end_yaw;    ///< [rad] likewise where the end is pinned; empty: goal_yaw
  Trajectory reference;           ///< x_ref by knot (u empty)
  Eigen::VectorXd start;          ///< x_0 as demanded

  /// The tuning of the first attempt.
  Tuning tuning() const { return {options.weights.limit, duration_initial, 0.0, watch_swings}; }

  /// How far inside edge i of a surface an end-effector's footholds are planned: edge_margin, and the share
  /// Options::sole_inside of how far its sole, headed anywhere from start to goal, extends towards that edge; of
  /// feet `extra_margin` as well. Never past the middle of a surface that is too narrow, and with `extra_margin` no
  /// further than where the end-effector has to stand at the start or the goal.
  double foothold_margin(int l, int surface, int edge, double extra_margin = 0.0) const;

  /// What is left of such a margin where the foothold is at `place`, and its derivative by the place, if asked for.
  /// Where the scene puts the end-effector at the start or the goal nothing can move it: the margin is what that
  /// leaves, and grows with the distance from there. So footholds that are given cost nothing, others what they do.
  double margin_of_given(int l, int surface, int edge, const Eigen::Vector3d& place, double margin,
                         Eigen::Vector3d* by_place = nullptr) const;

  /// Roll, pitch, yaw of a state.
  Eigen::Vector3d rpy(const Eigen::VectorXd& x) const;

  /// Frame of a sole of this heading on a surface: x along it, y across, z the normal.
  Eigen::Matrix3d sole_frame(int surface, double yaw) const;

  /// Set the headings of soles: one that stands keeps the mean heading of the base over its contact, the start's or the
  /// goal's where the contact is one of theirs; elsewhere it goes with the base. The headings follow the iterates
  /// instead of being variables: so the dynamics do not depend on the contact state, which pricing needs.
  void set_sole_yaw(const ContactSequence& sequence, Trajectory& trajectory) const;

  /// All phases are first guessed to last so long, and the reference goes as fast as that asks for.
  void set_pace(double duration);

  /// First guess: the reference at constant duration. Without a sequence the weight is spread over all end-effectors,
  /// which lets the search see what every one of them could do (measured: with the weight on the feet alone it never
  /// finds the hands of gap_with_rail); with one it rests on those in contact.
  Trajectory initial_guess(const ContactSequence& sequence, const Tuning& tuning) const;
  Trajectory initial_guess(const ContactSequence& sequence) const { return initial_guess(sequence, tuning()); }

  /// A sequence given by all end-effectors of the robot, for the active ones. Throws InvalidOptions when it does not
  /// fit: steps + 1 rows, valid, from the start's contacts to the goal's.
  ContactSequence to_active(const ContactSequence& sequence) const;

  /// Look for the contacts of each step among this many surfaces nearest to where the reference has the end-effector
  /// then; 0 or enough for all: among all. Leaves out those that are further than so many diagonals of its reach from
  /// there, unless there are few in all; 0: none.
  void look_near(int count, double within = 0.0);

  /// Start from a measured state instead of the scene's; `contacts` by active end-effector.
  void set_start(const Knot& state, const ContactState& contacts);

  /// Let end-effectors reach all of their boxes, beyond what is usual of them.
  void reach_far();

  /// End in a given state instead of at the scene's goal, before set_start(); `contacts` by active end-effector.
  void set_end(const Knot& state, const ContactState& contacts);

 private:
  std::vector<std::vector<std::vector<double>>> foothold_margins_;  // by active end-effector, surface, edge
  std::vector<std::vector<std::vector<double>>> slack_;             // likewise: how far in it has to stand
  std::vector<std::vector<double>> widths_;                         // by surface, edge: from it to the farthest vertex

  void make_durations();
  void make_surfaces();
  std::vector<std::vector<int>> make_ends();
  EndLimits limits_of(const EndEffector& end) const;
  double reach_margin_m() const;
  void set_box(EndLimits& l, const Eigen::AlignedBox3d& box) const;
  double friction_ratio() const;
  std::vector<StateRule> make_state_rules() const;
  Eigen::VectorXd state_of(const ResolvedStance& stance) const;
  Eigen::VectorXd state_of(const Knot& knot) const;
  void make_slack();
  std::vector<std::vector<double>> headings_on_surfaces(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
  void make_foothold_margins(const Eigen::Vector3d& from, const Eigen::Vector3d& to);
  int automatic_steps(const ResolvedStance& from, const ResolvedStance& to) const;
  Eigen::Vector3d stride_of(int l) const;
  void make_reference(const Eigen::VectorXd& goal);
  void follow_ground();
  std::vector<double> balanced_loads(const ContactState& contacts, const Eigen::VectorXd& x) const;
  void find_standing_solids();
  void find_trunk_solids();
  void make_trunk_rooms();
  void find_leg_solids();
  void make_leg_rooms();
  void place_footholds(const ContactSequence& sequence, Trajectory& guess) const;
};

}  // namespace mcplan::ddp
