#pragma once

#include <array>
#include <vector>

#include "ddp/polish/fixed_sequence.hpp"
#include "ddp/polish/leg_lengths.hpp"
#include "ddp/polish/motion.hpp"

namespace mcplan::ddp::polish {

/// What a measured start violates by itself, and how long that is forgiven. A row r <= 0 of the limits that follow from
/// the state has the value v_0 at the start, where it changes at the rate w_0 if nothing intervenes. At time t it is
/// relaxed to
///
///     r <= max(0, v_0 + max(0, w_0) t) max(0, 1 - (t / T)^2),
///
/// which the checker forgives, too (Plan::start_slack_s). Of limits on where end-effectors are relative to the base and
/// on headings of soles; what stands does not move. Times are those of the present iterate: the rows' gradients do not
/// know of them.
class StartSlack {
 public:
  StartSlack() = default;

  /// Without Problem::start_slack there is none.
  StartSlack(const FixedSequence& fixed, const Motion& motion, const LegLengths& legs);

  /// Times from now on.
  void set_times(const FixedSequence& fixed, const Trajectory& trajectory);

  bool any() const { return any_; }

  /// Amount by which one of the reach_rows() of an end-effector, planned so far inside, is relaxed at time t, the
  /// length of its leg, and a side of its range of yaw.
  double reach(int l, int row, double t, double room) const {
    return amount({reach_[l][row].value + room, reach_[l][row].rate}, t);
  }
  double leg(int l, double t, double room) const { return amount({leg_[l].value + room, leg_[l].rate}, t); }
  double yaw(int l, bool upper, double t) const { return amount(yaw_[l][upper ? 0 : 1], t); }

  double knot_time(int k) const { return times_[k]; }

 private:
  struct Row {
    double value, rate;
  };
  double amount(const Row& row, double t) const;

  double horizon_ = 0.0;
  bool any_ = false;
  std::vector<std::vector<Row>> reach_;
  std::vector<Row> leg_;
  std::vector<std::array<Row, 2>> yaw_;
  std::vector<double> times_;
};

}  // namespace mcplan::ddp::polish
