#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ddp/constants.hpp"
#include "ddp/costs/prism.hpp"
#include "ddp/problem.hpp"
#include "ddp/trunk_room.hpp"
#include "mcplan/base/rotation.hpp"
#include "plan/solid_box.hpp"
#include "robot/ground_plane.hpp"
#include "surface_boxes.hpp"

/// What the search is to stay near, and what it begins with.
namespace mcplan::ddp {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// What a stride of end-effector l covers at most (non-dimensional): along the base's heading, across it, and up. In
/// the paper's model it ends where the friction cone does, since forces point at the CoM there.
Vector3d Problem::stride_of(int l) const {
  double tangent = 0.0;
  for (int surface : rules.surfaces(l)) tangent = std::max(tangent, friction[surface]);
  const EndLimits& limit = limits[l];
  const double spread = std::min(tangent, kStrideFrictionMax) * std::abs(limit.nominal.z());
  const double ahead = model == Model::wrench
                           ? std::numeric_limits<double>::infinity()
                           : std::sqrt(std::max(spread * spread - limit.nominal.y() * limit.nominal.y(), 0.0));
  const Vector3d size = limit.reach_max - limit.reach_min;
  return {std::min(limit.reach_max.x(), ahead) - std::max(limit.reach_min.x(), -ahead), size.y(), size.z()};
}

/// As many steps as the end-effectors that stand need to cover the way, level, across the base's heading and up, one
/// after the other, a swing and a phase of full support each; at least the paper's 18. Boxes are narrow: what lies
/// across asks for more strides, whatever lies ahead. Where the base turns, they go round it.
int Problem::automatic_steps(const ResolvedStance& from, const ResolvedStance& to) const {
  constexpr int kPieces = 64;
  const Headings headings(course, from.yaw, to.yaw, (to.com_W - from.com_W).head<2>());
  const auto level = [](double yaw) { return rotation_from_rpy({0.0, 0.0, yaw}); };
  double strides = 0.0;
  for (std::size_t l = 0; l < active.size(); ++l) {
    const int e = active[l];
    if (from.contacts[e] == kFree || to.contacts[e] == kFree) continue;
    const Vector3d before = level(from.yaw).transpose() * (from.end_effectors_W[e] - from.com_W),
                   after = level(to.yaw).transpose() * (to.end_effectors_W[e] - to.com_W);
    const auto at = [&](double share) -> Vector3d {
      const Vector3d straight = from.com_W + share * (to.com_W - from.com_W), place = before + share * (after - before);
      return ((course.route.empty() ? straight : point_on(course.route, share)) + level(headings.at(share)) * place) /
             units.length;
    };
    const Vector3d stride = stride_of(static_cast<int>(l));
    const double turn = std::min(limits[l].yaw_max - limits[l].yaw_min, kTurnStride);
    double count = 0.0;
    for (int k = 0; k < kPieces; ++k) {
      const double share = static_cast<double>(k) / kPieces, next = (k + 1.0) / kPieces;
      const Vector3d piece = at(next) - at(share);
      const double yaw = headings.at(0.5 * (share + next));
      const Vector3d way(piece.head<2>().norm(), std::abs(std::cos(yaw) * piece.y() - std::sin(yaw) * piece.x()),
                         std::abs(piece.z()));
      double most = std::abs(headings.at(next) - headings.at(share)) / turn;
      for (int i = 0; i < 3; ++i)
        if (stride[i] > 0.0) most = std::max(most, way[i] / stride[i]);
      count += most;
    }
    strides += std::ceil(std::min(count - 1e-9, 1e3));
  }
  return std::clamp(2 * static_cast<int>(strides) + 2, kPaperPhases, kPhasesMax);
}

/// From start to goal at rest at both ends, tied to the step index; along the course. End-effectors keep their place
/// relative to the base where that turns.
void Problem::make_reference(const VectorXd& goal) {
  const double total = steps * duration_initial;
  const auto level = [](double yaw) { return rotation_from_rpy({0.0, 0.0, yaw}); };
  const VectorXd way = goal - start;
  const Headings headings(course, rpy(start).z(), rpy(goal).z(), way.segment<2>(layout.com()));
  const Route& route = course.route;
  // What the route has beside the straight line.
  const auto detour = [&](double blend) -> Vector3d {
    if (route.empty()) return Vector3d::Zero();
    return (point_on(route, blend) - (1.0 - blend) * route.front() - blend * route.back()) / units.length;
  };
  reference.x.clear();
  for (int k = 0; k <= steps; ++k) {
    const auto [blend, rate] = progress_at(course, k, steps, total);
    VectorXd x = start + blend * way;
    x.segment<3>(layout.velocity()) = rate * way.segment<3>(layout.com());
    if (!route.empty()) {
      constexpr double kNear = 1e-3;
      const double before = std::max(blend - kNear, 0.0), after = std::min(blend + kNear, 1.0);
      x.segment<3>(layout.velocity()) += rate * (detour(after) - detour(before)) / (after - before);
      x.segment<3>(layout.com()) += detour(blend);
      for (int l = 0; l < layout.end_effector_count(); ++l) x.segment<3>(layout.end(l)) += detour(blend);
    }
    const double yaw = headings.at(blend);
    for (int a = 0; a < layout.axis_count(); ++a) {
      const bool turns = layout.axes()[a] == 2 && !headings.straight();
      if (turns) x[layout.angle(a)] = yaw;
      x[layout.momentum(a)] = inertia[layout.axes()[a]] * rate * (turns ? headings.rate(blend) : way[layout.angle(a)]);
    }
    if (!headings.straight())
      for (int l = 0; l < layout.end_effector_count(); ++l) {
        const auto offset = [&](const VectorXd& at, double yaw) -> Vector3d {
          return level(yaw).transpose() * (at.segment<3>(layout.end(l)) - at.segment<3>(layout.com()));
        };
        const Vector3d before = offset(start, rpy(start).z()), after = offset(goal, rpy(goal).z());
        x.segment<3>(layout.end(l)) = x.segment<3>(layout.com()) + level(yaw) * (before + blend * (after - before));
      }
    reference.x.push_back(x);
  }
  follow_ground();
  find_standing_solids();
  find_trunk_solids();
  find_leg_solids();
}

void Problem::set_pace(double duration) {
  // Rates go with 1 / duration, see make_reference(); the ends are at rest, or as measured.
  const double faster = duration_initial / duration;
  for (int k = 1; k < steps; ++k) {
    reference.x[k].segment<3>(layout.velocity()) *= faster;
    reference.x[k].segment(layout.momentum(), layout.axis_count()) *= faster;
  }
  duration_initial = duration;
}

/// The trunk of a robot that balances on three point feet or more follows the ground below them: its angles, and the
/// height of its CoM, are those of the feet's nearest ground, on the mean over a stride of every foot.
void Problem::follow_ground() {
  std::vector<int> feet;
  for (int l = 0; l < layout.end_effector_count(); ++l)
    if (limits[l].balances) feet.push_back(l);
  if (feet.size() < 3) return;
  const SurfaceBoxes boxes(polygons);
  std::vector<Vector3d> angles;
  std::vector<double> heights;
  for (int k = 0; k <= steps; ++k) {
    std::vector<Vector3d> ground;
    for (int l : feet) {
      const Vector3d above = reference.x[k].segment<3>(layout.end(l));
      Vector3d nearest = above;
      double least = std::numeric_limits<double>::infinity();
      for (int surface : rules.surfaces(l)) {
        if (boxes.min_squared_distance(surface, above) > least) continue;
        const Vector3d here = polygons[surface].nearest(above);
        if ((here - above).squaredNorm() >= least) continue;
        least = (here - above).squaredNorm();
        nearest = here;
      }
      ground.emplace_back(above.x(), above.y(), nearest.z());
    }
    angles.push_back(rpy_along_ground(ground, rpy(reference.x[k]).z()));
    double height = 1.0;
    for (const Vector3d& place : ground) height += place.z() / static_cast<double>(ground.size());
    heights.push_back(height);
  }
  const int half = static_cast<int>(feet.size());
  for (int k = 1; k < steps; ++k) {
    const int first = std::max(k - half, 0), last = std::min(k + half, steps);
    Eigen::Vector2d tilt = Eigen::Vector2d::Zero();
    double height = 0.0;
    for (int j = first; j <= last; ++j) {
      tilt += angles[j].head<2>() / (last - first + 1);
      height += heights[j] / (last - first + 1);
    }
    VectorXd& x = reference.x[k];
    x[layout.com() + 2] = height;
    for (int a = 0; a < layout.axis_count(); ++a)
      if (layout.axes()[a] < 2) x[layout.angle(a)] = tilt[layout.axes()[a]];
  }
}

/// Ground lies one length below the reference of the CoM: what comes nearer stands on it. Looked for along the whole
/// way once, since there may be thousands of surfaces.
void Problem::find_standing_solids() {
  standing_solids.clear();
  if (options.method == Method::paper) return;
  std::vector<Eigen::AlignedBox3d> pieces;  // of the way between two knots, which the motion may leave a little
  for (int k = 0; k < steps; ++k) {
    Eigen::AlignedBox3d& piece = pieces.emplace_back(Vector3d(reference.x[k].segment<3>(layout.com())));
    piece.extend(Vector3d(reference.x[k + 1].segment<3>(layout.com())));
  }
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const Eigen::AlignedBox3d box = box_of(Solid{polygons[i], thickness[i]});
    const bool near = std::any_of(pieces.begin(), pieces.end(), [&](const Eigen::AlignedBox3d& piece) {
      return box.squaredExteriorDistance(piece) < kStanding * kStanding;
    });
    if (near) standing_solids.push_back(static_cast<int>(i));
  }
}

