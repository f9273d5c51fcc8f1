#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/base_rotation.hpp"
#include "ddp/constants.hpp"
#include "ddp/cost_terms.hpp"
#include "plan/clearance.hpp"
#include "plan/swing_lift.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// The swing of a free foot, as high as it can be lifted, keeps the corners of its sole out of the solids (not in the
/// paper). A share s of the swing's time after lift-off, through as many phases as it has, the foot is on its way
/// between the knots (on_arc), lifted by at most
///
///     4 swing_height b(s),  b of SwingLift,
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
    const Vector3d middle = from + 0.5 * way;
    SwingArc arc = step.arc ? *step.arc : SwingArc();
    if (!arc.known) {
      arc.duration = (*step.u)[at.duration()];
      arc.lift_normal = normal_at(problem, from);
      arc.land_normal = normal_at(problem, from + way);
    }
    // Between two knots of a swing the way bulges by what their velocities carry the foot on.
    const double bulge = 0.25 * (arc.stride_before.norm() + arc.stride_after.norm());
    const double far = 0.5 * way.norm() + bulge + problem.limits[step.l].half_size.norm() + 2.0 * problem.swing_room;
    static thread_local std::vector<Sample> samples;  // nothing is allocated once it is long enough
    samples.clear();
    for (std::size_t i = 0; i < problem.polygons.size(); ++i) {
      const Polygon& polygon = problem.polygons[i];
      if (polygon.outside(middle) > far) continue;
      if (samples.empty()) find_samples(step, arc, samples);
      const Passing passing(polygon, problem.thickness[i], arc, from, from + way);
      for (const Sample& sample : samples)
        if (passing.across || !sample.fine) write_at(step, polygon, passing, sample, rows);
    }
  }

 private:
  /// Samples between two instants that follow each other: a toe that moves by 2 kPathRoom from one to the next passes
  /// an edge between them unseen. Every other one is left out but of what a swing goes across, of which both edges
  /// count.
  static constexpr int kParts = 16;
  /// On rows of what a swing goes across, of which there are twice as many. Chosen.
  static constexpr double kAcrossWeight = 0.5;

  /// Between two instants CoM and base are on straight lines: the CoM leaves that by |p''| dt^2 / 8, a few millimetres.
  struct Between {
    const Instant *before = nullptr, *after = nullptr;
    double share = 0.0;
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
  /// The lower side holds no foot down. A face n . x <= max that cuts the box, in turn, holds it along the axis a of
  /// which the face cuts off most,
  ///
  ///     q - e r_a / n_a,   e = n . R'(q - p) - max.
  struct Held {
    struct AtCut {
      int axis = 0;
      Vector3d normal_B, offset;  ///< n, q - p
      double moved = 0.0;         ///< e / n_a
    };
    Vector3d offset = Vector3d::Zero(), beyond = Vector3d::Zero();  ///< q - p, e_i
    Eigen::Matrix3d r_WB = Eigen::Matrix3d::Identity();
    std::array<Vector3d, 3> turned_about;  ///< by roll, pitch and yaw
    std::array<AtCut, kReachCuts> cuts;
    int cut_count = 0;
    bool low = false;  ///< at the upper side

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
      for (int i = 0; i < limit.cuts; ++i) hold_at(limit.cut_A.row(i).transpose(), limit.cut_b[i], at.com(), place);
    }

    void hold_at(const Vector3d& normal_B, double max, const Vector3d& com, Vector3d& place) {
      AtCut cut;
      cut.normal_B = normal_B;
      cut.offset = place - com;
      const double over = (r_WB * normal_B).dot(cut.offset) - max;
      if (!(over > 0.0)) return;
      normal_B.cwiseAbs().maxCoeff(&cut.axis);
      cut.moved = over / normal_B[cut.axis];
      place -= cut.moved * r_WB.col(cut.axis);
      low = low || cut.axis == 2;
      cuts[cut_count++] = cut;
    }

    /// What moves the held place along `along`: `along` itself becomes what moves q, the rest goes to CoM and base.
    void add_along(const Between& at, Vector3d& along, Eigen::Ref<Eigen::VectorXd> g) const {
      for (int i = cut_count; i-- > 0;) add_along(cuts[i], at, along, g);
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

    void add_along(const AtCut& cut, const Between& at, Vector3d& along, Eigen::Ref<Eigen::VectorXd> g) const {
      const Vector3d axis = r_WB.col(cut.axis), normal = r_WB * cut.normal_B;
      const double ratio = axis.dot(along) / cut.normal_B[cut.axis];
      const Vector3d moment = ratio * cut.offset.cross(normal) - cut.moved * axis.cross(along);
      Vector3d by_rpy;
      for (int k = 0; k < 3; ++k) by_rpy[k] = turned_about[k].dot(moment);
      along -= ratio * normal;
      at.add_along(ratio * normal, by_rpy, g);
    }
  };

  /// A time on the way: where the foot is, lifted and held, and how its sole lies.
  struct Sample {
    OnArc on;
    Vector3d place;
    Eigen::Matrix3d sole;
    Held held;
    Between body;
    bool with_body = false;  ///< else the reach box is left out
    bool fine = false;       ///< of what the swing goes across alone
  };

  /// What a swing has to do with a solid, from its own phase.
  struct Passing {
    double thickness = 0.0;
    bool through = false;  ///< below what it leaves or reaches a foot has come through it, however thin that is
    bool rises = false;    ///< and out of that it goes up by a knot inside the swing as well
    bool across = false;   ///< it comes from beyond one edge and goes beyond another: over the solid, or round it
    Vector3d from, to;     ///< the ends of its phase

    Passing(const Polygon& polygon, double thick, const SwingArc& arc, const Vector3d& begin, const Vector3d& end)
        : thickness(thick), from(begin), to(end) {
      through = (arc.before == 0.0 && stands_on(polygon, from)) || (arc.after == 0.0 && stands_on(polygon, to));
      rises = through && (arc.duration_before > 0.0 || arc.duration_after > 0.0);
      if (through) thickness = std::numeric_limits<double>::infinity();
      across = polygon.outside(from) > 0.0 && polygon.outside(to) > 0.0;
      for (int e = 0; e < polygon.edge_count(); ++e)
        across = across && !(polygon.overshoot(e, from) > 0.0 && polygon.overshoot(e, to) > 0.0);
    }

    /// What it comes from or goes to lies beyond this edge.
    bool goes_over(const Polygon& polygon, int e) const {
      return polygon.overshoot(e, from) > 0.0 || polygon.overshoot(e, to) > 0.0;
    }
  };

  /// The edge that a point is nearest to or farthest beyond; but for those that a swing goes over, -1 where that leaves
  /// none.
  static int nearest_edge(const Polygon& polygon, const Vector3d& point, const Passing* over = nullptr) {
    int nearest = -1;
    for (int e = 0; e < polygon.edge_count(); ++e)
      if (!(over && over->goes_over(polygon, e)) &&
          (nearest < 0 || polygon.overshoot(e, point) > polygon.overshoot(nearest, point)))
        nearest = e;
    return nearest;
  }

  /// The corner of a sole that is deepest inside a solid, by the shorter way out of it: up or beside an edge.
  static bool deepest_corner(const Problem& problem, const Polygon& polygon, double thickness,
                             const Eigen::Vector2d& half, const Sample& sample, Vector3d& deepest) {
    const double room = problem.swing_room;
    double most = 0.0;
    for (double x : {-1.0, 1.0})
      for (double y : {-1.0, 1.0}) {
        const Vector3d corner = sample.place + x * half.x() * sample.sole.col(0) + y * half.y() * sample.sole.col(1);
        const double height = polygon.height(corner);
        if (height < -thickness || height >= room) continue;
        const double depth = std::min(room - height, room - polygon.outside(corner));
        if (!(depth > most)) continue;
        most = depth;
        deepest = corner;
      }
    return most > 0.0;
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

  /// The samples of a phase: in the middle 80 % of the swing's time, where the sole's corners count; of its ends the
  /// CoM is not known.
  static void find_samples(const StepView& step, const SwingArc& arc, std::vector<Sample>& samples) {
    constexpr double kEnds[] = {0.1, 0.15, 0.85, 0.9};
    const double total = arc.before + arc.duration + arc.after;
    for (const double s : kEnds) {
      const double fraction = (s * total - arc.before) / arc.duration;
      if (fraction > 0.0 && fraction < 1.0) add_sample(step, arc, s, fraction, nullptr, false, samples);
    }
    for (std::size_t j = 0; j + 1 < step.instants.size(); ++j)
      for (int part = 0; part < kParts; ++part) {
        const Between body{&step.instants[j], &step.instants[j + 1], static_cast<double>(part) / kParts};
        const double fraction = body.fraction(), s = (arc.before + fraction * arc.duration) / total;
        if (s > kEnds[0] && s < kEnds[3]) add_sample(step, arc, s, fraction, &body, part % 2 == 1, samples);
      }
  }

  /// `s_given` is the share of the swing by the durations that are given, by which the sole turns.
  static void add_sample(const StepView& step, const SwingArc& arc, double s_given, double fraction,
                         const Between* body, bool fine, std::vector<Sample>& samples) {
    const Problem& problem = step.problem;
    const Layout& at = problem.layout;
    const Vector3d between = (1.0 - s_given) * arc.lift_normal + s_given * arc.land_normal;
    if (between.norm() < 0.1) return;  // from a wall to the facing one
    Sample& sample = samples.emplace_back();
    sample.sole = sole_frame(between.normalized(), step.sole_yaw);
    sample.on = on_arc(arc, fraction, step.x.segment<3>(at.end(step.l)), step.u->segment<3>(at.stride(step.l)),
                       (*step.u)[at.duration()]);
    const double lift = SwingLift(sample.on.s).value();
    sample.place = sample.on.place + kLiftMax * problem.swing_height * lift * sample.sole.col(2);
    sample.with_body = body != nullptr;
    sample.fine = fine;
    if (!body) return;
    sample.body = *body;
    sample.held.hold(*body, problem.limits[step.l], sample.place);
  }

  static void write_at(const StepView& step, const Polygon& polygon, const Passing& passing, const Sample& sample,
                       Rows& rows) {
    const Problem& problem = step.problem;
    const Layout& at = problem.layout;
    Vector3d corner = Vector3d::Zero();
    const Eigen::Vector2d& half = problem.limits[step.l].half_size;
    if (!deepest_corner(problem, polygon, passing.thickness, half, sample, corner)) return;
    const double up = polygon.height(corner) - problem.swing_room;
    int side = nearest_edge(polygon, corner);
    // Over what it goes across a foot is lifted with the CoM, unless the way round is shorter.
    if (sample.held.low && passing.across) side = nearest_edge(polygon, corner, &passing);
    const double away =
        side < 0 ? -std::numeric_limits<double>::infinity() : polygon.overshoot(side, corner) - problem.swing_room;
    const bool raise = (sample.held.low || passing.rises) && up > away;
    const double weight = (passing.across ? kAcrossWeight : 1.0) * step.schedule.interior_weight;
    const double value = raise ? up : away;
    if (!rows.with_gradient()) {
      rows.add_value(weight, value);
      return;
    }
    auto g = rows.add_dense(weight, value);
    Vector3d along = raise ? polygon.normal_W() : polygon.edge_outward_W(side);
    if (sample.with_body) sample.held.add_along(sample.body, along, g);
    const double lift_by_s = kLiftMax * problem.swing_height * SwingLift(sample.on.s).rate();
    g.segment<3>(at.end(step.l)) += along;
    g.segment<3>(at.nx() + at.stride(step.l)) += sample.on.by_stride * along;
    g[at.nx() + at.duration()] +=
        along.dot(sample.on.by_duration + lift_by_s * sample.on.s_by_duration * sample.sole.col(2));
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
