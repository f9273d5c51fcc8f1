#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ddp/constants.hpp"
#include "ddp/ending.hpp"
#include "ddp/local_model.hpp"
#include "ddp/polish/interior_point.hpp"
#include "ddp/pricing.hpp"
#include "ddp/value_functions.hpp"
#include "ddp/whole_sequence.hpp"
#include "mcplan/base/deadline.hpp"
#include "mcplan/plan/report.hpp"

namespace mcplan::ddp {

/// Adds the time of a scope to a named part of the report.
class Stopwatch {
 public:
  Stopwatch(std::map<std::string, double>& timing, const char* part)
      : timing_(&timing), part_(part), start_(std::chrono::steady_clock::now()) {}
  ~Stopwatch() {
    (*timing_)[part_] += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  std::map<std::string, double>* timing_;
  const char* part_;
  std::chrono::steady_clock::time_point start_;
};

/// The iteration table, row by row, with its head every 20 rows; a null logger is none.
void log_row(const Logger& logger, const Iteration& row);

class Lanes;

/// Where a search stands: motion, contact sequence and what they truly cost.
struct Incumbent {
  Trajectory trajectory;
  ContactSequence sequence;
  Evaluation evaluation;
};

/// Descends from a first guess in three stages: discover() with a growing contact weight and the sequence free,
/// polish() with the sequence frozen, refine() by trying changed sequences one by one on the true cost. Each returns
/// Ending::done to go on, or why it stopped; `now` always holds the best iterate. All are told the tuning of the
/// attempt that they belong to.
class Search {
 public:
  Search(const Problem& problem, const Deadline& deadline, Report& report);
  ~Search();
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  /// Switched DDP with growing w_compl (Tazaki, Algorithm 1) and a proximal term.
  Ending discover(Incumbent& now, double proximal_weight, const Tuning& tuning);

  /// Gauss-Newton at the full weights until the merit is calm. Gives up once the merit, extrapolated, stays above
  /// `give_up_above`.
  Ending polish(Incumbent& now, int iterations, double tolerance, double give_up_above, const Tuning& tuning);

  /// The optimum of the motion with the sequence frozen, by the interior point.
  Ending optimise(Incumbent& now, const polish::Settings& settings, const Tuning& tuning);

  /// Where a guess of an attempt comes from: discover(), a sequence alone, or an earlier plan.
  enum class Origin { discovered, sequence, plan };

  /// One guess of an attempt, its last polish, and a trial of refine(), by the polish that the options ask for.
  Ending polish_guess(Incumbent& now, Origin origin, double give_up_above, const Tuning& tuning);
  Ending polish_last(Incumbent& now, const Tuning& tuning, double tolerance = kFinalTolerance);
  Ending polish_trial(Incumbent& now, double give_up_above, const Tuning& tuning);

  /// Best-neighbour search on the true cost: neighbours and swing edits, cheapest by the local model first, each
  /// polished for a few iterations and kept if the merit falls.
  Ending refine(Incumbent& now, const Tuning& tuning);

  /// Try every tail_edits() of the sequence, in order, from the first guess of each, until one lowers the merit.
  Ending change_tail(Incumbent& now, const Tuning& tuning, bool& improved);

  /// Tazaki's Algorithms 1 and 2 as published, for `iterations`: full defect steps of fixed length, switches accepted
  /// on the quadratic model, J* from infinity, every neighbour priced by MINCOST.
  Ending run_paper(Incumbent& now, int iterations, const Tuning& tuning);

  /// Close the dynamics defects to rounding with the contacts exact: end-effectors on their surfaces and at rest, no
  /// force where there is no contact. False when that does not converge, or `give_up`, asked at every step of it, says
  /// so; `now` is then unchanged.
  bool make_exact(Incumbent& now, const Tuning& tuning, const StopRequest& give_up = nullptr);

  /// Called with every new iterate of discover(), polish() and run_paper() and the tuning in force; null: never.
  using Watcher = std::function<void(const Incumbent&, const Tuning&)>;
  void watch(Watcher watcher) { watcher_ = std::move(watcher); }