/// How far from its reference the robot's own trunk may be, in heights of the CoM. Chosen.
constexpr double kTrunkMove = 0.3;

/// Likewise about the robot's own trunk, as far as its parts are away, whichever way it turns about the vertical.
void Problem::find_trunk_solids() {
  trunk_solids.clear();
  solid_boxes.clear();
  trunk.clear();
  if (options.method == Method::paper || robot.trunk.empty()) return;
  double aside = 0.0, low = 0.0, high = 0.0;
  for (const TrunkPart& part : robot.trunk) {
    const TrunkPart& own =
        trunk.emplace_back(TrunkPart{part.from_B / units.length, part.to_B / units.length, part.radius / units.length});
    const double room = own.radius + kTrunkMove;
    for (const Vector3d& end : {own.from_B, own.to_B}) {
      aside = std::max(aside, end.head<2>().norm() + room);
      low = std::min(low, end.z() - room);
      high = std::max(high, end.z() + room);
    }
  }
  std::vector<Eigen::AlignedBox3d> pieces;
  for (int k = 0; k < steps; ++k) {
    Eigen::AlignedBox3d& piece = pieces.emplace_back();
    for (int j : {k, k + 1}) {
      const Vector3d com = reference.x[j].segment<3>(layout.com());
      piece.extend(com + Vector3d(-aside, -aside, low)).extend(com + Vector3d(aside, aside, high));
    }
  }
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const Eigen::AlignedBox3d& box = solid_boxes.emplace_back(box_of(Solid{polygons[i], thickness[i]}));
    if (std::any_of(pieces.begin(), pieces.end(), [&](const auto& piece) { return piece.intersects(box); }))
      trunk_solids.push_back(static_cast<int>(i));
  }
  make_trunk_rooms();
}

