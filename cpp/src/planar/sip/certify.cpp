#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>

#include "certify_rows.hpp"
#include "mcplan/base/error.hpp"
#include "mcplan/planar/sip/certificate.hpp"

namespace mcplan::sip {
namespace proof {
namespace {

/// Halvings that are made even where they are not needed for a proof: they cost little, and bounds come close to what
/// they bound.
constexpr int kMinDepth = 2;

struct Place {
  int phase = -1;
  std::string where;
  double time_s = 0.0;
};

/// What is known of each kind so far.
class Ledger {
 public:
  explicit Ledger(const PlanarTolerances& tolerances) : kinds_(planar_constraints(tolerances)) {}

  double tolerance(Kind kind) const { return kinds_[index(kind)].tolerance; }

  /// What a row reaches at a point.
  void reach(const Row& row, int phase, double time_s, double lower) {
    Entry& entry = entries_[index(row.kind)];
    if (!(lower > entry.reached)) return;
    entry.reached = lower;
    entry.reached_at = {phase, row.where, time_s};
  }

  /// The last word on a row over a piece.
  void close(const Row& row, int phase, double time_s, const Amount& amount) {
    Entry& entry = entries_[index(row.kind)];
    const double upper = std::isnan(amount.upper()) ? kInfinity : amount.upper();
    const double limit = tolerance(row.kind);
    // Not of balance: under the least-norm law its bound is nothing but rounding.
    if (row.kind != Kind::balance && limit > 0.0) rounding_ = std::max(rounding_, amount.rounding / limit);
    if (upper <= entry.bound) return;
    entry.bound = upper;
    entry.bound_at = {phase, row.where, time_s};
  }

  /// Whether looking closer at a row whose maximum is at most `upper` would tell nothing new: proved, or violated
  /// elsewhere by about as much.
  bool settled(Kind kind, double upper) const {
    const Entry& entry = entries_[index(kind)];
    const double limit = tolerance(kind);
    if (upper <= limit) return true;
    return entry.reached > limit && upper <= entry.reached + 0.02 * std::abs(entry.reached);
  }

  double rounding() const { return rounding_; }

  std::vector<ProvedConstraint> constraints(bool self_collision) const {
    std::vector<ProvedConstraint> out;
    for (int i = 0; i < kPlanarConstraints; ++i) {
      if (i == index(Kind::finite)) continue;  // plans with other numbers are malformed
      if (i == index(Kind::collision) && !self_collision) continue;
      const Entry& entry = entries_[i];
      ProvedConstraint c;
      c.name = kinds_[i].name;
      c.unit = kinds_[i].unit;
      c.tolerance = kinds_[i].tolerance;
      c.proof = Proof::proved;
      if (entry.bound > -kInfinity) {
        c.bound = entry.bound;
        c.reached = entry.reached;
        const bool violated = entry.reached > c.tolerance;
        c.proof = violated ? Proof::violated : entry.bound <= c.tolerance ? Proof::proved : Proof::not_proved;
        const Place& place = violated ? entry.reached_at : entry.bound_at;
        c.phase = place.phase;
        c.where = place.where;
        c.time_s = place.time_s;
      }
      out.push_back(c);
    }
    return out;
  }

 private:
  struct Entry {
    double bound = -kInfinity, reached = -kInfinity;
    Place bound_at, reached_at;
  };
  static int index(Kind kind) { return static_cast<int>(kind); }

  std::array<PlanarConstraintInfo, kPlanarConstraints> kinds_;
  std::array<Entry, kPlanarConstraints> entries_;
  double rounding_ = 0.0;
};

/// Halves an interval, depth first, until every row of it is settled or it is asked to stop. Returns the number of
/// pieces.
int prove(const IntervalRows& interval, int max_depth, const StopRequest& stop, Ledger& ledger) {
  struct Piece {
    double middle, half_width;
    int depth;
    std::vector<int> rows;
  };
  std::vector<int> all(interval.rows().size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<Piece> stack{{0.0, 1.0, 0, all}};
  int pieces = 0;
  while (!stack.empty() && !(stop && stop())) {
    const Piece piece = std::move(stack.back());
    stack.pop_back();
    ++pieces;
    const std::vector<Amount> amounts = interval.evaluate(piece.middle, piece.half_width, piece.rows);
    const auto time_s = [&](const Amount& amount) {
      return interval.time_s(piece.middle + piece.half_width * Amount::place(amount.worst_place()));
    };
    const int phase = interval.interval().phase;
    for (std::size_t i = 0; i < amounts.size(); ++i)
      ledger.reach(interval.rows()[piece.rows[i]], phase, time_s(amounts[i]), amounts[i].lower());
    std::vector<int> open;
    for (std::size_t i = 0; i < amounts.size(); ++i) {
      const Row& row = interval.rows()[piece.rows[i]];
      const bool settled = piece.depth >= kMinDepth && ledger.settled(row.kind, amounts[i].upper());
      if (piece.depth >= max_depth || settled)
        ledger.close(row, phase, time_s(amounts[i]), amounts[i]);
      else
        open.push_back(piece.rows[i]);
    }
    if (open.empty()) continue;
    const double quarter = 0.5 * piece.half_width;
    stack.push_back({piece.middle + quarter, quarter, piece.depth + 1, open});
    stack.push_back({piece.middle - quarter, quarter, piece.depth + 1, std::move(open)});
  }
  return pieces;
}

void require_valid(const CertifyOptions& options) {
  if (options.order < 2 || options.order > max_order)
    throw InvalidOptions("order", "must be in 2.." + text(max_order), text(options.order));
  // Middles of pieces are exact: 40 halvings take 41 of a double's 53 bits.
  if (options.max_depth < 0 || options.max_depth > 40)
    throw InvalidOptions("max_depth", "must be in 0..40", text(options.max_depth));
}

}  // namespace
}  // namespace proof

Certificate certify(const PlanarPlan& plan, const CertifyOptions& options) {
  using namespace proof;
  const auto start = std::chrono::steady_clock::now();
  require_valid(options);
  plan.validate();

  std::vector<PhaseConstants> constants;
  for (std::size_t k = 0; k < plan.task.phases.size(); ++k)
    constants.push_back(phase_constants(plan, static_cast<int>(k)));
  std::vector<IntervalRows> intervals;
  for (int i = 0; i < plan.task.interval_count(); ++i)
    intervals.emplace_back(plan, constants[plan.task.phase_of(i)], i, options.order, options.self_collision);

  Ledger ledger(options.tolerances);
  for (const InstantRow& instant : instant_rows(plan, constants, intervals, options.order)) {
    ledger.reach(instant.row, instant.phase, instant.time_s, instant.amount.lower());
    ledger.close(instant.row, instant.phase, instant.time_s, instant.amount);
  }
  Certificate out;
  bool stopped = false;
  const StopRequest stop = [&] { return stopped = stopped || (options.stop && options.stop()); };
  for (const IntervalRows& interval : intervals) out.subdivisions += prove(interval, options.max_depth, stop, ledger);
  out.constraints = ledger.constraints(options.self_collision);
  if (stopped)
    for (ProvedConstraint& constraint : out.constraints)
      if (constraint.proof == Proof::proved) constraint.proof = Proof::not_proved;
  out.rounding = ledger.rounding();
  out.time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

}  // namespace mcplan::sip
