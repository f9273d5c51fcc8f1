#pragma once

#include <Eigen/Core>
#include <vector>

#include "ddp/polish/joint_rows.hpp"
#include "ddp/polish/leg_lengths.hpp"
#include "ddp/polish/limit_rows.hpp"
#include "ddp/polish/motion.hpp"
#include "ddp/polish/stage_costs.hpp"
#include "ddp/polish/start_slack.hpp"

namespace mcplan::ddp::polish {

/// Numbers of all rows, by row.
using RowArray = Eigen::ArrayXd;

/// Every inequality of the problem with its sequence given, as signed rows r(z) <= 0: all of them, always, in one
/// order, whether they are close to their bounds or not. They are those of the cost terms "bounds", "duration",
/// "flight_duration", "pressure", "reach", "interior_reach", "friction", "force_cap", "torsion", "yaw_range",
/// "soles", and of "contact" the edges, where a foothold is chosen, "joint_limits" as JointRows, and
/// LegLengths. A cone's row is |d_t| - mu n.d with
/// a root that has no kink.
class Limits {
 public:
  Limits(const FixedSequence& fixed, const Pendulum& pendulum, const Tuning& tuning);

  int count() const { return static_cast<int>(precision_.size()); }

  /// Squares of the weights that the cost terms have.
  const RowArray& precision() const { return precision_; }

  /// The headings of the soles, which the rectangles of the centres of pressure follow.
  void head(const Trajectory& trajectory);

  /// What a measured start violates by itself is forgiven for a while: see StartSlack. It is worked out at the begin of
  /// a solve, and as long as there is any its times follow the motion.
  void relax_from(const Motion& motion);
  bool relaxed() const { return start_slack_.any(); }
  void relax(const Motion& motion);

  /// r of all rows.
  void values(const Motion& motion, RowArray& r) const;

  /// Add sum of y_r a_r and D_r a_r a_r' of the rows of knot k, a_r the gradient of r over z.
  void add(const Motion& motion, int k, const RowArray& y, const RowArray& d, StageModel& model);

  /// a_r . dz of all rows. add() must have seen the same motion.
  void along(const Motion& motion, const std::vector<Eigen::VectorXd>& dz, RowArray& out);

 private:
  /// A row, or with its other side two, of a few columns of z.
  struct Linear {
    int row;
    bool two_sided;
    int count = 0;
    double min = 0.0, max = 0.0, offset = 0.0;
    int column[6];
    double factor[6];
    void touch(int c, double f) {
      column[count] = c;
      factor[count++] = f;
    }
  };
  /// Rectangle of a sole: two linear rows that turn with it.
  struct Sole {
    int k, linear, l, surface;
  };
  /// Two feet that stand from a knot on, one of which touches down there: a linear row that follows their headings.
  struct SolePair {
    int k, linear, l, other;
    double room;
  };
  struct OfPhase {
    std::vector<Linear> linear;
    int reach = -1;  ///< first row of the knot's reach boxes
    int legs = 0;    ///< first row of the lengths of legs
    int joints = 0;  ///< first row of their joints
    std::vector<OfContact> contacts;
    Eigen::MatrixXd lifted;  ///< of the instants after the first: d(com, angles)/d(moving), stacked
  };

  Linear& linear(int k, double weight, bool two_sided);
  int push(int rows, double weight);
  double variable(const Motion& motion, int k, int column) const;
  void make_linear(int k);
  void make_sole_pairs(int k);
  void part_soles(const Trajectory& trajectory);
  void lift(const Motion& motion, int k);
  void add_linear(int k, const RowArray& y, const RowArray& d, StageModel& model) const;
  void add_contact(const Motion& motion, int k, std::size_t c, const RowArray& y, const RowArray& d);
  void reach_along(const BodyPose& pose, int l, const Eigen::Vector3d& end, const Eigen::Vector3d& d_end,
                   const Eigen::Matrix<double, 6, 1>& d_pose, int& row, RowArray& out) const;
  void contact_along(const Motion& motion, int k, std::size_t c, const Eigen::VectorXd& dz, RowArray& out) const;
  void add_knot_reach(const Motion& motion, int k, const RowArray& y, const RowArray& d, StageModel& model) const;

  const FixedSequence* fixed_;
  const Pendulum* pendulum_;
  Tuning tuning_;
  std::vector<double> weights_;  ///< while rows are made
  RowArray precision_;
  LegLengths legs_;
  JointRows joints_;
  StartSlack start_slack_;
  RowArray slack_;  ///< taken off r; empty: none
  std::vector<OfPhase> phases_;
  std::vector<Sole> soles_;
  std::vector<SolePair> pairs_;
  // Scratch.
  Eigen::MatrixXd acting_, half_, end_turn_;
  Eigen::VectorXd gradient_, beside_, step_, carried_;
  std::vector<Eigen::Matrix<double, 6, 6>> poses_;
};

}  // namespace mcplan::ddp::polish
