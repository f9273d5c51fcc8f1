#include "ddp/constants.hpp"
#include "ddp/cost_terms.hpp"

namespace mcplan::ddp {
namespace {

/// Distance to the reference and size of the inputs (Tazaki, sec. III-A, the equation of L_task), as
/// 1/2 w^2 e^2 where the paper writes w^2 e^2: a common factor. With Model::wrench also |c_l|, |r_l| and the angular
/// momentum, which keep it close to the paper's model where that is good enough. Discovery weighs these more: soft ones
/// lead to needless jumps there.
class Task final : public CostTerm {
 public:
  Task() : CostTerm("task", Scope::step, 10) {}

  void write(const StepView& step, Rows& rows) const override {
    // The limbs of a robot that is tracked have momentum that the plan does not know of: it stays upright and on the
    // middle of its soles. (Measured on g1, stepping_stones: falls with the weights of the paper's robot.)
    const bool tracked = step.problem.robot.tracked, firm = step.schedule.discovering || tracked;
    write_state(step, firm, rows);
    if (step.u) write_input(step, firm ? kFirm : 1.0, tracked ? kCentred : 1.0, rows);
  }

 private:
  static void write_state(const StepView& step, bool firm, Rows& rows) {
    const Problem& problem = step.problem;
    const Layout& at = problem.layout;
    const Weights& w = problem.options.weights;
    const bool first = step.k == 0, last = step.k == problem.steps;
    // The robot starts as it is. Only in the paper's model the CoM's position is held no harder than there: on point
    // feet side by side nothing can move it forward, and a few millimetres off balance are how it starts to walk.
    const bool paper = problem.options.method == Method::paper, wrench = problem.model == Model::wrench;
    const int first_pinned = paper ? at.nx() : wrench ? 0 : at.velocity();
    const double stiffer = firm ? kFirm : 1.0;
    const double angle = wrench ? (firm ? kFirmAngle : 1.0) * w.angle : w.rotation;
    const auto weight = [&](double inside, double end) { return first || last ? end : inside; };
    // In the paper's model it is the rates that are weighted, omega = I^-1 L.
    const auto momentum_weight = [&](int a) {
      const double inside = wrench ? stiffer * w.momentum : w.rotation / problem.inertia[at.axes()[a]];
      return weight(inside, wrench ? w.rotation_end : w.rotation_end / problem.inertia[at.axes()[a]]);
    };
    const Eigen::VectorXd& reference = first ? problem.start : problem.reference.x[step.k];
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
      if (last && problem.free_end && (i < 2 || i >= at.end(0))) wi = i < 2 ? w.com : w.end_effector;
      if (last && problem.pinned_end) wi = kPinnedEnd;
      if (problem.measured && !last && i == at.velocity() + 2) wi *= kVerticalFirmer;
      if (first && i >= first_pinned) wi = kPinned;
      rows.add_single(wi, step.x[i] - reference[i], i);
    }
  }

  static void write_input(const StepView& step, double stiffer, double centred, Rows& rows) {
    const Layout& at = step.problem.layout;
    const Weights& w = step.problem.options.weights;
    const auto add = [&](double weight, int i) { rows.add_single(weight, (*step.u)[i], at.nx() + i); };
    for (int l = 0; l < at.end_effector_count(); ++l) {
      for (int i = 0; i < 3; ++i) add(w.stride, at.stride(l) + i);
      add(w.stiffness, at.stiffness(l));
    }
    for (int l = 0; l < at.end_effector_count(); ++l) {
      for (int i = 0; i < at.pressure_count(l); ++i) add(centred * w.center_of_pressure, at.pressure(l) + i);
      // Of point feet that a controller follows the term "upright" keeps the line vertical instead: of the level parts.
      const int first = step.problem.limits[l].balances ? 2 : 0;
      for (int i = 0; i < at.force_line_count(l); ++i)
        add(i < first ? 0.0 : stiffer * w.force_line, at.force_line(l) + i);
    }
    for (int i = 0; i < at.moment_count(); ++i) add(w.moment, at.moment(i));
  }
};

}  // namespace

namespace cost {
const CostTerm& task() {
  static const Task term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
