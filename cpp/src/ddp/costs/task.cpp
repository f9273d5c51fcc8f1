#include "mcplan/ddp/constants.hpp"
#include "mcplan/ddp/costs/costs.hpp"

namespace mcplan::ddp {

void task_cost(const Problem& problem, int k, const Eigen::VectorXd& x, const Eigen::VectorXd* u, bool discovering,
               Rows& rows) {
  const Layout& at = problem.layout;
  const Weights& w = problem.options.weights;
  const bool first = k == 0, last = k == problem.steps;
  // The robot starts as it is. Only in the paper's model the CoM's position is held no harder than there: on point feet
  // side by side nothing can move it forward, and a few millimetres off balance are how it starts to walk.
  const bool paper = problem.options.method == Method::paper, wrench = problem.model == Model::wrench;
  const int first_pinned = paper ? at.nx() : wrench ? 0 : at.velocity();
  // A robot that leaves room to its controller has limbs whose momentum the plan does not know of: it stays upright and
  // on the middle of its soles. (Measured on g1, stepping_stones: falls with the weights of the paper's robot.)
  const bool tracked = problem.robot.pressure_share < 1.0, firm = discovering || tracked;
  const double stiffer = firm ? kFirm : 1.0, centred = tracked ? kCentred : 1.0;
  const double angle = wrench ? (firm ? kFirmAngle : 1.0) * w.angle : w.rotation;
  const auto weight = [&](double inside, double end) { return first || last ? end : inside; };
  // In the paper's model it is the rates that are weighted, omega = I^-1 L.
  const auto momentum_weight = [&](int a) {
    const double inside = wrench ? stiffer * w.momentum : w.rotation / problem.inertia[at.axes()[a]];
    return weight(inside, wrench ? w.rotation_end : w.rotation_end / problem.inertia[at.axes()[a]]);
  };
  const Eigen::VectorXd& reference = first ? problem.start : problem.reference.x[k];

  rows.begin(Term::task);
  for (int i = 0; i < at.nx(); ++i) {
    double wi = 0.0;
    if (i < at.velocity())
      wi = weight(w.com, w.com_end);
    else if (i < at.angle())
      wi = weight(w.velocity, w.velocity_end);
    else if (i < at.momentum())
      wi = weight(angle, w.rotation_end);
    else if (i < at.end(0))
      wi = momentum_weight(i - at.momentum());
    else
      wi = weight(w.end_effector, w.end_effector_end);
    if (first && i >= first_pinned) wi = kPinned;
    rows.add_single(wi, x[i] - reference[i], i);
  }
  if (!u) return;
  for (int l = 0; l < at.ends(); ++l) {
    for (int i = 0; i < 3; ++i) rows.add_single(w.stride, (*u)[at.stride(l) + i], at.nx() + at.stride(l) + i);
    rows.add_single(w.stiffness, (*u)[at.stiffness(l)], at.nx() + at.stiffness(l));
  }
  for (int l = 0; l < at.ends(); ++l) {
    for (int i = 0; i < at.pressure_count(l); ++i)
      rows.add_single(centred * w.center_of_pressure, (*u)[at.pressure(l) + i], at.nx() + at.pressure(l) + i);
    for (int i = 0; i < at.force_line_count(l); ++i)
      rows.add_single(stiffer * w.force_line, (*u)[at.force_line(l) + i], at.nx() + at.force_line(l) + i);
  }
  for (int i = 0; i < at.moment_count(); ++i) rows.add_single(w.moment, (*u)[at.moment(i)], at.nx() + at.moment(i));
}

}  // namespace mcplan::ddp
