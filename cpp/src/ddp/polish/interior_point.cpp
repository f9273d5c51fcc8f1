#include "ddp/polish/interior_point.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ddp/constants.hpp"

namespace mcplan::ddp::polish {
namespace {

/// Where the barrier ends: a violation is then some y / w^2 with y s = mu, below the checker's tolerances.
constexpr double kBarrierMin = 1e-6, kBarrierMax = 1e-2;
/// Sum of the defects that counts as closed.
constexpr double kClosed = 1e-5;
/// Sum of the defects down to which a step from closed ones may open them again, since it is linear: a bound as tight
/// as the other one leaves steps of a hundredth. Measured.
constexpr double kOpened = 1e-2;
/// A step changes no duration by more than this fraction and no stiffness by more than that (of standing: 1). Without,
/// bad first guesses lead to objectives of 1e10 (measured on a prototype).
constexpr double kDurationChange = 0.5, kStiffnessChange = 1.0;
/// Sum of the defects that the filter admits, or the first iterate's if that is more. Measured on gap_with_rail:
/// without one sequence of two does not converge in 100 iterations, with 0.3 they take longer.
constexpr double kDefectMax = 1.0;
/// A step may raise the merit, objective + kDefectPenalty x defects, so many times: the filter alone lets the objective
/// rise tenfold where that closes defects. Chosen.
constexpr double kGrowth = 3.0;
/// Halvings of a step before it is taken as it is or given up.
constexpr int kHalvings = 8;
/// Margins of the filter, in defects and in the objective; Armijo's factor where only the latter is left to improve.
constexpr double kFilterMargin = 1e-5, kArmijo = 1e-4;
/// A step shorter than this asks for a proximal weight, a longer one than that for less of it.
constexpr double kShort = 0.1, kLong = 0.9;
constexpr double kProximalFirst = 0.1, kProximalFactor = 10.0, kProximalFall = 3.0, kProximalMax = 1e6;
/// Iterations over which progress is judged before a solve is given up; it is extrapolated by three times as many.
constexpr std::size_t kWindow = 3;
constexpr double kWindowsAhead = 3.0;
/// Iterations over which the objective must change by more than the tolerance.
constexpr std::size_t kLingering = 8;

/// Vanderbei's rule (LOQO): the barrier falls with the mean complementarity, and hardly where the products of slacks
/// and multipliers are far from equal.
double next_barrier(const ElasticBarrier& at, double mu) {
  const double xi = std::max(at.centrality(), 1e-12);
  const double factor = std::min(0.05 * (1.0 - xi) / xi, 2.0);
  const double next = 0.1 * factor * factor * factor * at.complementarity();
  return std::clamp(std::min(next, 2.0 * mu), kBarrierMin, kBarrierMax);
}

}  // namespace

InteriorPoint::InteriorPoint(const Problem& problem, const ContactSequence& sequence, const Tuning& tuning)
    : fixed_(problem, sequence),
      pendulum_(problem.layout, problem.inertia, problem.options.stiffness_input, problem.model),
      costs_(fixed_, pendulum_, tuning),
      limits_(fixed_, pendulum_, tuning),
      barrier_(limits_.precision()),
      riccati_(fixed_),
      motion_(fixed_),
      trial_(fixed_),
      r_(limits_.count()),
      trial_r_(limits_.count()),
      dr_(limits_.count()),
      dz_(problem.steps + 1) {}

/// The largest step that changes durations and stiffness by no more than is sensible.
double InteriorPoint::shortened() const {
  double step = 1.0;
  for (int k = 0; k < fixed_.steps(); ++k) {
    const Phase& phase = fixed_.phase(k);
    const double h = motion_.trajectory.u[k][phase.inputs.back()], dh = std::abs(dz_[k][fixed_.size(k) - 1]);
    if (step * dh > kDurationChange * std::abs(h)) step = kDurationChange * std::abs(h) / dh;
    for (const Standing& s : phase.standing) {
      const double change = std::abs(dz_[k][phase.moving[s.stiffness]]);
      if (step * change > kStiffnessChange) step = kStiffnessChange / change;
    }
  }
  return step;
}

bool InteriorPoint::newton_step() {
  barrier_.linearise(r_, mu_);
  for (;;) {
    for (int k = 0; k <= fixed_.steps(); ++k) {
      StageModel& model = riccati_.model(k);
      model.g.setZero();
      model.h.setZero();
      costs_.add(motion_, k, model);
      limits_.add(motion_, k, barrier_.newton_multipliers(), barrier_.weights(), model);
    }
    if (riccati_.solve(motion_, proximal_, dz_)) return true;
    proximal_ = std::max(kProximalFactor * proximal_, kProximalFirst);
    if (proximal_ > kProximalMax) return false;
  }
}

/// The trial point at this fraction of the Newton step.
void InteriorPoint::move(double length) {
  const int nx = fixed_.nx();
  for (int k = 0; k <= fixed_.steps(); ++k) {
    trial_.trajectory.x[k] = motion_.trajectory.x[k] + length * dz_[k].head(nx);
    if (k == fixed_.steps()) break;
    const std::vector<int>& inputs = fixed_.phase(k).inputs;
    for (std::size_t j = 0; j < inputs.size(); ++j)
      trial_.trajectory.u[k][inputs[j]] =
          motion_.trajectory.u[k][inputs[j]] + length * dz_[k][nx + static_cast<int>(j)];
  }
}

/// Whether a trial point is better than all before it, in its defects or in its objective.
bool InteriorPoint::accepts(double slope, double value, double defect, double value_there, double defect_there) {
  if (!(defect_there < max_defect_) || !std::isfinite(value_there)) return false;
  for (const auto& [d, v] : filter_)
    if (defect_there >= d && value_there >= v) return false;
  // Where the defects are closed, only the objective can improve.
  if (defect < kClosed && slope < 0.0)
    return defect_there < kOpened && value_there <= value + kArmijo * step_ * slope + 1e-12 * std::abs(value);
  const double d = (1.0 - kFilterMargin) * defect, v = value - kFilterMargin * defect;
  if (defect_there > d && value_there > v) return false;
  filter_.emplace_back(d, v);
  return true;
}

/// Shorten the step until the filter accepts it, and the merit does not rise too far unless no other step is left; the
/// trial point is what it leads to.
bool InteriorPoint::search(double slope) {
  const double defect = motion_.defect_sum(), value = cost_ + barrier_.value(r_, mu_);
  const double longest = shortened(), merit_max = kGrowth * (objective_ + kDefectPenalty * defect);
  for (const bool bounded : {true, false}) {
    step_ = longest;
    for (int i = 0; i <= kHalvings; ++i, step_ *= 0.5) {
      move(step_);
      if (!trial_.evaluate(pendulum_)) continue;
      limits_.values(trial_, trial_r_);
      const double cost = costs_.value(trial_), defect_there = trial_.defect_sum();
      if (bounded && cost + barrier_.penalty(trial_r_) + kDefectPenalty * defect_there > merit_max) continue;
      if (!accepts(slope, value, defect, cost + barrier_.value(trial_r_, mu_), defect_there)) continue;
      cost_ = cost;
      return true;
    }
  }
  return false;
}

/// Begin at a motion.
bool InteriorPoint::begin(const Trajectory& trajectory, const Settings& settings) {
  motion_.trajectory = trajectory;
  fixed_.impose(motion_.trajectory);
  fixed_.problem().set_sole_yaw(fixed_.contacts(), motion_.trajectory);
  set_swing_arcs(fixed_.problem(), fixed_.contacts(), motion_.trajectory);
  trial_.trajectory = motion_.trajectory;
  proximal_ = settings.proximal;
  mu_ = settings.barrier;
  iterations_ = 0;
  filter_.clear();
  objectives_.clear();
  if (!motion_.evaluate(pendulum_)) return false;
  max_defect_ = std::max(motion_.defect_sum(), kDefectMax);
  limits_.head(motion_.trajectory);
  limits_.relax_from(motion_);
  limits_.values(motion_, r_);
  barrier_.start(r_, mu_);
  cost_ = costs_.value(motion_);
  objective_ = cost_ + barrier_.penalty(r_);
  return true;
}

/// Take the trial point, with the multipliers, headings and barrier that belong to it.
void InteriorPoint::take() {
  if (step_ < kShort)
    proximal_ = std::max(kProximalFactor * proximal_, kProximalFirst);
  else if (step_ >= kLong)
    proximal_ = proximal_ > kProximalFirst ? proximal_ / kProximalFall : 0.0;
  std::swap(motion_, trial_);
  barrier_.step(dr_, trial_r_);
  fixed_.problem().set_sole_yaw(fixed_.contacts(), motion_.trajectory);
  set_swing_arcs(fixed_.problem(), fixed_.contacts(), motion_.trajectory);
  trial_.trajectory.sole_yaw = motion_.trajectory.sole_yaw;
  trial_.trajectory.knot_yaw = motion_.trajectory.knot_yaw;
  trial_.trajectory.swing_arcs = motion_.trajectory.swing_arcs;
  limits_.head(motion_.trajectory);
  if (limits_.relaxed()) limits_.relax(motion_);
  limits_.values(motion_, r_);
  objective_ = cost_ + barrier_.penalty(r_);
  const double next = next_barrier(barrier_, mu_);
  if (next != mu_) filter_.clear();  // objectives of another barrier do not compare
  mu_ = next;
}

/// The objective extrapolated, from the lowest of the last ones, since a step may raise it for a moment; what the
/// motion can change of it is divided by the allowance. Defects are closed faster, and do not count.
double InteriorPoint::foreseen(const Settings& settings) const {
  if (iterations_ < settings.patience || objectives_.size() <= kWindow) return -std::numeric_limits<double>::infinity();
  const double fixed = costs_.constant();
  const double now = objectives_.back(), fall = objectives_[objectives_.size() - 1 - kWindow] - now;
  const double low = *std::min_element(objectives_.end() - 1 - kWindow, objectives_.end());
  return fixed + (low - kWindowsAhead * std::max(fall, 0.0) - fixed) / settings.allowance;
}

/// Whether the objective has hardly changed for a while, at the last barrier parameter.
bool InteriorPoint::lingers(const Settings& settings) const {
  if (settings.to_the_end || mu_ > kBarrierMin || objectives_.size() < kLingering) return false;
  const auto [low, high] = std::minmax_element(objectives_.end() - kLingering, objectives_.end());
  return *high - *low < settings.tolerance * std::abs(*low) && motion_.defect_sum() < kOpened;
}

Outcome InteriorPoint::solve(Trajectory& trajectory, const Settings& settings,
                             const std::function<bool(const Trajectory&, const Progress&)>& go_on) {
  if (costs_.constant() > settings.give_up_above) return Outcome::gave_up;
  if (!begin(trajectory, settings)) return Outcome::broke_down;
  Outcome outcome = Outcome::cut_short;
  while (iterations_ < settings.max_iterations) {
    if (!newton_step()) {
      outcome = Outcome::broke_down;
      break;
    }
    limits_.along(motion_, dz_, dr_);
    const double slope = costs_.slope(dz_) + barrier_.slope(r_, dr_, mu_);
    gain_ = -slope;
    if (mu_ <= kBarrierMin && motion_.defect_sum() < kClosed && std::abs(gain_) < settings.tolerance * objective_) {
      outcome = Outcome::converged;
      break;
    }
    ++iterations_;
    if (!search(slope)) {
      // A shorter step lies in another direction.
      proximal_ = std::max(kProximalFactor * proximal_, kProximalFirst);
      filter_.clear();
      if (proximal_ <= kProximalMax) continue;
      outcome = Outcome::stalled;
      break;
    }
    take();
    objectives_.push_back(objective_);
    const double ahead = foreseen(settings);
    if (go_on &&
        !go_on(motion_.trajectory, {iterations_, objective_, motion_.defect_max(), mu_, proximal_, step_, ahead}))
      break;
    if (ahead > settings.give_up_above) {
      outcome = Outcome::gave_up;
      break;
    }
    if (!lingers(settings)) continue;
    outcome = Outcome::stalled;
    break;
  }
  trajectory = motion_.trajectory;
  return outcome;
}

}  // namespace mcplan::ddp::polish
