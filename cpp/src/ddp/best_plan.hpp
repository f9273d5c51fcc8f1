#pragma once

#include <optional>
#include <vector>

#include "ddp/search.hpp"
#include "mcplan/base/deadline.hpp"
#include "mcplan/plan/checker.hpp"

namespace mcplan::ddp {

/// The best plan of a solve so far, by the checker's measure: one that the checker accepts before one that it does not;
/// among those accepted the cheaper one, among the others the one whose worst violation is the fewest times its
/// tolerance.
///
/// Under a time limit it is kept up to date while the search runs: iterates are made exact, converted and checked now
/// and then, so that there is an answer at any time, and the answer after a longer time is never worse. When that is
/// done does not depend on the limit. Theory: docs/theory/ddp.md, "6. Time limit".
class BestPlan {
 public:
  /// `scene` and `surfaces`: the user's scene, and which of its surfaces the searched problem has.
  BestPlan(const Scene& scene, const Deadline& deadline, bool measured_start)
      : scene_(&scene), deadline_(&deadline), measured_start_(measured_start) {}

  struct Finished {
    Plan plan;
    Violation worst;
    std::vector<Violation> warnings;
    bool ok = false;
    bool sampled = false;   ///< checked at few instants only: never called ok
    double sample_s = 0.0;  ///< every so often, as Tolerances::sample_s
    Evaluation evaluation;
  };

  /// Make exact, convert, check in full. True when any plan so far passes. Where the time limit cuts it short, what was
  /// kept before stays, and without any the iterate is looked at as it is.
  bool finish(Search& search, const std::vector<int>& surfaces, Incumbent now, const Tuning& tuning);

  /// Under a time limit: the same at few instants, if it is due and there is time for it.
  void keep(Search& search, const std::vector<int>& surfaces, const Incumbent& now, const Tuning& tuning);

  /// What is kept was perhaps looked at in few instants alone: check it in full if there is time.
  void settle(const Problem& problem, Report& report);

  const std::optional<Finished>& best() const { return best_; }
  bool ok() const { return best_ && best_->ok; }

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
  void take(Finished&& finished);

  const Scene* scene_;
  const Deadline* deadline_;
  bool measured_start_;
  std::optional<Finished> best_;
  int kept_ = 0;
  double cost_s_ = 0.0, next_s_ = 0.0;  ///< of making an iterate a plan and checking it; when the next one is due
  double instant_s_ = 0.0;              ///< of which an instant of the check
};

/// Value in tolerances; what admits none is beyond every other violation.
double violation_ratio(const Violation& violation);

}  // namespace mcplan::ddp