  /// What a search has done for another one at the same problem, which can tell of it as if it had been there.
  struct Trace {
    Report report;  ///< its rows, and what it has taken; iterations are counted from the other's on
    int first = 0;  ///< the other's at its beginning
    std::vector<std::pair<Incumbent, Tuning>> iterates;  ///< one a row
    /// Merits that a polish foresaw, after so many rows: it would have given up for a lower one.
    std::vector<std::pair<int, double>> foreseen;
  };

  /// Go on as `main` would, asking `stop` for the caller's: iterates and rows go to the trace, nothing is logged.
  void stand_in_for(const Search& main, Trace& trace, StopRequest stop);

  /// Tell of the first `rows` rows of a trace, or of all for a negative number. False, and nothing is told, where the
  /// limit on iterations would have cut it short.
  bool replay(Trace&& trace, int rows);

  /// Whether the interior point polishes.
  bool exact_contacts(const Tuning& tuning) const {
    const bool chosen = problem_->options.polish == Polish::interior_point && !tuning.penalty;
    return tuning.exact || chosen;
  }

  /// From now on refine() and change_tail() try no sequence again where an earlier trial has shown that the interior
  /// point ends no lower: attempts that come to the same optimum go on to others. Forgets what was known; false: as
  /// before.
  void keep_known(bool yes) { known_ = yes ? std::make_unique<std::map<ContactSequence, double>>() : nullptr; }

  /// Forget what earlier attempts have left behind.
  void begin_anew() { polish_proximal_ = kPolishProximal; }

  /// Every later stage ends as interrupted.
  void interrupt() { interrupted_ = true; }

  /// Other threads' searches at the problem.
  Lanes& lanes();

  const Problem& problem() const { return *problem_; }
  LocalModel& model() { return model_; }
  Report& report() { return *report_; }
  Evaluation evaluate(const Incumbent& at, const Tuning& tuning);  ///< at the full weights

 private:
  struct Candidate {
    Trajectory trajectory;
    Evaluation evaluation;
    double step = 0.0;
  };

  struct Tried {
    Ending ending = Ending::done;
    int count = 0;
    bool improved = false;
  };
  using Polisher = std::function<Ending(Search& search, Incumbent& now, double merit)>;
  Tried try_until_better(Incumbent& now, const std::vector<Incumbent>& starts, const Polisher& polish);

  Schedule full_schedule(const Tuning& tuning) const;
  Ending iterate(Incumbent& now, Schedule& schedule, bool free_sequence);
  bool line_search(const Incumbent& now, const ContactSequence& sequence, const Schedule& schedule, double merit,
                   Candidate& best);
  int switch_contacts(ContactSequence& sequence, Iteration& row);
  bool paper_switches(Incumbent& now, Iteration& row);
  std::vector<ContactSequence> ranked_changes(const Incumbent& now, const Tuning& tuning);
  bool known_no_lower(const ContactSequence& sequence, double merit) const;
  Ending polish_plan(Incumbent& now, const Tuning& tuning);
  bool should_stop(Ending& ending) const;
  void record(Iteration&& row, const Incumbent& now, const Schedule& schedule);
  void tell(Iteration&& row);
  void show(const Incumbent& now, const Tuning& tuning);

  const Problem* problem_;
  const Deadline* deadline_;
  Report* report_;
  LocalModel model_;
  ValueFunctions values_;
  Pricing pricing_;
  Evaluator evaluate_;
  std::vector<Eigen::VectorXd> dx_, du_;
  Candidate stay_, moved_;
  double polish_proximal_ = kPolishProximal;
  Watcher watcher_;
  Trace* trace_ = nullptr;
  StopRequest stop_;
  bool interrupted_ = false;
  std::unique_ptr<std::map<ContactSequence, double>> known_;  ///< merits below which trials found no motion
  std::unique_ptr<Lanes> lanes_;
  std::unique_ptr<SequenceGraph> graph_;  ///< of the problem, made when it is needed
};

}  // namespace mcplan::ddp
