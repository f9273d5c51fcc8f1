#pragma once

#include <utility>
#include <vector>

#include "ddp/routes.hpp"

namespace mcplan::ddp {

/// How the reference goes from the start to the goal.
struct Course {
  Route route;
  bool faces_way = false;             ///< the base turns to where it goes, and at the end to where the goal has it look
  std::vector<double> progress = {};  ///< share of the way at each knot; a cubic where the problem has other phases

  /// Whether the base looks elsewhere on the way than from the start to the goal.
  bool turns() const { return faces_way || !route.empty(); }
};

/// The share of the way at knot k of so many steps that last `total`, and its rate: what the course says, or a cubic
/// (Tazaki, sec. III-A).
std::pair<double, double> progress_at(const Course& course, int k, int steps, double total);

/// The yaw `to` [rad], counted so that the base turns by half a turn at most from `from`; one that is half a turn off
/// keeps its sign.
double turning_least(double from, double to);

/// Where the base looks along a course: evenly from the start's yaw to the goal's, or first to the way, straight ahead
/// or backwards, whichever asks for less turning, and last to the goal's; and with the turns of the route. Theory:
/// docs/theory/ddp.md, "Routes".
class Headings {
 public:
  /// Keeps a reference to the course. `from`, `to`: the yaw [rad] at start and goal; `way`: from the one to the other.
  Headings(const Course& course, double from, double to, const Eigen::Vector2d& way);

  double at(double share) const;    ///< [rad] at this share of the length
  double rate(double share) const;  ///< [rad] its slope over that share

  /// Whether the base keeps one heading from the start to the goal.
  bool straight() const { return straight_; }

  /// The largest angle [rad] that it has to turn by, to or from the way.
  double turn_to_way() const;

 private:
  const Course* course_;
  double from_ = 0.0, to_ = 0.0, way_ = 0.0;
  bool straight_ = true;
};

}  // namespace mcplan::ddp
