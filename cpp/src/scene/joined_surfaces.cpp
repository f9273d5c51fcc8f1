#include "scene/joined_surfaces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mcplan/scene/polygon.hpp"

namespace mcplan {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Outline = std::vector<Vector2d>;  // convex, counter-clockwise

/// Surfaces touch that are no further apart [m]; chosen, far less than a sole. They lie in one plane that are no
/// further off it [m]: footholds on the plane of one have to be on that of the other, within the checker's tolerance of
/// small robots as well.
constexpr double kApart_m = 0.002, kOff_m = 1e-4;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double area_of(const Outline& outline) {
  double twice = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) twice += cross(outline[i], outline[(i + 1) % outline.size()]);
  return 0.5 * twice;
}

/// Convex hull (Andrew's monotone chain), without vertices that lie on an edge.
Outline hull_of(Outline points) {
  constexpr double kStraight_m = 1e-4;
  std::sort(points.begin(), points.end(),
            [](const Vector2d& a, const Vector2d& b) { return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y()); });
  Outline out;
  const auto add = [&out](const Vector2d& point, std::size_t kept) {
    const auto bends = [&] {
      const Vector2d &a = out[out.size() - 2], &b = out.back();
      return cross(b - a, point - a) > kStraight_m * (point - a).norm();
    };
    while (out.size() > kept && !bends()) out.pop_back();
    out.push_back(point);
  };
  for (const Vector2d& point : points) add(point, 1);
  const std::size_t lower = out.size();
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
  out.pop_back();
  return out;
}

/// What two outlines have in common (Sutherland and Hodgman).
Outline common(Outline a, const Outline& b) {
  for (std::size_t i = 0; i < b.size() && !a.empty(); ++i) {
    const Vector2d from = b[i], along = b[(i + 1) % b.size()] - from;
    Outline cut;
    for (std::size_t j = 0; j < a.size(); ++j) {
      const Vector2d &here = a[j], &next = a[(j + 1) % a.size()];
      const double in = cross(along, here - from), then = cross(along, next - from);
      if (in >= 0.0) cut.push_back(here);
      if ((in > 0.0 && then < 0.0) || (in < 0.0 && then > 0.0)) cut.push_back(here + in / (in - then) * (next - here));
    }
    a = std::move(cut);
  }
  return a;
}

double distance_to_edges(const Vector2d& point, const Outline& of) {
  double out = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < of.size(); ++i) {
    const Vector2d along = of[(i + 1) % of.size()] - of[i];
    const double s = std::clamp((point - of[i]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    out = std::min(out, (of[i] + s * along - point).norm());
  }
  return out;
}

/// Surfaces that are one so far, in the plane of the first of them.
struct Piece {
  Piece(const Surface& surface, int alike) : plane(surface.vertices_W), kind(alike) {
    for (const Vector3d& vertex : surface.vertices_W) outline.push_back(flat(vertex));
    measure();
  }

  Vector2d flat(const Vector3d& point) const {
    const Vector3d off = point - plane.vertices_W().front();
    return {plane.tangent_W(0).dot(off), plane.tangent_W(1).dot(off)};
  }
  Vector3d in_space(const Vector2d& point) const {
    return plane.vertices_W().front() + point.x() * plane.tangent_W(0) + point.y() * plane.tangent_W(1);
  }
  void measure() {
    area = area_of(outline);
    box.setEmpty();
    for (const Vector2d& vertex : outline) box.extend(in_space(vertex));
  }

  Polygon plane;
  int kind;
  Outline outline;
  double area = 0.0;
  Eigen::AlignedBox3d box;
  int into = -1;  ///< the piece that it has become a part of
  bool grown = false;
};

/// Make the second a part of the first, if that is convex.
bool join(Piece& one, const Piece& other) {
  if (one.kind != other.kind || one.kind < 0 || one.box.squaredExteriorDistance(other.box) > kApart_m * kApart_m)
    return false;
  if (one.plane.normal_W().dot(other.plane.normal_W()) < 0.0) return false;
  Outline beside, all = one.outline;
  for (const Vector2d& vertex : other.outline) {
    const Vector3d place = other.in_space(vertex);
    if (std::abs(one.plane.height(place)) > kOff_m) return false;
    beside.push_back(one.flat(place));
  }
  const Outline both = common(one.outline, beside);
  const double overlap = both.size() < 3 ? 0.0 : area_of(both);
  if (!(overlap > 0.0)) {
    double apart = std::numeric_limits<double>::infinity();
    for (const Vector2d& vertex : beside) apart = std::min(apart, distance_to_edges(vertex, one.outline));
    for (const Vector2d& vertex : one.outline) apart = std::min(apart, distance_to_edges(vertex, beside));
    if (apart > kApart_m) return false;
  }
  all.insert(all.end(), beside.begin(), beside.end());
  const Outline hull = hull_of(std::move(all));
  const double smaller = std::min(one.area, other.area);
  if (hull.size() < 3 || area_of(hull) - (one.area + other.area - overlap) > kApart_m * std::sqrt(smaller))
    return false;
  one.outline = hull;
  one.grown = true;
  one.measure();
  return true;
}

bool alike(const Surface& a, const Surface& b) {
  return a.friction == b.friction && a.thickness == b.thickness && a.end_effectors == b.end_effectors;
}

}  // namespace

JoinedSurfaces join_surfaces(const Scene& given) {
  const int count = static_cast<int>(given.surfaces.size());
  std::vector<Piece> pieces;
  std::vector<int> first_of_kind;
  for (const Surface& surface : given.surfaces) {
    int kind = -1;
    if (!surface.grasp) {
      const auto same = [&](int i) { return alike(given.surfaces[i], surface); };
      const auto known = std::find_if(first_of_kind.begin(), first_of_kind.end(), same);
      kind = static_cast<int>(known - first_of_kind.begin());
      if (known == first_of_kind.end()) first_of_kind.push_back(static_cast<int>(pieces.size()));
    }
    pieces.emplace_back(surface, kind);
  }
  // A row of tiles first, and rows to a floor in the next round.
  for (bool again = true; again;) {
    again = false;
    for (int i = 0; i < count; ++i)
      for (int j = i + 1; j < count && pieces[i].into < 0; ++j)
        if (pieces[j].into < 0 && join(pieces[i], pieces[j])) {
          pieces[j].into = i;
          again = true;
          j = i;  // what it did not touch before it may touch now
        }
  }
  JoinedSurfaces out;
  out.scene = given;
  out.scene.surfaces.clear();
  out.index.resize(count);
  for (int i = 0; i < count; ++i) {
    if (pieces[i].into >= 0) {
      out.index[i] = out.index[pieces[i].into];
      continue;
    }
    out.index[i] = static_cast<int>(out.scene.surfaces.size());
    Surface& surface = out.scene.surfaces.emplace_back(given.surfaces[i]);
    if (!pieces[i].grown) continue;
    surface.vertices_W.clear();
    for (const Vector2d& vertex : pieces[i].outline) surface.vertices_W.push_back(pieces[i].in_space(vertex));
  }
  const auto rename = [&](std::string& name) {
    const int i = given.surface_index(name);
    if (i >= 0) name = out.scene.surfaces[out.index[i]].name;
  };
  for (Stance* stance : {&out.scene.start, &out.scene.goal})
    for (auto& [who, surface] : stance->contacts) rename(surface);
  for (Step& step : out.scene.steps) rename(step.surface);
  return out;
}

}  // namespace mcplan
