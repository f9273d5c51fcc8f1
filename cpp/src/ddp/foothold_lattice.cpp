#include "ddp/foothold_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mcplan/base/rotation.hpp"
#include "plan/swing_lift.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Between footholds, in heights of the CoM: 4.4 cm of TALOS. Chosen: two of them fit on a stair tread.
constexpr double kSpacing = 0.05;
/// Stations at most: courses that are longer have none.
constexpr double kMostStations = 4000.0;
/// Rows of footholds to each side of where the reference has the foot.
constexpr int kRows = 3;
/// To an edge beyond the margin, at which a foot is at ease, and what may be lacking of a margin.
constexpr double kEase = 0.03, kLacking = 0.02;
/// So often a foothold is moved inside of its edges, one after the other.
constexpr int kRounds = 4;
/// What is lower than that stands in no foot's way.
constexpr double kLow = 0.02;
/// What hangs lower than that over a foothold is in the way of the leg: the height of the CoM.
constexpr double kHeadroom = 1.0;
/// What a turn of one rad counts along the course. Chosen: footholds are 11 degrees apart.
constexpr double kTurned = 0.25;
/// Steeper ground is none for feet.
constexpr double kUpright = 0.5;

/// Height of a plane below or above a point.
double height_at(const Polygon& polygon, const Vector2d& at) {
  const Vector3d &normal = polygon.normal_W(), &on = polygon.vertices_W().front();
  return on.z() - normal.head<2>().dot(at - on.head<2>()) / normal.z();
}

/// By how much a sole that lies on a plane is higher this far from its middle.
double rise_of(const Polygon& polygon, const Vector2d& off) {
  return -polygon.normal_W().head<2>().dot(off) / polygon.normal_W().z();
}

/// The largest overshoot of what lies above or below a point on the plane.
double outside_from_above(const Polygon& polygon, const Vector2d& at) {
  return polygon.outside(Vector3d(at.x(), at.y(), height_at(polygon, at)));
}

}  // namespace

FootholdLattice::FootholdLattice(const Problem& problem, const std::array<int, 2>& feet)
    : problem_(&problem), feet_(feet) {
  for (const Polygon& polygon : problem.polygons) {
    Eigen::AlignedBox2d& box = boxes_.emplace_back();
    for (const Vector3d& vertex : polygon.vertices_W()) box.extend(Vector2d(vertex.head<2>()));
  }
  const std::vector<Station> along = stations();
  length_ = along.back().along;
  for (int foot : {0, 1}) {
    const auto given = [&](const Eigen::VectorXd& x, const ContactState& contacts, const Station& station) {
      LatticePoint out;
      out.place = x.segment<3>(problem.layout.end(feet_[foot]));
      out.yaw = station.yaw;
      out.station = station.along;
      out.share = station.share;
      out.surface = contacts[feet_[foot]];
      footholds_[foot].push_back(out);
    };
    given(problem.start, problem.start_contacts, along.front());
    given(problem.reference.x.back(), problem.goal_contacts, along.back());
    for (const Station& station : along) {
      const Vector3d left(-std::sin(station.yaw), std::cos(station.yaw), 0.0);
      for (int row = -kRows; row <= kRows; ++row) {
        const std::size_t before = footholds_[foot].size();
        add(foot, station, station.feet[foot] + row * kSpacing * left);
        for (std::size_t i = before; i < footholds_[foot].size(); ++i)
          footholds_[foot][i].beside = std::abs(row) / static_cast<double>(kRows);
      }
    }
  }
}

