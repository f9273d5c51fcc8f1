#include "ddp/swing_arcs.hpp"

#include <doctest/doctest.h>

#include "ddp/plan_conversion.hpp"
#include "support.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

/// The left foot of a walk is free from phase 2 to the one before `end`.
ddp::ContactSequence one_swing(int steps, int end) {
  ddp::ContactSequence sequence(steps + 1, {0, 0});
  for (int k = 2; k < end; ++k) sequence[k][1] = ddp::kFree;
  return sequence;
}

/// A plan's foot is where the arc has it, through all phases of a swing.
double farthest_from_plan(const ddp::Problem& problem, ddp::Incumbent now, int end) {
  ddp::set_swing_arcs(problem, now.sequence, now.trajectory);
  mcplan::Plan plan = to_plan(problem, now);
  plan.swings.clear();  // without the lift
  double total = 0.0, passed = 0.0, farthest = 0.0;
  for (int k = 2; k < end; ++k) total += plan.phases[k].duration;
  for (int k = 2; k < end; ++k) {
    const ddp::SwingArc& arc = now.trajectory.swing_arcs[k][1];
    REQUIRE(arc.known);
    const Vector3d from = now.trajectory.x[k].segment<3>(problem.layout.end(1)),
                   stride = now.trajectory.u[k].segment<3>(problem.layout.stride(1));
    const double duration = now.trajectory.u[k][problem.layout.duration()];
    for (double f : {0.0, 0.15, 0.4, 0.7, 1.0}) {
      const ddp::OnArc on = on_arc(arc, f, from, stride, duration);
      const Vector3d there = plan.at_phase(k, f * plan.phases[k].duration).end_effectors[1].position_W;
      farthest = std::max(farthest, (on.place * problem.units.length - there).norm());
      CHECK(on.s == doctest::Approx((passed + f * plan.phases[k].duration) / total).epsilon(1e-12));
    }
    passed += plan.phases[k].duration;
  }
  return farthest;
}

}  // namespace

TEST_CASE("a foot that is free for one to four phases goes where its plan has it go") {
  const ddp::Problem problem(scenes::flat(), scenes::humanoid44(), phases(8));
  Random random(3);
  for (int end : {3, 4, 5, 6}) {
    ddp::Incumbent now;
    now.sequence = one_swing(8, end);
    now.trajectory = problem.initial_guess(now.sequence);
    for (int k = 0; k < 8; ++k) {
      now.trajectory.u[k][problem.layout.duration()] *= uniform(random, 0.6, 1.5);
      if (k >= 2 && k + 1 < end) {
        const Vector3d by = noise(random, 3, 0.1);
        now.trajectory.x[k + 1].segment<3>(problem.layout.end(1)) += by;
        now.trajectory.u[k].segment<3>(problem.layout.stride(1)) += by;
        now.trajectory.u[k + 1].segment<3>(problem.layout.stride(1)) -= by;
      }
    }
    CAPTURE(end);
    CHECK(farthest_from_plan(problem, now, end) < 1e-12);
  }
}

TEST_CASE("places on an arc have the derivatives of their values") {
  ddp::SwingArc arc;
  arc.known = true;
  arc.before = 0.7;
  arc.after = 0.4;
  arc.stride_before = {0.1, -0.2, 0.3};
  arc.stride_after = {0.4, 0.1, -0.1};
  arc.duration_before = 0.5;
  arc.duration_after = 0.4;
  const Vector3d from(0.3, 0.2, 0.1);
  for (double f : {0.0, 0.2, 0.5, 0.9, 1.0}) {
    VectorXd z(4);
    z << 0.5, -0.1, 0.2, 0.6;
    const ddp::OnArc on = on_arc(arc, f, from, z.head<3>(), z[3]);
    const MatrixXd expected = differences(
        [&](const VectorXd& at) {
          const ddp::OnArc here = on_arc(arc, f, from, at.head<3>(), at[3]);
          VectorXd out(4);
          out << here.place, here.s;
          return out;
        },
        z);
    CHECK((expected.topLeftCorner(3, 3) - on.by_stride * MatrixXd::Identity(3, 3)).norm() < 1e-10);
    CHECK((expected.col(3).head<3>() - on.by_duration).norm() < 1e-10);
    CHECK(expected(3, 3) == doctest::Approx(on.s_by_duration).epsilon(1e-9));
  }
}
