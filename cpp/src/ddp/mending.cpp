#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ddp/attempts.hpp"
#include "ddp/constants.hpp"
#include "ddp/near_miss.hpp"

// Plans that the checker rejects by little, brought within the limits: docs/theory/ddp.md, "Near misses".
namespace mcplan::ddp {
namespace {

bool missed_by_far(const std::vector<Violation>& missed) {
  return std::any_of(missed.begin(), missed.end(), [](const Violation& v) { return violation_ratio(v) > kAcceptable; });
}

bool far_by_joints_alone(const std::vector<Violation>& missed) {
  return std::all_of(missed.begin(), missed.end(), [](const Violation& v) {
    return violation_ratio(v) <= kAcceptable || v.name.rfind("joint_", 0) == 0;
  });
}

}  // namespace

/// An attempt, and where the interior point has ended with a near miss, the same motion further inside at once.
Ending Attempts::attempt_and_mend(std::vector<Guess> guesses, const Tuning& tuning) {
  const Ending ending = attempt(std::move(guesses), tuning);
  return search_.exact_contacts(tuning) ? mend_last(ending, tuning) : ending;
}

/// What the last attempt has ended with, further inside, if it is a near miss: that takes a few iterations of the
/// interior point, where another attempt takes hundreds and may end with a dearer plan.
Ending Attempts::mend_last(Ending ending, const Tuning& tuning) {
  if (ending != Ending::done || last_.sequence.empty() || missed_.empty() || missed_by_far(missed_)) return ending;
  const double cost = last_.evaluation.cost;
  const auto same = [&](double other) { return std::abs(cost - other) <= kSameOptimum * cost; };
  if (std::any_of(mended_.begin(), mended_.end(), same)) return ending;
  mended_.push_back(cost);
  // What the penalty has left a little outside the interior point holds as it is.
  const bool roughly = !search_.exact_contacts(tuning);
  const std::vector<Violation> missed = roughly ? std::vector<Violation>() : missed_;
  too_dear_ = false;
  const Ending mended = mend(last_, tuning, missed, dearest_mended(cost, problem_.steps));
  if (roughly && too_dear_ && (!cheapest_ || cost < cheapest_->at.evaluation.cost)) cheapest_ = NearMiss{last_, tuning};
  const bool its_own =
      mended == Ending::iteration_limit && search_.report().iterations < problem_.options.max_iterations;
  return its_own ? Ending::done : mended;
}

/// While there is no plan, the cheapest of the near misses of restarts whose plans would have been much dearer.
Ending Attempts::mend_cheapest(Ending ending) {
  const bool over = ending == Ending::done || ending == Ending::broke_down || ending == Ending::iteration_limit;
  if (!over || best_->solved() || !cheapest_) return ending;
  const Ending mended = mend(cheapest_->at, cheapest_->tuning);
  return mended == Ending::iteration_limit || mended == Ending::broke_down ? ending : mended;
}

/// A plan that misses limits by little does so since penalties settle slightly outside: the interior point goes on from
/// there, which holds them. Swings that catch edges and joints are no matter of that.
Ending Attempts::hold_limits(Ending ending, Tuning tuning) {
  const auto& plan = best_->finished();
  if (ending != Ending::done || !plan || plan->ok || last_.sequence.empty()) return ending;
  const std::string& name = plan->worst.name;
  const bool elsewhere = name == "clearance" || name == "limb" || name == "trunk" || name.rfind("joint_", 0) == 0;
  if (elsewhere || violation_ratio(plan->worst) > kAcceptable) return ending;
  tuning.exact = true;
  tuning.hold_joints = false;
  return attempt({{last_, 0.0, true}}, tuning);
}

/// From a plan that the checker rejects by little to the optimum of its sequence with the limits held, then further
/// inside those that are still missed, as long as that leads to near misses that cost no more than the dearest.
Ending Attempts::mend(Incumbent near, Tuning tuning, std::vector<Violation> missed, double dearest) {
  Problem inside = problem_;
  Report& report = search_.report();
  inside.options.max_iterations = report.iterations + static_cast<int>(kMendRatio * problem_.options.max_iterations);
  tuning.exact = true;
  for (int round = 0; round < kMendRounds; ++round) {
    tighten(inside, tuning, missed);
    Search search(inside, *deadline_, report);
    const double never = std::numeric_limits<double>::infinity();
    Ending ending = search.polish_guess(near, Search::Origin::plan, never, tuning);
    if (ending == Ending::done) ending = search.polish_last(near, tuning, kMendTolerance);
    if (ending != Ending::done) return ending;
    near.evaluation = search_.evaluate(near, tuning);
    too_dear_ = near.evaluation.cost > dearest;
    if (too_dear_) break;
    missed = finish(near, tuning);
    if (missed.empty()) break;
    if (!missed_by_far(missed)) continue;
    // Joints that nothing has held so far are no matter of how far they are missed.
    if (tuning.hold_joints || !far_by_joints_alone(missed)) break;
    tuning.hold_joints = true;
    missed.clear();
  }
  return late(Ending::done);
}

}  // namespace mcplan::ddp