/// At even distances along the reference of the CoM, and of a turn; only its ends where it is too long.
std::vector<FootholdLattice::Station> FootholdLattice::stations() const {
  const Layout& at = problem_->layout;
  const std::vector<Eigen::VectorXd>& x = problem_->reference.x;
  // At a number of knots, of which a fraction counts as the way does.
  const auto station = [&](double knots, double along) -> Station {
    const int k = std::min(static_cast<int>(knots), problem_->steps - 1);
    const double part = knots - k;
    const Eigen::VectorXd here = x[k] + part * (x[k + 1] - x[k]);
    const auto progress = [&](int knot) { return progress_at(problem_->course, knot, problem_->steps, 1.0).first; };
    return {{here.segment<3>(at.end(feet_[0])), here.segment<3>(at.end(feet_[1]))},
            problem_->rpy(here).z(),
            along,
            progress(k) + part * (progress(k + 1) - progress(k))};
  };
  std::vector<double> pieces;
  double length = 0.0;
  for (std::size_t k = 0; k + 1 < x.size(); ++k) {
    const double turn = problem_->rpy(x[k + 1]).z() - problem_->rpy(x[k]).z();
    pieces.push_back((x[k + 1] - x[k]).segment<2>(at.com()).norm() + kTurned * std::abs(turn));
    length += pieces.back();
  }
  std::vector<Station> out{station(0.0, 0.0)};
  double along = 0.0, next = kSpacing;
  for (std::size_t k = 0; k < pieces.size() && length < kMostStations * kSpacing; along += pieces[k++])
    for (; next < along + pieces[k]; next += kSpacing)
      out.push_back(station(static_cast<double>(k) + (next - along) / pieces[k], next));
  out.push_back(station(problem_->steps, length));
  return out;
}

/// How much further inside of its surface it is than its margins ask for, once it has been moved there by half of what
/// lies between footholds at most: narrow ones lie between others. Of what is narrower than the margins a little is
/// lacking; -1: too much is.
double FootholdLattice::ease_of(int foot, LatticePoint& foothold) const {
  const Polygon& polygon = problem_->polygons[foothold.surface];
  const Vector3d first = foothold.place;
  double ease = -1.0;
  for (int round = 0; round < kRounds && !(ease >= 0.0); ++round) {
    ease = std::numeric_limits<double>::infinity();
    for (int edge = 0; edge < polygon.edge_count(); ++edge) {
      const double inside =
          -polygon.overshoot(edge, foothold.place) - problem_->foothold_margin(feet_[foot], foothold.surface, edge);
      if (inside < 0.0 && round + 1 < kRounds) foothold.place += inside * polygon.edge_outward_W(edge);
      ease = std::min(ease, inside);
    }
  }
  return (foothold.place - first).norm() <= 0.5 * kSpacing && ease > -kLacking ? ease : -1.0;
}

/// Whether there is one just beside it.
bool FootholdLattice::known(int foot, const LatticePoint& foothold) const {
  const std::vector<LatticePoint>& all = footholds_[foot];
  for (std::size_t i = all.size(); i-- > 0 && all[i].station > foothold.station - 2.0 * kSpacing;)
    if (all[i].surface == foothold.surface && (all[i].place - foothold.place).norm() < 0.5 * kSpacing) return true;
  return false;
}

/// On every surface above or below a point.
void FootholdLattice::add(int foot, const Station& station, const Vector3d& above) {
  for (int surface : problem_->rules.surfaces(feet_[foot])) {
    const Polygon& polygon = problem_->polygons[surface];
    if (polygon.normal_W().z() < kUpright || boxes_[surface].exteriorDistance(Vector2d(above.head<2>())) > kSpacing)
      continue;
    LatticePoint out;
    out.place = {above.x(), above.y(), height_at(polygon, above.head<2>())};
    out.yaw = station.yaw;
    out.station = station.along;
    out.share = station.share;
    out.surface = surface;
    const double ease = ease_of(foot, out);
    if (ease <= -kLacking || known(foot, out) || !stands_free(foot, out)) continue;
    out.near_edge = std::max(1.0 - ease / kEase, 0.0);
    footholds_[foot].push_back(out);
  }
}

