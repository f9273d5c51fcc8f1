#include <cmath>
#include <limits>

#include "certify_rows.hpp"
#include "planar/plane.hpp"

namespace mcplan::sip::proof {
namespace {

using Eigen::Vector2d;
using planar::cross;

/// Places on two segments, as shares of their lengths.
struct Shares {
  double on_a = 0.0, on_b = 0.0;
};

struct Segments {
  Vector2d a0, a1, b0, b1;

  Vector2d between(const Shares& shares) const { return a0 + shares.on_a * (a1 - a0) - b0 - shares.on_b * (b1 - b0); }

  /// Where they are nearest to each other: where they cross, or at one of the four ends.
  Shares nearest() const {
    const Vector2d along_a = a1 - a0, along_b = b1 - b0;
    const double turn = cross(along_a, along_b);
    if (turn != 0.0) {
      const Shares meet{cross(b0 - a0, along_b) / turn, cross(b0 - a0, along_a) / turn};
      if (meet.on_a >= 0.0 && meet.on_a <= 1.0 && meet.on_b >= 0.0 && meet.on_b <= 1.0) return meet;
    }
    const auto share = [](const Vector2d& point, const Vector2d& from, const Vector2d& along) {
      const double squared = along.squaredNorm();
      return squared > 0.0 ? std::clamp(along.dot(point - from) / squared, 0.0, 1.0) : 0.0;
    };
    Shares best;
    double min_distance = std::numeric_limits<double>::infinity();
    for (const Shares& ends : {Shares{0.0, share(a0, b0, along_b)}, Shares{1.0, share(a1, b0, along_b)},
                               Shares{share(b0, a0, along_a), 0.0}, Shares{share(b1, a0, along_a), 1.0}}) {
      const double distance = between(ends).norm();
      if (distance < min_distance) {
        min_distance = distance;
        best = ends;
      }
    }
    return best;
  }
};

double middle(const Range& r) { return 0.5 * (r.min + r.max); }
double half_width(const Range& r) { return 0.5 * (r.max - r.min); }

}  // namespace

/// r_a + r_b - distance of the segments. From above by a line between them: for any unit vector u the distance is at
/// least the smallest u . (a_i - b_j) of their ends; u is the direction of the nearest points in the piece's middle.
/// From below, at a place, by the distance of the points that are nearest there.
Amount overlap(const PieceModels& models, int body_a, const Capsule& a, int body_b, const Capsule& b) {
  const Vector ends_a[] = {models.from_base(body_a, {a.from_B, 0.0}), models.from_base(body_a, {a.to_B, 0.0})};
  const Vector ends_b[] = {models.from_base(body_b, {b.from_B, 0.0}), models.from_base(body_b, {b.to_B, 0.0})};
  double width = 0.0;  // of the enclosures of the ends at a place
  const auto segments_at = [&](double s) {
    width = 0.0;
    const auto point = [&](const Vector& v) {
      const Range x = v.x.at(s), y = v.y.at(s);
      width = std::max(width, half_width(x) + half_width(y));
      return Vector2d(middle(x), middle(y));
    };
    return Segments{point(ends_a[0]), point(ends_a[1]), point(ends_b[0]), point(ends_b[1])};
  };

  const Segments centre = segments_at(0.0);
  Vector2d direction = centre.between(centre.nearest());
  direction = direction.norm() > 0.0 ? Vector2d(direction.normalized()) : Vector2d(1.0, 0.0);
  Amount separation;
  for (int i = 0; i < 4; ++i) {
    Vector apart = ends_a[i / 2] + -ends_b[i % 2];
    const Amount along = Amount::of(apart.x.scaled(direction.x()).add_scaled(direction.y(), apart.y));
    separation = i == 0 ? along : smaller(separation, along);
  }
  const double reach = a.radius + b.radius;
  Amount out = scaled(separation, -(1.0 - 8.0 * kEpsilon), reach);
  const auto no_more = [&](Range& r) { r.max = std::min(r.max, reach * (1.0 + kEpsilon)); };  // a distance is >= 0
  no_more(out.over);
  out.over.min = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < Amount::kPlaces; ++i) {
    no_more(out.at[i]);
    const Segments there = segments_at(Amount::place(i));
    const double distance = there.between(there.nearest()).norm();
    out.at[i].min = reach - distance - 2.0 * width - 32.0 * kEpsilon * (reach + distance);
  }
  return out;
}

}  // namespace mcplan::sip::proof
