#include <Eigen/Geometry>
#include <algorithm>

#include "ddp/constants.hpp"
#include "ddp/cost_terms.hpp"
#include "plan/clearance.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// The swing of a free foot over a phase, as high as it can be lifted, keeps the corners of its sole out of the solids
/// (not in the paper; once a swing has caught an edge). A share s of the phase's time after its start the foot is at a
/// share s^2 (3 - 2 s) of the straight way, lifted by at most
///
///     min(4 swing_height 16 s^2 (1 - s)^2,  z_CoM + reach_max_z - z),
///
/// which is what the swings of a plan are chosen from. A sole that is too low goes up with the CoM where that is what
/// limits it, else beside the nearest edge: by a foothold further from it.
class SwingPath final : public CostTerm {
 public:
  SwingPath() : CostTerm("swing_path", Scope::free, 30) {}

  bool applies(const StepView& step) const override {
    return step.schedule.tuning.clear_swings && step.between_knots() &&
           step.problem.robot.end_effectors[step.problem.active[step.l]].kind == "foot";
  }

  void write(const StepView& step, Rows& rows) const override {
    const Problem& problem = step.problem;
    const Layout& at = problem.layout;
    const Vector3d from = step.x.segment<3>(at.end(step.l)), way = step.u->segment<3>(at.stride(step.l));
    const Vector3d middle = from + 0.5 * way;
    const Normals normals{normal_at(problem, from), normal_at(problem, from + way)};
    const double far = 0.5 * way.norm() + problem.limits[step.l].half_size.norm() + 2.0 * kPathRoom;
    for (std::size_t i = 0; i < problem.polygons.size(); ++i) {
      const Polygon& polygon = problem.polygons[i];
      if (polygon.outside(middle) > far) continue;
      // The sole's corners count in the middle 80 % of the time, of which the CoM is known at the instants.
      constexpr double kEnds[] = {0.1, 0.15, 0.85, 0.9};
      for (const double time : kEnds) write_at(step, i, normals, time, nullptr, rows);
      for (std::size_t j = 1; j + 1 < step.instants.size(); ++j) {
        const double time = step.instants[j].fraction;
        if (time > kEnds[0] && time < kEnds[3]) write_at(step, i, normals, time, &step.instants[j], rows);
      }
    }
  }

 private:
  /// Of what a swing leaves and reaches, between which the sole turns.
  struct Normals {
    Vector3d lift, land;
  };

  /// The normal of the surface on which an end-effector stands there; up where there is none.
  static Vector3d normal_at(const Problem& problem, const Vector3d& place) {
    Vector3d normal = Vector3d::UnitZ();
    double nearest = kPathRoom;
    for (const Polygon& polygon : problem.polygons) {
      const double off = std::max(std::abs(polygon.height(place)), polygon.outside(place));
      if (!(off < nearest)) continue;
      nearest = off;
      normal = polygon.normal_W();
    }
    return normal;
  }

  static void write_at(const StepView& step, std::size_t solid, const Normals& normals, double s,
                       const Instant* instant, Rows& rows) {
    const Problem& problem = step.problem;
    const Layout& at = problem.layout;
    const Polygon& polygon = problem.polygons[solid];
    const EndLimits& limit = problem.limits[step.l];
    const double share = s * s * (3.0 - 2.0 * s);
    Vector3d place = step.x.segment<3>(at.end(step.l)) + share * step.u->segment<3>(at.stride(step.l));
    double lift = kLiftMax * problem.swing_height * 16.0 * s * s * (1.0 - s) * (1.0 - s);
    const bool limited = instant && instant->com.z() + limit.reach_max.z() - place.z() < lift;
    if (limited) lift = instant->com.z() + limit.reach_max.z() - place.z();
    const Vector3d between = (1.0 - s) * normals.lift + s * normals.land;
    if (between.norm() < 0.1) return;  // from a wall to the facing one
    const Eigen::Matrix3d sole = sole_frame(between.normalized(), step.sole_yaw);
    place += lift * sole.col(2);
    // The corner that is deepest inside, by the shorter way out of it: up or beside an edge.
    double deepest = 0.0;
    int side = -1;
    Vector3d corner_inside;
    for (double x : {-1.0, 1.0})
      for (double y : {-1.0, 1.0}) {
        const Vector3d corner = place + x * limit.half_size.x() * sole.col(0) + y * limit.half_size.y() * sole.col(1);
        const double height = polygon.height(corner), beside = polygon.outside(corner);
        if (height < -problem.thickness[solid]) continue;
        const double depth = std::min(kPathRoom - height, kPathRoom - beside);
        if (!(depth > deepest)) continue;
        deepest = depth;
        corner_inside = corner;
        side = 0;
        for (int e = 1; e < polygon.edge_count(); ++e)
          if (polygon.overshoot(e, corner) > polygon.overshoot(side, corner)) side = e;
      }
    if (side < 0) return;
    const double up = polygon.height(corner_inside) - kPathRoom;
    const double away = polygon.overshoot(side, corner_inside) - kPathRoom;
    const bool raise = limited && up > away;
    const double weight = step.schedule.interior_weight, value = raise ? up : away;
    if (!rows.with_gradient()) {
      rows.add_value(weight, value);
      return;
    }
    auto g = rows.add_dense(weight, value);
    Vector3d along = raise ? polygon.normal_W() : polygon.edge_outward_W(side);
    if (limited) {  // the lift goes with the CoM, and makes up for where the foot is
      const double along_lift = along.dot(sole.col(2));
      instant->add_along({0.0, 0.0, along_lift}, Vector3d::Zero(), g);
      along.z() -= along_lift;
    }
    g.segment<3>(at.end(step.l)) += along;
    g.segment<3>(at.nx() + at.stride(step.l)) += share * along;
  }
};

}  // namespace

namespace cost {
const CostTerm& swing_path() {
  static const SwingPath term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
