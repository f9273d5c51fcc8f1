#include "ddp/headings.hpp"

#include <algorithm>
#include <cmath>

#include "ddp/constants.hpp"

namespace mcplan::ddp {
namespace {

/// From 0 to 1, level at both ends.
double smooth(double share) {
  const double in = std::clamp(share, 0.0, 1.0);
  return in * in * (3.0 - 2.0 * in);
}

}  // namespace

double turning_least(double from, double to) {
  constexpr double kEqual = 1e-9;
  return std::abs(to - from) > M_PI + kEqual ? from + std::remainder(to - from, 2.0 * M_PI) : to;
}

Headings::Headings(const Course& course, double from, double to, const Eigen::Vector2d& way)
    : course_(&course), from_(from), to_(to), way_(from) {
  straight_ = from_ == to_ && course.route.empty() && !course.faces_way;
  if (!(way.norm() > 0.0)) return;
  const double ahead = std::atan2(way.y(), way.x());
  const double nearest = ahead + 2.0 * M_PI * std::round((0.5 * (from_ + to_) - ahead) / (2.0 * M_PI));
  const auto turning = [&](double yaw) { return std::abs(yaw - from_) + std::abs(to_ - yaw); };
  constexpr double kEqual = 1e-6;
  way_ = nearest;
  for (const double half_turns : {-2.0, 2.0, -1.0, 1.0})
    if (turning(nearest + half_turns * M_PI) < turning(way_) - kEqual) way_ = nearest + half_turns * M_PI;
}

double Headings::at(double share) const {
  const double turn = turn_on(course_->route, share);
  if (!course_->faces_way) return from_ + (to_ - from_) * share + turn;
  return from_ + (way_ - from_) * smooth(share / kTurnShare) +
         (to_ - way_) * smooth((share - 1.0 + kTurnShare) / kTurnShare) + turn;
}

double Headings::rate(double share) const {
  constexpr double kNear = 1e-3;
  const double before = std::max(share - kNear, 0.0), after = std::min(share + kNear, 1.0);
  return (at(after) - at(before)) / (after - before);
}

double Headings::turn_to_way() const { return std::max(std::abs(way_ - from_), std::abs(to_ - way_)); }

std::pair<double, double> progress_at(const Course& course, int k, int steps, double total) {
  const double s = static_cast<double>(k) / steps;
  if (static_cast<int>(course.progress.size()) != steps + 1)
    return {s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s) / total};
  const bool inside = k > 0 && k < steps;
  return {course.progress[k], inside ? 0.5 * (course.progress[k + 1] - course.progress[k - 1]) * steps / total : 0.0};
}

}  // namespace mcplan::ddp
