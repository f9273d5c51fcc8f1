#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "ddp/best_plan.hpp"
#include "ddp/ending.hpp"
#include "ddp/guessed_steps.hpp"
#include "ddp/problem.hpp"
#include "ddp/search.hpp"
#include "mcplan/base/deadline.hpp"

namespace mcplan::ddp {

/// The attempts at one problem: from several first guesses, then with other tunings until the checker accepts a plan.
/// What they find goes to a BestPlan. The problem itself does not change.
class Attempts {
 public:
  /// `surfaces`: which of the user's scene the problem has. Keeps references to the others.
  Attempts(Problem&& problem, std::vector<int> surfaces, const Deadline& deadline, BestPlan& best, Report& report);
  Attempts(const Attempts&) = delete;
  Attempts& operator=(const Attempts&) = delete;

  const Problem& problem() const { return problem_; }

  /// Attempt and restart; `warm` is an earlier plan to begin with, or null.
  Ending run(const Incumbent* warm);

  /// End-effectors in turns and nothing else, once more with footholds further inside where a swing has caught an edge.
  Ending crawl();

  /// From these footsteps, with swings held out of solids, and so often again with footholds further inside where one
  /// has caught an edge.
  Ending walk(const GuessedSteps& steps, int again);

  /// Go on from a plan that the checker rejects by little, for what it has `missed`, until it accepts one, with the
  /// plan's sequence, or the motion costs more than the dearest that is wanted.
  Ending mend(Incumbent near, Tuning tuning, std::vector<Violation> missed = {},
              double dearest = std::numeric_limits<double>::infinity());

 private:
  struct Guess {
    Incumbent start;
    double discover_with = 0.0;  ///< proximal weight of a discovery before the polish; 0: the sequence is kept
    bool planned = false;        ///< of an earlier plan
  };
  Incumbent first_guess(const ContactSequence& sequence, const Tuning& tuning) const;
  Incumbent at_once(const ContactSequence& sequence);
  ContactSequence initial(Search& search, const Tuning& tuning, Ending& ending) const;
  std::vector<Guess> stepping(const Tuning& tuning) const;
  std::vector<Guess> guesses(const Incumbent& start, const Incumbent* warm) const;
  Ending attempt(std::vector<Guess> guesses, const Tuning& tuning);
  Ending attempt_and_mend(std::vector<Guess> guesses, const Tuning& tuning);
  Ending mend_last(Ending ending, const Tuning& tuning);
  Ending mend_cheapest(Ending ending);
  class Guesses;
  bool take_over(Guesses& guesses, int i, double lowest);
  Incumbent cheapest(const std::vector<Guess>& guesses, const Tuning& tuning, Ending& ending);
  Ending restart(Ending ending, const ContactSequence& initial, Tuning tuning);
  Ending hold_limits(Ending ending, Tuning tuning);
  class FewPhases;
  Ending vary(Ending ending, const Tuning& tuning);
  bool asks_too_much_of_joints() const;
  bool falls_short() const;
  double further_inside() const;
  Ending late(Ending ending) const;
  void keep(const Incumbent& now, const Tuning& tuning);
  std::vector<Violation> finish(Incumbent now, const Tuning& tuning);

  const Problem problem_;
  const std::vector<int> surfaces_;
  const Tuning first_;  ///< tuning of the first attempt
  const Deadline* deadline_;
  BestPlan* best_;
  Search search_;
  Incumbent last_;                 ///< of the last attempt, before its contacts were made exact
  std::vector<Violation> missed_;  ///< by it
  std::vector<double> mended_;     ///< costs of the near misses that were mended at once
  struct NearMiss {
    Incumbent at;
    Tuning tuning;
  };
  std::optional<NearMiss> cheapest_;  ///< of those that became too dear
  bool too_dear_ = false;             ///< what was mended last
};

}  // namespace mcplan::ddp
