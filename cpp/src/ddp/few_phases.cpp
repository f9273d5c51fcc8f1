#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "ddp/attempts.hpp"
#include "ddp/constants.hpp"

// Short ways have more local optima, for their length: docs/theory/ddp.md, "5. Check, restarts, statuses".
namespace mcplan::ddp {

/// In few phases the optimum of the sequence that was found, and from more discoveries, whatever the checker says of
/// the plans before, until that leads no further. The best of all counts. Without a plan half of the iterations are
/// left to restarts.
class Attempts::FewPhases {
 public:
  FewPhases(Attempts& attempts, const Tuning& tuning, Ending ending)
      : attempts_(&attempts), tuning_(tuning), ending_(ending) {
    tuning_.exact = true;
  }

  Ending run() {
    const Problem& p = attempts_->problem_;
    Search& search = attempts_->search_;
    search.keep_known(true);
    if (!attempts_->last_.sequence.empty()) go_on_from({{attempts_->last_, 0.0, true}});
    int paces = 0;
    for (const auto& [share, proximal_weight] : kFewPhasesPaces) {
      tuning_.duration_initial = p.duration_min + share * (p.duration_max - p.duration_min);
      if (paces++ < kFewPhasesStepping)
        for (const Guess& steps : attempts_->stepping(tuning_)) go_on_from({steps});
      if (left()) go_on_from(at_pace(tuning_.duration_initial, proximal_weight));
    }
    in_vain_ = 0;
    if (!lowest_.sequence.empty()) go_on_from({{lowest_, 0.0, true}});
    search.keep_known(false);
    return ending_;
  }

 private:
  bool left() const {
    Search& search = attempts_->search_;
    const bool iterations =
        attempts_->best_->solved() || 2 * search.report().iterations < attempts_->problem_.options.max_iterations;
    return iterations && in_vain_ <= kFewPhasesPatience && (ending_ == Ending::done || ending_ == Ending::broke_down);
  }

  /// What is discovered where all phases are first guessed to last `duration`, and the reference goes as fast as that
  /// asks for: another pace leads to other sequences.
  std::vector<Guess> at_pace(double duration, double proximal_weight) {
    Problem other = attempts_->problem_;
    other.set_pace(duration);
    Search search(other, *attempts_->deadline_, attempts_->search_.report());
    Incumbent now;
    ending_ = Ending::done;
    now.sequence = attempts_->initial(search, tuning_, ending_);
    if (now.sequence.empty()) {
      if (ending_ != Ending::interrupted) ending_ = Ending::done;
      return {};
    }
    now.trajectory = other.initial_guess({}, tuning_);
    ending_ = search.discover(now, proximal_weight, tuning_);
    const double never = std::numeric_limits<double>::infinity();
    if (ending_ == Ending::done) ending_ = search.polish_guess(now, Search::Origin::discovered, never, tuning_);
    if (ending_ != Ending::done) return {};
    return {{std::move(now), 0.0, true}};
  }

  /// An attempt, and others from what changing the end of its sequence leads to, while that lowers the merit.
  void go_on_from(std::vector<Guess> guesses) {
    ++in_vain_;
    while (!guesses.empty() && left()) {
      ending_ = attempts_->attempt_and_mend(std::move(guesses), tuning_);
      guesses.clear();
      look_at_swings();
      const Incumbent& last = attempts_->last_;
      if (ending_ != Ending::done || last.sequence.empty()) return;
      const double merit = last.evaluation.merit();
      if (lowest_.sequence.empty() || merit < lowest_.evaluation.merit() * (1.0 - kTrialGain)) in_vain_ = 0;
      if (lowest_.sequence.empty() || merit < lowest_.evaluation.merit()) lowest_ = last;
      if (merit > kTailsWithin * lowest_.evaluation.merit() || !left() || !seen_.insert(last.sequence).second) return;
      Incumbent changed = last;
      bool improved = false;
      ending_ = attempts_->search_.change_tail(changed, tuning_, improved);
      if (improved) guesses.push_back({std::move(changed), 0.0, true});
    }
  }

  /// From the first swing that catches an edge on, swing paths are looked at: merits before were without that.
  void look_at_swings() {
    const std::vector<Violation>& missed = attempts_->missed_;
    const auto at_edge = [](const Violation& v) { return v.name == "clearance"; };
    if (tuning_.clear_swings || std::none_of(missed.begin(), missed.end(), at_edge)) return;
    tuning_.clear_swings = true;
    attempts_->search_.keep_known(true);
  }

  Attempts* attempts_;
  Tuning tuning_;
  Ending ending_;
  Incumbent lowest_;
  int in_vain_ = 0;                 ///< attempts since there was a lower one
  std::set<ContactSequence> seen_;  ///< whose ends were changed
};

Ending Attempts::vary(Ending ending, const Tuning& tuning) { return FewPhases(*this, tuning, ending).run(); }

}  // namespace mcplan::ddp
