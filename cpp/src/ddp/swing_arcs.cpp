#include "ddp/swing_arcs.hpp"

#include "ddp/problem.hpp"

namespace mcplan::ddp {

using Eigen::Vector3d;

void set_swing_arcs(const Problem& problem, const ContactSequence& sequence, Trajectory& t) {
  const Layout& at = problem.layout;
  t.swing_arcs.resize(problem.steps + 1);
  for (auto& row : t.swing_arcs) row.resize(at.end_effector_count());
  const auto duration = [&](int k) { return t.u[k][at.duration()]; };
  for (int l = 0; l < at.end_effector_count(); ++l)
    for (int k = 0; k <= problem.steps; ++k) {
      t.swing_arcs[k][l].known = false;
      if (sequence[k][l] != kFree) continue;
      const int first = k;
      while (k < problem.steps && sequence[k][l] == kFree) t.swing_arcs[k++][l].known = false;
      double total = 0.0;  // of the phases first..k-1
      for (int j = first; j < k; ++j) total += duration(j);
      double before = 0.0;
      for (int j = first; j < k; ++j) {
        SwingArc& arc = t.swing_arcs[j][l];
        arc = SwingArc();
        arc.known = true;
        arc.duration = duration(j);
        arc.before = before;
        before += arc.duration;
        arc.after = j + 1 < k ? total - before : 0.0;
        if (j > first) {
          arc.stride_before = t.u[j - 1].segment<3>(at.stride(l));
          arc.duration_before = duration(j - 1);
        }
        if (j + 1 < k) {
          arc.stride_after = t.u[j + 1].segment<3>(at.stride(l));
          arc.duration_after = duration(j + 1);
        }
        if (first > 0) arc.lift_normal = problem.polygons[sequence[first - 1][l]].normal_W();
        if (sequence[k][l] != kFree) arc.land_normal = problem.polygons[sequence[k][l]].normal_W();
      }
      t.swing_arcs[k][l].known = false;
    }
}

OnArc on_arc(const SwingArc& arc, double f, const Vector3d& from, const Vector3d& stride, double h) {
  const double f2 = f * f, f3 = f2 * f, f4 = f3 * f, f5 = f4 * f;
  OnArc out;
  out.by_stride = 10.0 * f3 - 15.0 * f4 + 6.0 * f5;
  out.place = from + out.by_stride * stride;
  out.by_duration.setZero();
  // At a knot inside the swing v = (stride + stride') / (h + h'), which enters times h and the quintic's slope there.
  const auto pass = [&](double slope, const Vector3d& other, double h_other) {
    if (!(h_other > 0.0) || !(h + h_other > 0.0)) return;
    const Vector3d velocity = (stride + other) / (h + h_other);
    out.place += h * slope * velocity;
    out.by_stride += slope * h / (h + h_other);
    out.by_duration += slope * h_other / (h + h_other) * velocity;
  };
  pass(f - 6.0 * f3 + 8.0 * f4 - 3.0 * f5, arc.stride_before, arc.duration_before);
  pass(-4.0 * f3 + 7.0 * f4 - 3.0 * f5, arc.stride_after, arc.duration_after);
  const double total = arc.before + h + arc.after;
  out.s = total > 0.0 ? (arc.before + f * h) / total : f;
  out.s_by_duration = total > 0.0 ? (f - out.s) / total : 0.0;
  return out;
}

}  // namespace mcplan::ddp
