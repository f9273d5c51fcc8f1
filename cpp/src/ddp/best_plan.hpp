#pragma once

#include <optional>
#include <vector>

#include "ddp/search.hpp"
#include "mcplan/base/deadline.hpp"
#include "mcplan/plan/checker.hpp"

namespace mcplan::ddp {

/// The best plan of a solve so far, by the checker's measure: one that the checker accepts before one that it does not;
/// among those accepted the cheaper one, among the others the one whose worst violation is the fewest times its
/// tolerance. The plan that an attempt ends with, once accepted, comes before all others: it is what the search is for.
///
/// Iterates are plans, too, for a search that does not come to its end or to no plan that is accepted. Which of them
/// are looked at is a matter of how many iterations there were, not of a clock; when, of whether there is a time limit:
/// under one at once, so that there is an answer at any time, else when no attempt has been successful. The attempts
/// know nothing of it. A limit that does not strike thus changes no plan. Theory: docs/theory/ddp.md, "6. Time limit".
class BestPlan {
 public:
  /// `scene` and `surfaces`: the user's scene, and which of its surfaces the searched problem has.
  BestPlan(const Scene& scene, const Deadline& deadline) : scene_(&scene), deadline_(&deadline) {}

  struct Finished {
    Plan plan;
    Violation worst;
    std::vector<Violation> violations;  ///< all that are beyond their tolerance
    std::vector<Violation> warnings;
    bool ok = false;
    bool sampled = false;   ///< checked at few instants only: never called ok
    double sample_s = 0.0;  ///< every so often, as Tolerances::sample_s
    Evaluation evaluation;
    Tuning tuning;  ///< it was made with
  };

  /// End an attempt: make exact, convert, check in full. Where the time limit cuts it short, what was kept before
  /// stays, and without any the iterate is looked at as it is. Returns what the checker objects to.
  std::vector<Violation> finish(Search& search, const std::vector<int>& surfaces, Incumbent now, const Tuning& tuning);

  /// Remember an iterate if one is due; under a time limit look at it, at few instants, if there is time.
  void keep(Search& search, const std::vector<int>& surfaces, const Incumbent& now, const Tuning& tuning);

  /// After the last attempt at a problem: look at what was remembered and not looked at, unless there is no need.
  void look_back(Search& search, const std::vector<int>& surfaces);

  /// No iterate is to be the answer.
  void drop_iterates() { looked_ = earlier_; }

  /// What is kept was perhaps looked at in few instants alone: check it in full if there is time.
  void settle(const Problem& problem, Report& report);

  const std::optional<Finished>& best() const;
  const Scene& scene() const { return *scene_; }
  bool ok() const { return best() && best()->ok; }
  /// What an attempt has ended with, the best of it: all that the search may go by.
  const std::optional<Finished>& finished() const { return finished_; }
  bool solved() const { return finished_ && finished_->ok; }

 private:
  Finished converted(Search& search, const std::vector<int>& surfaces, const Incumbent& now, const Tuning& tuning,
                     bool swing_heights = true) const;
  enum class Look {
    late,  ///< at least at one instant a phase: the time is over, and nothing is compared with it any more
    few,   ///< at least at three instants a phase
    full,
  };
  bool judge(Finished& finished, const Problem& problem, Look look, const StopRequest& stop = nullptr) const;
  StopRequest when_passed() const;
  static double sample_s(const Plan& plan, Look look);
  double full_look_s(const Plan& plan) const;
  struct Kept {
    Incumbent iterate;
    Tuning tuning;
  };
  bool look(Search& search, const std::vector<int>& surfaces, const Kept& kept);

  const Scene* scene_;
  const Deadline* deadline_;
  std::optional<Finished> finished_;  ///< of the plans that attempts have ended with
  std::optional<Finished> looked_;    ///< of the iterates
  std::optional<Finished> earlier_;   ///< of those of earlier problems
  std::vector<Kept> kept_;            ///< of this problem
  int looks_ = 0, next_ = 0;          ///< how many have been kept; at which iteration the next one is due
  bool cut_short_ = false;            ///< whether the clock was in the way of looking at any of them
  double cost_s_ = 0.0;               ///< of making an iterate a plan and checking it
  double instant_s_ = 0.0;            ///< of which an instant of the check
};

/// The order in which BestPlan prefers; none comes after all others.
bool better(const std::optional<BestPlan::Finished>& one, const std::optional<BestPlan::Finished>& other);

/// Value in tolerances; what admits none is beyond every other violation.
double violation_ratio(const Violation& violation);

/// Number of phases without any contact.
int flights(const Plan& plan);

}  // namespace mcplan::ddp
