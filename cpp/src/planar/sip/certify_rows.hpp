#pragma once

#include <string>
#include <vector>

#include "certify_amount.hpp"
#include "certify_dynamics.hpp"
#include "mcplan/planar/checker.hpp"

namespace mcplan::sip::proof {

using Kind = PlanarConstraint;

/// One scalar that a constraint bounds over an interval: the amount beyond the limit.
struct Row {
  Kind kind{};
  std::string where;
};

/// What has to be proved over one interval, measured as the checker measures it.
class IntervalRows {
 public:
  IntervalRows(const PlanarPlan& plan, const PhaseConstants& constants, int interval, int order, bool self_collision);

  const std::vector<Row>& rows() const { return rows_; }
  const Trajectories& interval() const { return interval_; }

  /// Amounts of the rows listed, over the piece [middle - half_width, middle + half_width] of [-1, 1].
  std::vector<Amount> evaluate(double middle, double half_width, const std::vector<int>& listed) const;

  /// Models of a piece, for what is asked at an instant only.
  Trajectories piece(double middle, double half_width) const { return interval_.restricted(middle, half_width); }

  double time_s(double s) const { return interval_.begin_s + 0.5 * (1.0 + s) * interval_.length_s; }

 private:
  template <class Visit>
  void visit(const Trajectories& piece, const PieceModels* models, const Visit& see) const;
  template <class Visit>
  void visit_joints(const Trajectories& piece, const PieceModels* models, const Visit& see) const;
  template <class Visit>
  void visit_contacts(const PieceModels* models, const Visit& see) const;
  template <class Visit>
  void visit_collisions(const PieceModels* models, const Visit& see) const;
  template <class Visit>
  void visit_solids(const PieceModels* models, const Visit& see) const;

  const PlanarPlan& plan_;
  const PhaseConstants& constants_;
  int order_;
  bool self_collision_;
  Trajectories interval_;
  std::vector<Row> rows_;
};

/// A row that is asked at one instant, and where.
struct InstantRow {
  Row row;
  int phase = -1;
  double time_s = 0.0;
  Amount amount;
};

/// Durations of phases, continuity at the knots, rest at both ends, heights and poses at given instants.
std::vector<InstantRow> instant_rows(const PlanarPlan& plan, const std::vector<PhaseConstants>& constants,
                                     const std::vector<IntervalRows>& intervals, int order);

/// Height of a point of an end-effector over a surface, and where it is along the surface [m].
struct OverSurface {
  TaylorModel height, along;
};
OverSurface over_surface(const PlanarPlan& plan, const PieceModels& models, int end_effector, int surface, int point);

/// How deep an end-effector is in the solid behind a surface [m]; negative: outside.
Amount depth_in_solid(const PlanarPlan& plan, const PieceModels& models, int end_effector, int surface);

/// How deep two capsules are in each other [m]; negative: apart.
Amount overlap(const PieceModels& models, int body_a, const Capsule& a, int body_b, const Capsule& b);

}  // namespace mcplan::sip::proof
