#include <algorithm>
#include <atomic>
#include <limits>
#include <set>
#include <utility>

#include "ddp/attempts.hpp"
#include "ddp/lanes.hpp"

// First guesses of an attempt, of which the cheapest goes on: docs/theory/ddp.md, "1. First guesses".
namespace mcplan::ddp {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// What came of a guess.
struct Polished {
  Incumbent now;
  Ending ending = Ending::done;
  bool discovered = false;  ///< the discovery came to its end
  int rows = 0;             ///< of the report before the polish
  double bound = kNever;    ///< that it was given up above
  bool left = false;        ///< to the main search, which most often does without it
};

/// Of a guess that another thread has polished: after how many rows it would have been given up for the lowest one
/// before it, where it stands then; negative: it would not have been.
int given_up(const Search::Trace& trace, double lowest, Polished& guess) {
  for (const auto& [rows, foreseen] : trace.foreseen) {
    if (!(foreseen > lowest) || rows == 0) continue;
    guess.now = trace.iterates[rows - 1].first;
    guess.ending = Ending::done;
    return rows;
  }
  return -1;
}

/// Whether another thread has given up what it should not have.
bool too_soon(const Search::Trace& trace, const Polished& guess) {
  return std::any_of(trace.foreseen.begin(), trace.foreseen.end(),
                     [&](const auto& seen) { return seen.second > guess.bound; });
}

}  // namespace

/// Discovers and polishes guesses, by the main search or ahead of it.
class Attempts::Guesses {
 public:
  Guesses(const std::vector<Guess>& guesses, const Tuning& tuning, bool exact)
      : guesses_(&guesses), tuning_(&tuning), exact_(exact), out_(guesses.size()), merits_(guesses.size()) {
    for (std::atomic<double>& merit : merits_) merit = kNever;
  }

  Polished& operator[](int i) { return out_[i]; }
  bool discovers(int i) const { return (*guesses_)[i].discover_with > 0.0; }

  void discover(int i, Search& search) {
    out_[i] = {(*guesses_)[i].start};
    if (discovers(i)) out_[i].ending = search.discover(out_[i].now, (*guesses_)[i].discover_with, *tuning_);
    out_[i].discovered = discovers(i) && out_[i].ending == Ending::done;
    out_[i].rows = static_cast<int>(search.report().history.size());
  }

  void polish(int i, Search& search, double lowest) {
    const Search::Origin origin = discovers(i)             ? Search::Origin::discovered
                                  : (*guesses_)[i].planned ? Search::Origin::plan
                                                           : Search::Origin::sequence;
    Polished& guess = out_[i];
    if (guess.ending == Ending::done) guess.ending = search.polish_guess(guess.now, origin, lowest, *tuning_);
  }

  /// In a thread: given up above the cheapest of those before it that are known by then, which is most often no lower
  /// than the one that it will be held against.
  bool go_ahead(int i, Search& search) {
    if (!discovers(i) && stepping_ahead(i)) {
      out_[i].left = true;
      return false;
    }
    discover(i, search);
    double bound = kNever;
    for (int j = 0; j < i; ++j) bound = std::min(bound, merits_[j].load());
    out_[i].bound = bound;
    polish(i, search, bound);
    if (out_[i].ending == Ending::done) merits_[i] = search.evaluate(out_[i].now, *tuning_).merit();
    return out_[i].ending != Ending::done && out_[i].ending != Ending::broke_down;
  }

  /// Whether an earlier one has discovered the same sequence: from it the interior point ends at the same optimum.
  bool known(int i) const { return exact_ && out_[i].discovered && seen_.count(out_[i].now.sequence) > 0; }
  void remember(int i) {
    if (out_[i].discovered) seen_.insert(out_[i].now.sequence);
  }

  /// Threads know nothing of what an earlier plan is held against.
  bool any_planned() const {
    return std::any_of(guesses_->begin(), guesses_->end(), [](const Guess& guess) { return guess.planned; });
  }

 private:
  /// Whether a stepping sequence before this one is the cheapest of those that are known by now.
  bool stepping_ahead(int i) const {
    double discovered = kNever, stepping = kNever;
    for (int j = 0; j < i; ++j) {
      double& lowest = discovers(j) ? discovered : stepping;
      lowest = std::min(lowest, merits_[j].load());
    }
    return stepping < discovered;
  }

  const std::vector<Guess>* guesses_;
  const Tuning* tuning_;
  bool exact_;
  std::vector<Polished> out_;
  std::vector<std::atomic<double>> merits_;
  std::set<ContactSequence> seen_;
};

/// What a thread has made of a guess, as if it had come after those before it. False: it has to be made here.
bool Attempts::take_over(Guesses& guesses, int i, double lowest) {
  const Search::Trace* trace = search_.lanes().trace(i);
  if (!trace || guesses[i].left) return false;
  const bool early = too_soon(*trace, guesses[i]);
  const int rows = guesses.known(i) ? guesses[i].rows : given_up(*trace, lowest, guesses[i]);
  return (rows >= 0 || !early) && search_.lanes().tell(i, rows);
}

/// Polish every guess, those without a sequence of their own after a discovery. The cheapest, empty when all of them
/// broke down.
Incumbent Attempts::cheapest(const std::vector<Guess>& guesses, const Tuning& tuning, Ending& ending) {
  Incumbent chosen;
  double lowest = kNever;
  bool stepping_ahead = false;
  const int count = static_cast<int>(guesses.size());
  Guesses all(guesses, tuning, search_.exact_contacts(tuning));
  search_.lanes().run(all.any_planned() ? 0 : count, [&](int i, Search& search) { return all.go_ahead(i, search); });
  for (int i = 0; i < count && ending == Ending::done; ++i) {
    // The stepping sequences differ in who begins: when the first of them is ahead, the other is no better.
    if (!all.discovers(i) && stepping_ahead) break;
    const bool made = take_over(all, i, lowest);
    if (!made) all.discover(i, search_);
    if (all.known(i)) continue;
    all.remember(i);
    if (!made) all.polish(i, search_, lowest);
    Incumbent& now = all[i].now;
    ending = all[i].ending;
    // A guess that breaks down numerically is dropped, the others may still do.
    if (ending == Ending::broke_down) {
      ending = Ending::done;
      continue;
    }
    const double merit = search_.evaluate(now, tuning).merit();
    if (!std::isfinite(merit) || merit >= lowest) continue;
    lowest = merit;
    stepping_ahead = !all.discovers(i);
    chosen = std::move(now);
  }
  return chosen;
}

}  // namespace mcplan::ddp
