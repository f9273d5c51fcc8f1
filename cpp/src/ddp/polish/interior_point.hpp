#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "ddp/polish/elastic_barrier.hpp"
#include "ddp/polish/limits.hpp"
#include "ddp/polish/riccati.hpp"

namespace mcplan::ddp::polish {

/// How a solve begins and when it ends.
struct Settings {
  double barrier = 1e-3;  ///< first barrier parameter: 1e-5 near a solution, 1e-3 elsewhere
  double proximal = 0.0;  ///< first weight on the change of the inputs
  int max_iterations = 100;
  double tolerance = 1e-4;  ///< converged when less than this fraction of the objective is to be gained
  /// Given up when the objective is foreseen to stay above this one, of which what the motion can change counts
  /// `allowance` times: the barrier falls last, and with it a good part of the objective.
  double give_up_above = std::numeric_limits<double>::infinity();
  double allowance = 1.0;
  int patience = 12;       ///< iterations before that
  bool to_the_end = true;  ///< not: end when the objective hardly changes any more
};

enum class Outcome {
  converged,
  gave_up,    ///< the objective stays above Settings::give_up_above, as far as can be foreseen
  stalled,    ///< no step is accepted any more
  cut_short,  ///< the iteration limit, or the caller
  broke_down  ///< a factorisation failed, or a number is not finite
};

/// One iteration, as the caller sees it.
struct Progress {
  int iteration;
  double objective, defect, barrier, proximal, step;
  double foreseen;  ///< given up if that is above Settings::give_up_above
};

/// The optimum of the motion with the contact sequence given: Gauss-Newton steps of an elastic interior point, accepted
/// by a filter. Theory: docs/theory/ddp.md, "Polish by interior point".
class InteriorPoint {
 public:
  InteriorPoint(const Problem& problem, const ContactSequence& sequence, const Tuning& tuning);

  /// From this motion to the optimum, which takes its place. `go_on` sees every iterate and may end the solve.
  Outcome solve(Trajectory& trajectory, const Settings& settings,
                const std::function<bool(const Trajectory&, const Progress&)>& go_on = nullptr);

  int iterations() const { return iterations_; }
  double constant() const { return costs_.constant(); }  ///< cost of the sequence itself, whatever the motion
  double objective() const { return objective_; }        ///< cost and penalties of what is violated
  double defect() const { return motion_.defect_max(); }
  double gain() const { return gain_; }  ///< decrease of the objective that the last Newton step foresaw

 private:
  double shortened() const;
  bool begin(const Trajectory& trajectory, const Settings& settings);
  bool newton_step();
  void move(double length);
  bool accepts(double slope, double value, double defect, double value_there, double defect_there);
  bool search(double slope);
  void take();
  double foreseen(const Settings& settings) const;
  bool lingers(const Settings& settings) const;

  FixedSequence fixed_;
  Pendulum pendulum_;
  StageCosts costs_;
  Limits limits_;
  ElasticBarrier barrier_;
  Riccati riccati_;
  Motion motion_, trial_;
  RowArray r_, trial_r_, dr_;
  std::vector<Eigen::VectorXd> dz_;
  std::vector<std::pair<double, double>> filter_;  ///< defects and objectives that are not to be seen together again
  std::vector<double> objectives_;                 ///< by iteration
  double mu_ = 0.0, proximal_ = 0.0, step_ = 0.0, objective_ = 0.0, cost_ = 0.0, gain_ = 0.0;
  int iterations_ = 0;
  double max_defect_ = 0.0;
};

}  // namespace mcplan::ddp::polish
