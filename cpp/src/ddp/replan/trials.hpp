#pragma once

#include <optional>
#include <utility>

#include "ddp/replan/rest.hpp"
#include "ddp/replan/trial.hpp"
#include "mcplan/plan/report.hpp"

namespace mcplan::ddp {

/// The trials of one replan, best first, and what is told of them.
class Trials {
 public:
  Trials(const Now& now, Report& report) : now_(&now), report_(&report) {}

  /// Whether there is no need, or no time, for another one.
  bool done() const;

  /// With `apart` it gets its iterations whatever work others have been, and takes none from them.
  void make(const Now& now, const Rest& rest, PlanFrom from, bool apart = false);

  void take(std::optional<Trial> trial, PlanFrom from);

  /// The best one so far does not count any more, unless nothing is solved until it is put back.
  struct Aside {
    std::optional<Trial> trial;
    PlanFrom from = PlanFrom::same_sequence;
    double ratio = 1.0;
  };
  Aside put_aside() { return {std::exchange(best_, std::nullopt), report_->plan_from, best_ratio_}; }
  void put_back(Aside aside) {
    if (!aside.trial || solved()) return;
    best_ = std::move(aside.trial);
    report_->plan_from = aside.from;
    best_ratio_ = aside.ratio;
  }

  /// The best one so far counts again when all others have been tried, so that it is in the way of none of them.
  void spare_until_the_end() { spare_ = put_aside(); }
  void take_spare() {
    if (spare_.trial && (!best_ || better(*spare_.trial, *best_))) put_back(std::move(spare_));
  }

  /// Whether steps that catch a push have not been tried yet: once is enough.
  bool begin_recovery() { return !std::exchange(recovery_tried_, true); }

  /// From now on a plan that is not even acceptable is none.
  void take_sound_only(bool only) { sound_only_ = only; }

  std::optional<Trial>& best() { return best_; }
  const Now& now() const { return *now_; }

  /// Whether nothing more may be begun.
  bool out_of_time() const { return now_->deadline->passed() || interrupted(best_) || interrupted(spare_.trial); }

  /// Whether there is no time for another one that takes as long as the longest.
  bool too_late() const {
    return out_of_time() || (now_->deadline->limited() && now_->deadline->remaining_s() < longest_s_);
  }

  bool solved() const { return best_ && best_->ok(); }

  /// Whether the best one misses limits by so little, or by nothing, that a controller may follow it to its end.
  bool acceptable() const;

  /// Whether a controller may follow the best one for the next two steps.
  bool usable() const { return best_ && (best_->ok() || can_be_followed(*best_)); }

  /// Ratio of the velocity command that the trials from now on follow.
  void followed(double ratio) { ratio_ = ratio; }
  double best_ratio() const { return best_ratio_; }

 private:
  static bool interrupted(const std::optional<Trial>& trial) { return trial && trial->ending == Ending::interrupted; }
  std::optional<Trial> attempt(const Now& now, const Rest& rest, bool apart, const Again* again);

  /// A line of the log: why it was refused, or that it was not.
  void tell(const std::optional<Trial>& trial, PlanFrom from) const;

  /// Iterations that the work which is left allows a sequence of so many phases.
  int iterations_left(int phases) const;

  const Now* now_;
  Report* report_;
  std::optional<Trial> best_;
  Aside spare_;
  int work_ = 0;  ///< iterations times phases
  bool sound_only_ = false, recovery_tried_ = false;
  bool held_joints_ = false;  ///< rows for the limits of joints have been tried
  double longest_s_ = 0.0, ratio_ = 1.0, best_ratio_ = 1.0;
};

/// What is reported of the best of them; its plan goes out.
void conclude(Trials& trials, Report& report, PlanResult& out);

}  // namespace mcplan::ddp
