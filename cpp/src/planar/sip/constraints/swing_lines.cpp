#include "planar/sip/constraints/swing_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "planar/plane.hpp"

namespace mcplan::sip {
namespace {

using Eigen::Vector2d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTouch = 1e-3;  // [m] that a contact may be beyond a line next to which it stands

struct Line {
  Vector2d point_W, normal_W;

  double height(const Vector2d& x_W) const { return normal_W.dot(x_W - point_W); }
};

/// The stretch of time for which an end-effector is in the air, and the contacts before and after it, if any.
struct Swing {
  const PlanarContact *before = nullptr, *after = nullptr;
  int first_interval = 0, end_interval = 0;  ///< of the task
};

const PlanarContact* contact_of(const PlanarPhase& phase, int end_effector) {
  for (const PlanarContact& contact : phase.contacts)
    if (contact.end_effector == end_effector) return &contact;
  return nullptr;
}

Swing swing_of(const PlanarTask& task, int end_effector, int phase) {
  Swing out;
  const int phases = static_cast<int>(task.phases.size());
  int first = phase, end = phase + 1;
  while (first > 0 && !(out.before = contact_of(task.phases[first - 1], end_effector))) --first;
  while (end < phases && !(out.after = contact_of(task.phases[end], end_effector))) ++end;
  out.first_interval = task.first_interval(first);
  out.end_interval = task.first_interval(end);
  return out;
}

/// Places of an end-effector's points on the straight way of its swing, at the knots of its intervals.
std::vector<std::vector<Vector2d>> straight_way(const PlanarEndEffector& end_effector, const Swing& swing) {
  const PlanarContact& from = swing.before ? *swing.before : *swing.after;
  const PlanarContact& to = swing.after ? *swing.after : *swing.before;
  const int intervals = swing.end_interval - swing.first_interval;
  std::vector<std::vector<Vector2d>> out;
  for (int k = 0; k <= intervals; ++k) {
    const double ratio = k / static_cast<double>(intervals);
    const Vector2d position_W = from.position_W + ratio * (to.position_W - from.position_W);
    const double angle = from.angle + ratio * (to.angle - from.angle);
    std::vector<Vector2d> points;
    for (double along : end_effector.points)
      points.push_back(position_W + along * Vector2d(std::cos(angle), std::sin(angle)));
    out.push_back(std::move(points));
  }
  return out;
}

double depth(const Line& line, const std::vector<Vector2d>& points) {
  double out = -kInfinity;
  for (const Vector2d& point : points) out = std::max(out, -line.height(point));
  return out;
}

Line front_of(const PlanarSurface& surface) { return {surface.origin_W, surface.normal_W()}; }

/// In front of a strip, beside its begin, beside its end.
constexpr int kSides = 3;
std::array<std::optional<Line>, kSides> sides_of(const PlanarSurface& surface) {
  const Vector2d tangent_W = surface.tangent_W();
  std::array<std::optional<Line>, kSides> out;
  out[0] = front_of(surface);
  if (std::isfinite(surface.from)) out[1] = Line{surface.origin_W + surface.from * tangent_W, -tangent_W};
  if (std::isfinite(surface.to)) out[2] = Line{surface.origin_W + surface.to * tangent_W, tangent_W};
  return out;
}

/// What it costs to be on one side of a strip in one interval of a swing: how deep the straight way is beyond the line.
/// Less than nothing beside one that is far off; hardly ever allowed where a contact lies beyond it.
double price(const Line& line, const std::vector<std::vector<Vector2d>>& way, const Swing& swing,
             std::size_t interval) {
  constexpr double kFar = 1e-3, kNever = 1e3;
  const double begin = depth(line, way[interval]), end = depth(line, way[interval + 1]);
  const double deeper = std::max(begin, end);
  double out = deeper > 0.0 ? deeper : kFar * deeper;
  if (swing.before && interval == 0 && begin > kTouch) out += kNever;
  if (swing.after && interval + 2 == way.size() && end > kTouch) out += kNever;
  return out;
}

/// The side of a strip in every interval of a swing, of the least price altogether: by dynamic programming, never from
/// one end of the strip to the other at once.
std::vector<Line> cheapest_sides(const PlanarSurface& surface, const PlanarEndEffector& end_effector,
                                 const Swing& swing) {
  const auto sides = sides_of(surface);
  const auto way = straight_way(end_effector, swing);
  const std::size_t intervals = way.size() - 1;
  std::vector<std::array<double, kSides>> total(intervals);
  std::vector<std::array<int, kSides>> from(intervals);
  for (std::size_t i = 0; i < intervals; ++i)
    for (int side = 0; side < kSides; ++side) {
      total[i][side] = sides[side] ? price(*sides[side], way, swing, i) : kInfinity;
      if (i == 0) continue;
      int best = side;
      for (int other = 0; other < kSides; ++other)
        if ((other == 0 || side == 0) && total[i - 1][other] < total[i - 1][best]) best = other;
      from[i][side] = best;
      total[i][side] += total[i - 1][best];
    }
  const auto& last = total.back();
  int side = static_cast<int>(std::min_element(last.begin(), last.end()) - last.begin());
  std::vector<Line> out(intervals);
  for (std::size_t i = intervals; i-- > 0; side = from[i][side]) out[i] = *sides[side];
  return out;
}

/// Whether all that is behind a surface is behind a line.
bool hides(const Line& line, const PlanarSurface& surface) {
  constexpr double kRounding = 1e-9;
  const Vector2d tangent_W = surface.tangent_W();
  const double along = line.normal_W.dot(tangent_W);
  if (line.normal_W.dot(surface.normal_W()) < -kRounding) return false;
  if (std::isinf(surface.from) && along < -kRounding) return false;
  if (std::isinf(surface.to) && along > kRounding) return false;
  const auto behind = [&](double at) {
    return line.height(surface.origin_W + (std::isfinite(at) ? at : 0.0) * tangent_W) <= kRounding;
  };
  return behind(surface.from) && behind(surface.to);
}

/// Of an end-effector that the task itself keeps in front of surfaces, these.
std::vector<Line> named_lines(const PlanarTask& task, const PlanarPhase& phase, int end_effector, int interval) {
  std::vector<Line> out;
  for (const PlanarClearance& clearance : phase.clearances) {
    const int end = clearance.end_interval < 0 ? phase.intervals : clearance.end_interval;
    if (clearance.end_effector == end_effector && interval >= clearance.first_interval && interval < end)
      out.push_back(front_of(task.surfaces[clearance.surface]));
  }
  return out;
}

struct Kept {
  int surface;
  Line line;
};

std::vector<Kept> lines_of(const PlanarTask& task, int end_effector, int phase, int interval_of_phase) {
  const std::vector<Line> named = named_lines(task, task.phases[phase], end_effector, interval_of_phase);
  const Swing swing = swing_of(task, end_effector, phase);
  const int interval = task.first_interval(phase) + interval_of_phase - swing.first_interval;
  std::vector<Kept> out;
  for (int s = 0; s < static_cast<int>(task.surfaces.size()); ++s) {
    const PlanarSurface& surface = task.surfaces[s];
    const auto hidden_by = [&](const Line& line) { return hides(line, surface); };
    if (!task.keeps_clear(end_effector, s) || std::any_of(named.begin(), named.end(), hidden_by)) continue;
    Line line = front_of(surface);
    if (std::isfinite(surface.from) || std::isfinite(surface.to)) {
      if (!swing.before && !swing.after) continue;
      line = cheapest_sides(surface, task.robot.end_effectors[end_effector], swing)[interval];
    }
    if (std::any_of(out.begin(), out.end(), [&](const Kept& kept) { return hidden_by(kept.line); })) continue;
    const auto hidden = [&](const Kept& kept) { return hides(line, task.surfaces[kept.surface]); };
    out.erase(std::remove_if(out.begin(), out.end(), hidden), out.end());
    out.push_back({s, line});
  }
  return out;
}

}  // namespace

std::vector<SwingLine> swing_lines(const PlanarTask& task, int phase, int interval_of_phase) {
  std::vector<SwingLine> out;
  for (int e = 0; e < static_cast<int>(task.robot.end_effectors.size()); ++e) {
    if (contact_of(task.phases[phase], e)) continue;
    for (const Kept& kept : lines_of(task, e, phase, interval_of_phase))
      out.push_back({e, kept.line.point_W, kept.line.normal_W});
  }
  return out;
}

}  // namespace mcplan::sip