/// Where the scene itself puts the trunk nearer to a solid than that there is no more room to ask for.
void Problem::make_trunk_rooms() {
  trunk_rooms.clear();
  for (const TrunkPart& part : trunk) {
    std::vector<double>& rooms = trunk_rooms.emplace_back();
    for (int solid : trunk_solids) {
      double room = room_about(part);
      for (const VectorXd* x : {&reference.x.front(), &reference.x.back()}) {
        const Eigen::Matrix3d r = rotation_from_rpy(rpy(*x));
        const Vector3d from = x->segment<3>(layout.com()) + r * part.from_B, along = r * (part.to_B - part.from_B);
        room = std::min(room, nearest_on_line(polygons[solid], thickness[solid], from, along).outside.distance);
      }
      rooms.push_back(std::max(room, part.radius));
    }
  }
}

void Problem::set_sole_yaw(const ContactSequence& sequence, Trajectory& t) const {
  t.sole_yaw.assign(steps + 1, std::vector<double>(layout.end_effector_count()));
  for (int l = 0; l < layout.end_effector_count(); ++l)
    for (int k = 0; k <= steps; ++k) {
      t.sole_yaw[k][l] = rpy(t.x[k]).z();
      if (k == 0 && measured)
        t.sole_yaw[k][l] = start_yaw[l];  // also of a foot in the air, whose swing goes on from there
      if (sequence[k][l] == kFree) continue;
      // Phases first..k are one contact, which holds the knots first..last_knot.
      const int first = k;
      while (k < steps && sequence[k + 1][l] == sequence[first][l]) ++k;
      const int last_knot = std::min(k + 1, steps);
      double yaw = 0.0;
      for (int j = first; j <= last_knot; ++j) yaw += rpy(t.x[j]).z() / (last_knot - first + 1);
      if (k == steps) yaw = end_yaw.empty() ? goal_yaw : end_yaw[l];
      if (first == 0) yaw = start_yaw[l];
      for (int j = first; j <= k; ++j) t.sole_yaw[j][l] = yaw;
    }
  t.knot_yaw = t.sole_yaw;
  for (int k = 1; k <= steps; ++k)
    for (int l = 0; l < layout.end_effector_count(); ++l)
      if (sequence[k][l] == kFree && sequence[k - 1][l] != kFree) t.knot_yaw[k][l] = t.sole_yaw[k - 1][l];
}

