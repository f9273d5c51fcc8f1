#include "ddp/joined_ground.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "mcplan/robot/standing.hpp"
#include "mcplan/scene/polygon.hpp"

namespace mcplan::ddp {

bool JoinedGround::fits(const Plan& plan) const {
  const std::vector<Surface>&own = plan.scene.surfaces, &pieces = pieces_->surfaces;
  return std::equal(own.begin(), own.end(), pieces.begin(), pieces.end(),
                    [](const Surface& a, const Surface& b) { return a.name == b.name; });
}

void JoinedGround::join(std::vector<int>& contacts) const {
  for (int& surface : contacts)
    if (surface >= 0 && surface < static_cast<int>(joined_.index.size())) surface = joined_.index[surface];
}

Plan JoinedGround::join(Plan plan) const {
  plan.scene = joined_.scene;
  for (Phase& phase : plan.phases)
    for (Contact& contact : phase.contacts)
      if (contact.surface >= 0) contact.surface = joined_.index[contact.surface];
  join(plan.final_contacts);
  return plan;
}

/// The piece that is named, where it is one of the surface's and below the end-effector, or the one that is.
int JoinedGround::piece_at(int surface, const Eigen::Vector3d& place_W, int named) const {
  constexpr double kBeside_m = 0.02;  // a foot on a seam is on both; stances move feet onto what they name
  const auto outside = [&](int i) { return Polygon(pieces_->surfaces[i].vertices_W).outside(place_W); };
  if (named >= 0 && joined_.index[named] == surface && outside(named) <= kBeside_m) return named;
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < static_cast<int>(joined_.index.size()); ++i) {
    if (joined_.index[i] != surface) continue;
    const double beyond = outside(i);
    if (beyond < least) best = i;
    least = std::min(least, beyond);
  }
  return best;
}

Plan JoinedGround::take_apart(Plan plan) const {
  plan.scene = *pieces_;
  if (plan.knots.empty()) return plan;
  const int phases = static_cast<int>(plan.phases.size());
  const std::vector<int> starts = resolve_stance(*pieces_, plan.robot, pieces_->start, "start").contacts,
                         ends = resolve_stance(*pieces_, plan.robot, pieces_->goal, "goal").contacts;
  for (int l = 0; l < plan.end_effector_count(); ++l) {
    const auto at = [&](int k) -> int& {
      return k < phases ? plan.phases[k].contacts[l].surface : plan.final_contacts[l];
    };
    for (int first = 0, end = 0; first <= phases; first = end) {
      const int surface = at(first);
      for (end = first + 1; end <= phases && at(end) == surface;) ++end;
      const int named = first == 0 && !plan.measured_start ? starts[l] : end > phases ? ends[l] : -1;
      if (surface < 0) continue;
      const int piece = piece_at(surface, plan.knots[first].end_effectors_W[l], named);
      for (int k = first; k < end; ++k) at(k) = piece;
    }
  }
  return plan;
}

void JoinedGround::take_apart(std::vector<int>& contacts) const {
  for (int& surface : contacts) {
    const auto first = std::find(joined_.index.begin(), joined_.index.end(), surface);
    if (surface >= 0) surface = static_cast<int>(first - joined_.index.begin());
  }
}

}  // namespace mcplan::ddp
