#include "mcplan/ddp/costs/costs.hpp"

namespace mcplan::ddp {

void task_cost(const Problem& problem, int k, const Eigen::VectorXd& x, const Eigen::VectorXd* u, Rows& rows) {
  const Layout& at = problem.layout;
  const Weights& w = problem.options.weights;
  const bool first = k == 0, last = k == problem.steps;
  // The robot starts as it is. Only the CoM's position is held no harder than in the paper: on point feet side by side
  // nothing can move it forward, and a few millimetres off balance are how this model starts to walk.
  constexpr double kPinned = 1000.0;
  const bool pinned = first && problem.options.method != Method::paper;
  const auto weight = [&](double inside, double end) { return first || last ? end : inside; };
  const Eigen::VectorXd& reference = first ? problem.start : problem.reference.x[k];

  rows.begin(Term::task);
  for (int i = 0; i < at.nx(); ++i) {
    double wi = 0.0;
    if (i < at.velocity())
      wi = weight(w.com, w.com_end);
    else if (i < at.angle())
      wi = weight(w.velocity, w.velocity_end);
    else if (i < at.end(0))
      wi = weight(w.rotation, w.rotation_end);
    else
      wi = weight(w.end_effector, w.end_effector_end);
    if (pinned && i >= at.velocity()) wi = kPinned;
    rows.add_single(wi, x[i] - reference[i], i);
  }
  if (!u) return;
  for (int l = 0; l < at.ends(); ++l) {
    for (int i = 0; i < 3; ++i) rows.add_single(w.stride, (*u)[at.stride(l) + i], at.nx() + at.stride(l) + i);
    rows.add_single(w.stiffness, (*u)[at.stiffness(l)], at.nx() + at.stiffness(l));
  }
  for (int i = 0; i < at.moment_count(); ++i) rows.add_single(w.moment, (*u)[at.moment(i)], at.nx() + at.moment(i));
}

}  // namespace mcplan::ddp