/// Footholds where the reference is in the middle of each contact, straight lines between them.
void Problem::place_footholds(const ContactSequence& sequence, Trajectory& guess) const {
  for (int l = 0; l < layout.end_effector_count(); ++l) {
    int known = 0;  // the last knot whose position stands
    for (int k = 0; k <= steps; ++k) {
      if (sequence[k][l] == kFree) continue;
      const int first = k;
      while (k < steps && sequence[k + 1][l] == sequence[k][l]) ++k;
      const int last = std::min(k + 1, steps);
      const int middle = last == steps ? steps : (first + last) / 2;
      Vector3d foothold = guess.x[first].segment<3>(layout.end(l));
      if (first > 0) foothold = polygons[sequence[k][l]].nearest(reference.x[middle].segment<3>(layout.end(l)));
      const Vector3d before = guess.x[known].segment<3>(layout.end(l));
      for (int j = known + 1; j < first; ++j)
        guess.x[j].segment<3>(layout.end(l)) = before + (foothold - before) * (j - known) / (first - known);
      for (int j = first; j <= last; ++j) guess.x[j].segment<3>(layout.end(l)) = foothold;
      known = last;
    }
  }
}

/// Of robots on point feet: loads of the feet in contact near to equal ones whose centre of pressure is below the CoM,
/// so that upright forces turn nothing; none is negative. Empty of other robots.
std::vector<double> Problem::balanced_loads(const ContactState& contacts, const VectorXd& x) const {
  std::vector<int> standing;
  for (int l = 0; l < layout.end_effector_count(); ++l)
    if (contacts[l] != kFree) standing.push_back(l);
  const auto balancing = [&](int l) { return limits[l].balances; };
  if (standing.empty() || !std::all_of(standing.begin(), standing.end(), balancing)) return {};
  const Eigen::Index count = static_cast<Eigen::Index>(standing.size());
  Eigen::MatrixXd moments(3, count);
  for (Eigen::Index i = 0; i < count; ++i)
    moments.col(i) << 1.0, (x.segment<3>(layout.end(standing[i])) - x.segment<3>(layout.com())).head<2>();
  const VectorXd equal = VectorXd::Constant(count, 1.0 / static_cast<double>(count));
  const Eigen::Vector3d lacking = Eigen::Vector3d::UnitX() - moments * equal;
  VectorXd loads = (equal + moments.completeOrthogonalDecomposition().solve(lacking)).cwiseMax(0.0);
  if (!(loads.sum() > 0.0) || !loads.allFinite()) return {};
  loads /= loads.sum();
  std::vector<double> out(layout.end_effector_count(), 0.0);
  for (Eigen::Index i = 0; i < count; ++i) out[standing[i]] = loads[i];
  return out;
}

Trajectory Problem::initial_guess(const ContactSequence& sequence, const Tuning& tuning) const {
  Trajectory guess = reference;
  if (!sequence.empty()) place_footholds(sequence, guess);
  for (int k = 0; k < steps; ++k) {
    VectorXd u = VectorXd::Zero(layout.nu());
    int standing = 0;
    if (!sequence.empty())
      for (int contact : sequence[k]) standing += contact != kFree;
    const std::vector<double> loads =
        sequence.empty() ? std::vector<double>() : balanced_loads(sequence[k], guess.x[k]);
    for (int l = 0; l < layout.end_effector_count(); ++l) {
      u.segment<3>(layout.stride(l)) = guess.x[k + 1].segment<3>(layout.end(l)) - guess.x[k].segment<3>(layout.end(l));
      double mu = 1.0 / layout.end_effector_count();
      if (!sequence.empty()) mu = sequence[k][l] == kFree ? 0.0 : 1.0 / standing;
      if (!loads.empty()) mu = loads[l];
      u[layout.stiffness(l)] = options.stiffness_input == StiffnessInput::lambda ? std::sqrt(mu) : mu;
    }
    for (int l = 0; l < layout.end_effector_count(); ++l)
      if (limits[l].balances) {  // upright forces
        const Vector3d away = guess.x[k].segment<3>(layout.com()) - guess.x[k].segment<3>(layout.end(l));
        const auto& line = layout.offsets(l).force_line;
        const int count = layout.force_line_count(l);
        u.segment(layout.force_line(l), count) = line.transpose() * Vector3d(away.x(), away.y(), 0.0);
      }
    u[layout.duration()] = k == 0 && first_duration > 0.0 ? first_duration : tuning.duration_initial;
    guess.u.push_back(u);
  }
  // Without a sequence every sole goes with the base.
  set_sole_yaw(
      sequence.empty() ? ContactSequence(steps + 1, ContactState(layout.end_effector_count(), kFree)) : sequence,
      guess);
  return guess;
}

}  // namespace mcplan::ddp
