#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <utility>
#include <vector>

#include "ddp/problem.hpp"

namespace mcplan::ddp {

/// Where a foot may stand.
struct LatticePoint {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  double yaw = 0.0;        ///< [rad] of the base there
  double station = 0.0;    ///< length of the course up to there
  double share = 0.0;      ///< and share of the way of the reference
  double beside = 0.0;     ///< 0..1, where it lies among the rows: 0 where the reference has the foot
  double near_edge = 0.0;  ///< how much nearer to an edge than to be at ease; 1: at the margin
  int surface = -1;
};

/// Footholds of two feet, the first and the second of them, beside the reference of a problem, non-dimensional, by
/// station: every few centimetres along it and across it, on each surface below that holds the sole with its margin.
class FootholdLattice {
 public:
  /// Of the start's and the goal's footholds, which come first.
  static constexpr int kStart = 0, kGoal = 1;

  /// Keeps a reference.
  FootholdLattice(const Problem& problem, const std::array<int, 2>& feet);

  const std::array<int, 2>& feet() const { return feet_; }
  const EndLimits& limits(int foot) const { return problem_->limits[feet_[foot]]; }

  const LatticePoint& at(int foot, int i) const { return footholds_[foot][i]; }
  int size(int foot) const { return static_cast<int>(footholds_[foot].size()); }

  /// First and one past the last foothold between two stations, without those of start and goal.
  std::pair<int, int> between(int foot, double from, double to) const;

  /// Of the course.
  double length() const { return length_; }

  /// How high a foot has to be lifted above the straight way between two footholds to pass over all solids.
  double lift(int foot, const LatticePoint& from, const LatticePoint& to) const;

 private:
  struct Station {
    std::array<Eigen::Vector3d, 2> feet;
    double yaw = 0.0, along = 0.0, share = 0.0;
  };
  std::vector<Station> stations() const;
  void add(int foot, const Station& station, const Eigen::Vector3d& above);
  double ease_of(int foot, LatticePoint& foothold) const;
  bool known(int foot, const LatticePoint& foothold) const;
  bool stands_free(int foot, const LatticePoint& foothold) const;
  using Sole = std::array<Eigen::Vector2d, 9>;
  Sole sole(int foot, const Eigen::Vector3d& place, double yaw, double room) const;

  const Problem* problem_;
  std::array<int, 2> feet_;
  std::vector<Eigen::AlignedBox2d> boxes_;  ///< about the surfaces, from above
  std::array<std::vector<LatticePoint>, 2> footholds_;
  double length_ = 0.0;
};

}  // namespace mcplan::ddp