std::pair<int, int> FootholdLattice::between(int foot, double from, double to) const {
  const auto first = footholds_[foot].begin() + kGoal + 1, end = footholds_[foot].end();
  const auto before = [](const LatticePoint& a, double station) { return a.station < station; };
  const auto low = std::lower_bound(first, end, from, before), high = std::lower_bound(low, end, to, before);
  return {static_cast<int>(low - footholds_[foot].begin()), static_cast<int>(high - footholds_[foot].begin())};
}

/// Corners, edges' middles and middle of a sole, so much wider on all sides.
FootholdLattice::Sole FootholdLattice::sole(int foot, const Vector3d& place, double yaw, double room) const {
  const Vector2d along(std::cos(yaw), std::sin(yaw)), across(-along.y(), along.x());
  const Vector2d half = limits(foot).half_size + Vector2d::Constant(room);
  Sole out;
  for (int i = 0; i < 9; ++i) out[i] = place.head<2>() + (i / 3 - 1) * half[0] * along + (i % 3 - 1) * half[1] * across;
  return out;
}

/// No solid stands up where the sole is, or hangs where the leg is.
bool FootholdLattice::stands_free(int foot, const LatticePoint& foothold) const {
  for (const Vector2d& at : sole(foot, foothold.place, foothold.yaw, problem_->swing_room))
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const Polygon& polygon = problem_->polygons[i];
      if (static_cast<int>(i) == foothold.surface || !boxes_[i].contains(at) || polygon.normal_W().z() < kUpright)
        continue;
      const double top = height_at(polygon, at), over = top - foothold.place.z();
      if (over > kLow && over - problem_->thickness[i] < kHeadroom && outside_from_above(polygon, at) < 0.0)
        return false;
    }
  return true;
}

double FootholdLattice::lift(int foot, const LatticePoint& from, const LatticePoint& to) const {
  constexpr int kSamples = 16;
  const Eigen::Vector3d way = to.place - from.place;
  Eigen::AlignedBox2d swept(Vector2d(from.place.head<2>().cwiseMin(to.place.head<2>())),
                            Vector2d(from.place.head<2>().cwiseMax(to.place.head<2>())));
  const double size = limits(foot).half_size.norm() + problem_->swing_room;
  swept.min().array() -= size;
  swept.max().array() += size;
  std::vector<int> near;
  const double lowest = std::min(from.place.z(), to.place.z());
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const Polygon& polygon = problem_->polygons[i];
    if (polygon.normal_W().z() < kUpright || !boxes_[i].intersects(swept)) continue;
    double top = -std::numeric_limits<double>::infinity();
    for (const Vector3d& vertex : polygon.vertices_W()) top = std::max(top, vertex.z());
    if (top > lowest + 1e-6) near.push_back(static_cast<int>(i));
  }
  double out = 0.0;
  if (near.empty()) return out;
  for (int sample = 1; sample < kSamples; ++sample) {
    const double s = static_cast<double>(sample) / kSamples;
    const double gone = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);  // at rest at both ends
    const Vector3d here = from.place + gone * way;
    for (const Vector2d& at : sole(foot, here, from.yaw + gone * (to.yaw - from.yaw), 0.0))
      for (int i : near) {
        const Polygon& polygon = problem_->polygons[i];
        if (!boxes_[i].contains(at) || outside_from_above(polygon, at) >= 0.0) continue;
        const Vector2d off = at - here.head<2>();
        const double low = here.z() + (1.0 - gone) * rise_of(problem_->polygons[from.surface], off) +
                           gone * rise_of(problem_->polygons[to.surface], off);
        const double over = height_at(polygon, at) + problem_->swing_room - low;
        if (over - problem_->thickness[i] > kSpacing) continue;  // it passes below
        const bool left = i == from.surface || i == to.surface;
        const double needed = left ? over - problem_->swing_room : over;
        if (needed > 0.0) out = std::max(out, needed / SwingLift(s).value());
      }
  }
  return out;
}

}  // namespace mcplan::ddp
