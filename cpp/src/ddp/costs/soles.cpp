#include "ddp/cost_terms.hpp"
#include "ddp/sole_gap.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector2d;

/// Soles of feet that stand beside each other do not overlap (not in the paper): along the level axis n that parts two
/// of them best, that from the other, at q, to the one, at p, with s how far both reach along it,
///     room + s - n . (p - q) <= 0.
/// Turns on the spot bring heels together else: the reach boxes keep the middles of the soles apart, whichever way they
/// point. The rows are those of the later foot of a pair where that is in contact. The headings are given, and the
/// start is as it is.
class Soles final : public CostTerm {
 public:
  Soles() : CostTerm("soles", Scope::contact, 45) {}

  bool applies(const StepView& step) const override {
    return step.k > 0 && step.schedule.interior_weight > 0.0 && step.sole_yaws && has_sole(step.problem, step.l);
  }

  void write(const StepView& step, Rows& rows) const override {
    const Problem& problem = step.problem;
    const Layout& at = problem.layout;
    for (int other = 0; other < step.l; ++other) {
      if (!has_sole(problem, other)) continue;
      const double room = sole_room(problem.limits[step.l], problem.limits[other]);
      if (!(room > 0.0)) continue;
      const Vector2d apart = step.x.segment<2>(at.end(step.l)) - step.x.segment<2>(at.end(other));
      const SoleGap gap = sole_gap_at(problem, step.k, step.l, step.sole_yaw, other,
                                      (*step.sole_yaws)[static_cast<std::size_t>(other)], apart);
      const double beyond = room + gap.reach - gap.axis.dot(apart);
      if (!(beyond > 0.0)) continue;
      const double weight = step.schedule.interior_weight;
      if (!rows.with_gradient()) {
        rows.add_value(weight, beyond);
        continue;
      }
      auto g = rows.add_dense(weight, beyond);
      g.segment<2>(at.end(step.l)) = -gap.axis;
      g.segment<2>(at.end(other)) = gap.axis;
    }
  }
};

}  // namespace

namespace cost {
const CostTerm& soles() {
  static const Soles term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
