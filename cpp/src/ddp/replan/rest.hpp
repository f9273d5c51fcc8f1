#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "ddp/contact_sequence.hpp"
#include "mcplan/ddp/replan.hpp"
#include "mcplan/plan/plan.hpp"
#include "mcplan/robot/similarity.hpp"

namespace mcplan::ddp {

struct Tail;

/// How short phases of steps that catch a push may be [s]: half as long as the robot's shortest. Chosen.
inline double quickest_s(const Robot& robot, const Similarity& similarity) {
  return 0.5 * phase_duration_of(robot, similarity)[0];
}

/// What is left of a plan: phases, knots and final contacts, without swings. The first knot is the measured state.
struct Rest {
  Plan plan;
  std::vector<char> planned;  ///< by phase: it was planned before, so that where contacts begin in it was chosen
  int kept = std::numeric_limits<int>::max();  ///< what is planned up to this phase keeps its footholds
  std::vector<Knot> desired;                   ///< by knot: what the motion is to stay near; empty: what was planned

  bool free_end = false;             ///< it ends at rest, wherever that is
  std::shared_ptr<const Tail> tail;  ///< what stays as it was planned, after these phases; null: nothing
  double shortest_s = 0.0;           ///< phases may be as short; 0: as the robot's
  bool quick = false;                ///< phases ahead are shorter than the robot's: steps that catch a push

  /// A foot that steps across another: the knot at which it lands, both end-effectors, and the level axis from the
  /// other's sole to the one's along which they are kept apart.
  struct Across {
    int knot = 0, foot = 0, other = 0;
    Eigen::Vector2d axis_W = Eigen::Vector2d::Zero();
    int via_knot = -1;  ///< where it passes the other first, on its own side of it; -1: it has done so
    Eigen::Vector3d via_W = Eigen::Vector3d::Zero();
  };
  std::optional<Across> across;

  /// Whether it is steps that catch a push.
  bool catches_push() const { return free_end && shortest_s > 0.0; }

  int size() const { return static_cast<int>(plan.phases.size()); }
  int surface(int k, int e) const { return k < size() ? plan.phases[k].contacts[e].surface : plan.final_contacts[e]; }
  ContactState contacts(int k) const;

  /// Put a phase in before phase k, with these contacts and the weight shared among them. Its first knot is that of
  /// phase k, which begins at the same place; with k = size() the last knot, where the plan then stands.
  void insert(int k, const ContactState& contacts, double duration_s);

  /// Share the weight among the contacts of a phase, with forces that act at the end-effectors and point at the CoM.
  void share_weight(int k);

  /// Let the base carry what is in the air from the beginning on and is no foot: hands stay where they are to it. From
  /// hands that are left behind while the robot walks away solves do not converge: they end 0.4 m out of reach.
  void carry_hands(const Robot& robot);

  /// Leave the phase under way alone, of which nothing is kept: steps are put together after it anew.
  void keep_first();

  /// Take the first `count` phases away; what comes after begins at the measured state.
  void drop(int count);
};

/// First guess of the duration of a swing that is put in, from the shortest and longest phase [s].
double swing_duration_of(const Eigen::Vector2d& phase_duration_s);

/// The rest of a plan at time t [s], from the planned state.
Rest rest_of(const Plan& previous, double t);

/// A phase of the plan before its rest.
struct Past {
  ContactState contacts;
  double since_s = 0.0;  ///< time since its end
};

/// Make the rest begin with the contacts that are measured: phases are left out where contacts change early, put in
/// where they change late or other than planned, whichever is closer in time. `before`: phases before the rest, latest
/// first. False where no order of single changes leads from the one to the other.
bool begin_with(Rest& rest, const Measured& measured, const ContactState& contacts, const std::vector<Past>& before,
                const Similarity& similarity);

/// Phases of a plan before time t [s], latest first: as many as are looked at.
std::vector<Past> past_of(const Plan& previous, double t);

/// Whether anything is made or broken after the phase under way.
bool changes_contacts(const Rest& rest);

/// Standing phases at the end, so that there are at least so many phases.
void stand_on(Rest& rest, int phases_min, const Similarity& similarity);

}  // namespace mcplan::ddp
