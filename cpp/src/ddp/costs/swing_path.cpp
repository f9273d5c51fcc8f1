#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/base_rotation.hpp"
#include "ddp/constants.hpp"
#include "ddp/cost_terms.hpp"
#include "plan/clearance.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// The swing of a free foot, as high as it can be lifted, keeps the corners of its sole out of the solids (not in the
/// paper). A share s of the swing's time after lift-off, through as many phases as it has, the foot is on its way
/// between the knots (on_arc), lifted by at most
///
///     4 swing_height 16 s^2 (1 - s)^2
///
/// and held in its reach box, which is what the swings of a plan are chosen from. A sole that is too low goes up with
/// the CoM where that is what limits it, else beside the nearest edge: by a foothold further from it.
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
    const double duration = (*step.u)[at.duration()];
    const Vector3d middle = from + 0.5 * way;
    SwingArc arc = step.arc ? *step.arc : SwingArc();
    if (!arc.known) {
      arc.duration = duration;
      arc.lift_normal = normal_at(problem, from);
      arc.land_normal = normal_at(problem, from + way);
    }
    const double total = arc.before + arc.duration + arc.after;
    // Between two knots of a swing the way bulges by what their velocities carry the foot on.
    const double bulge = 0.25 * (arc.stride_before.norm() + arc.stride_after.norm());
    const double far = 0.5 * way.norm() + bulge + problem.limits[step.l].half_size.norm() + 2.0 * kPathRoom;
    // The sole's corners count in the middle 80 % of the swing's time, of which the CoM is known at the instants.
    constexpr double kEnds[] = {0.1, 0.15, 0.85, 0.9};
    const auto share = [&](double fraction) { return (arc.before + fraction * arc.duration) / total; };
    for (std::size_t i = 0; i < problem.polygons.size(); ++i) {
      if (problem.polygons[i].outside(middle) > far) continue;
      for (const double s : kEnds) {
        const double fraction = (s * total - arc.before) / arc.duration;
        if (fraction > 0.0 && fraction < 1.0) write_at(step, i, arc, s, fraction, nullptr, rows);
      }
      // A toe passes an edge in less time than lies between two instants.
      for (std::size_t j = 0; j + 1 < step.instants.size(); ++j)
        for (int part = 0; part < kParts; ++part) {
          const Between at_time{&step.instants[j], &step.instants[j + 1], static_cast<double>(part) / kParts};
          const double fraction = at_time.fraction(), s = share(fraction);
          if (s > kEnds[0] && s < kEnds[3]) write_at(step, i, arc, s, fraction, &at_time, rows);
        }
    }
  }

 private:
  /// Rows between two instants that follow each other.
  static constexpr int kParts = 8;

  /// Between two instants CoM and base are on straight lines: the CoM leaves that by |p''| dt^2 / 8, a few millimetres.
  struct Between {
    const Instant *before, *after;
    double share;
    double fraction() const { return (1.0 - share) * before->fraction + share * after->fraction; }
    Vector3d com() const { return (1.0 - share) * before->com + share * after->com; }
    Vector3d rpy() const { return (1.0 - share) * before->rpy + share * after->rpy; }
    void add_along(const Vector3d& along_com, const Vector3d& along_rpy, Eigen::Ref<Eigen::VectorXd> g) const {
      before->add_along((1.0 - share) * along_com, (1.0 - share) * along_rpy, g);
      if (share > 0.0) after->add_along(share * along_com, share * along_rpy, g);
    }
  };

  /// A foot q held in its reach box about the CoM p as a plan holds it: with the axes r_i of the base,
  ///
  ///     q - sum_i e_i r_i,   e_i = r_i . (q - p) - limit_i    over the sides that it is beyond.
  ///
  /// The lower side holds no foot down.
  struct Held {
    Vector3d offset = Vector3d::Zero(), beyond = Vector3d::Zero();  ///< q - p, e_i
    Eigen::Matrix3d r_WB = Eigen::Matrix3d::Identity();
    std::array<Vector3d, 3> turned_about;  ///< by roll, pitch and yaw
    bool low = false;                      ///< at the upper side

    void hold(const Between& at, const EndLimits& limit, Vector3d& place) {
      const RpyTrig trig(at.rpy());
      r_WB = trig.rotation();
      for (int i = 0; i < 3; ++i) turned_about[i] = trig.angular_velocity_W(Vector3d::Unit(i));
      offset = place - at.com();
      const Vector3d relative = r_WB.transpose() * offset;
      for (int i = 0; i < 3; ++i) {
        beyond[i] = std::max(relative[i] - limit.reach_max[i], 0.0);
        if (i < 2) beyond[i] += std::min(relative[i] - limit.reach_min[i], 0.0);
      }
      low = beyond.z() > 0.0;
      place -= r_WB * beyond;
    }

    /// What moves the held place along `along`: `along` itself becomes what moves q, the rest goes to CoM and base.
    void add_along(const Between& at, Vector3d& along, Eigen::Ref<Eigen::VectorXd> g) const {
      const Vector3d given = along;
      Vector3d by_com = Vector3d::Zero(), by_rpy = Vector3d::Zero();
      for (int i = 0; i < 3; ++i) {
        if (beyond[i] == 0.0) continue;
        const Vector3d axis = r_WB.col(i), pull = given.dot(axis) * offset + beyond[i] * given;
        by_com += given.dot(axis) * axis;
        for (int k = 0; k < 3; ++k) by_rpy[k] -= turned_about[k].dot(axis.cross(pull));
      }
      along -= by_com;
      at.add_along(by_com, by_rpy, g);
    }
  };

  /// The corner of a sole that is deepest inside a solid, by the shorter way out of it: up or beside an edge.
  struct Corner {
    Vector3d place;
    int side = -1;  ///< the nearest edge; -1: all are outside
  };
  static Corner deepest_corner(const Polygon& polygon, double thickness, const Eigen::Vector2d& half,
                               const Vector3d& place, const Eigen::Matrix3d& sole) {
    Corner out;
    double deepest = 0.0;
    for (double x : {-1.0, 1.0})
      for (double y : {-1.0, 1.0}) {
        const Vector3d corner = place + x * half.x() * sole.col(0) + y * half.y() * sole.col(1);
        const double height = polygon.height(corner), beside = polygon.outside(corner);
        if (height < -thickness) continue;
        const double depth = std::min(kPathRoom - height, kPathRoom - beside);
        if (!(depth > deepest)) continue;
        deepest = depth;
        out.place = corner;
        out.side = 0;
        for (int e = 1; e < polygon.edge_count(); ++e)
          if (polygon.overshoot(e, corner) > polygon.overshoot(out.side, corner)) out.side = e;
      }
    return out;
  }

  static bool stands_on(const Polygon& polygon, const Vector3d& place) {
    return std::abs(polygon.height(place)) < kPathRoom && polygon.outside(place) < kPathRoom;
  }

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

  /// The row at a fraction of the phase; `s_given` is the share of the swing there by the durations that are given, by
  /// which the sole turns. Without `body` the reach box is left out.
  static void write_at(const StepView& step, std::size_t solid, const SwingArc& arc, double s_given, double fraction,
                       const Between* body, Rows& rows) {
    const Problem& problem = step.problem;
    const Layout& at = problem.layout;
    const Polygon& polygon = problem.polygons[solid];
    const EndLimits& limit = problem.limits[step.l];
    const Vector3d between = (1.0 - s_given) * arc.lift_normal + s_given * arc.land_normal;
    if (between.norm() < 0.1) return;  // from a wall to the facing one
    const Eigen::Matrix3d sole = sole_frame(between.normalized(), step.sole_yaw);
    const OnArc on = on_arc(arc, fraction, step.x.segment<3>(at.end(step.l)), step.u->segment<3>(at.stride(step.l)),
                            (*step.u)[at.duration()]);
    const double s = on.s, lift_max = kLiftMax * problem.swing_height;
    Vector3d place = on.place + lift_max * 16.0 * s * s * (1.0 - s) * (1.0 - s) * sole.col(2);
    Held held;
    if (body) held.hold(*body, limit, place);
    const Vector3d from = step.x.segment<3>(at.end(step.l)), to = from + step.u->segment<3>(at.stride(step.l));
    // Below what it leaves or reaches a foot has come through it, however thin that is.
    const bool through =
        (arc.before == 0.0 && stands_on(polygon, from)) || (arc.after == 0.0 && stands_on(polygon, to));
    const double thickness = through ? std::numeric_limits<double>::infinity() : problem.thickness[solid];
    const Corner corner = deepest_corner(polygon, thickness, limit.half_size, place, sole);
    if (corner.side < 0) return;
    const double up = polygon.height(corner.place) - kPathRoom;
    const double away = polygon.overshoot(corner.side, corner.place) - kPathRoom;
    // Out of that it goes up by a knot inside the swing as well.
    const bool inside = arc.duration_before > 0.0 || arc.duration_after > 0.0;
    const bool raise = (held.low || (through && inside)) && up > away;
    const double weight = step.schedule.interior_weight, value = raise ? up : away;
    if (!rows.with_gradient()) {
      rows.add_value(weight, value);
      return;
    }
    auto g = rows.add_dense(weight, value);
    Vector3d along = raise ? polygon.normal_W() : polygon.edge_outward_W(corner.side);
    if (body) held.add_along(*body, along, g);
    const double lift_by_s = lift_max * 32.0 * s * (1.0 - s) * (1.0 - 2.0 * s);
    g.segment<3>(at.end(step.l)) += along;
    g.segment<3>(at.nx() + at.stride(step.l)) += on.by_stride * along;
    g[at.nx() + at.duration()] += along.dot(on.by_duration + lift_by_s * on.s_by_duration * sole.col(2));
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
