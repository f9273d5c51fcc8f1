#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "ddp/cost_terms.hpp"
#include "ddp/support.hpp"
#include "mcplan/base/rotation.hpp"

namespace support {

using ddp::Rows;

/// Writes a cost's rows at x and u.
using Writer = std::function<void(const VectorXd& x, const VectorXd& u, Rows& rows)>;

/// What a term is asked about besides x and u.
struct About {
  int k = 2, l = 1, surface = ddp::kFree;
  double contact_weight = 3.0, interior_weight = 0.0, sole_yaw = 0.0;
  bool discovering = false, clear_swings = false, hold_joints = true;
  const ddp::SwingArc* arc = nullptr;
  std::vector<double> sole_yaws = {};
};

/// Writes the rows of the term of this name, where it applies. Keeps a reference to the problem. Without u it is asked
/// about the last knot.
inline Writer term(const ddp::Problem& problem, const std::string& name, const About& about = {}) {
  const int index = ddp::cost_term_index(name);
  REQUIRE(index >= 0);
  const ddp::Pendulum pendulum(problem.layout, problem.inertia, problem.options.stiffness_input, problem.model);
  return [&problem, pendulum, index, about](const VectorXd& x, const VectorXd& u, Rows& rows) {
    ddp::Schedule schedule;
    schedule.tuning = problem.tuning();
    schedule.contact_weight = about.contact_weight;
    schedule.interior_weight = about.interior_weight;
    schedule.discovering = about.discovering;
    schedule.tuning.clear_swings = about.clear_swings;
    schedule.tuning.hold_joints = about.hold_joints;
    ddp::Instants instants;
    const bool last = u.size() == 0 || about.k == problem.steps;
    ddp::StepView step{problem,  pendulum, schedule,      about.k,        x,        last ? nullptr : &u,
                       instants, about.l,  about.surface, about.sole_yaw, about.arc};
    if (!about.sole_yaws.empty()) step.sole_yaws = &about.sole_yaws;
    if (step.u) instants.of(problem, pendulum, x, u);
    const ddp::CostTerm& term = *ddp::cost_terms()[static_cast<std::size_t>(index)];
    rows.begin(index);
    if (term.applies(step)) term.write(step, rows);
  };
}

/// The paper's robot with all base axes alive, on the paper's hardest scene with a slope of 30 degrees added.
inline ddp::Problem workshop(ddp::Options options = phases(6), bool with_slope = true) {
  mcplan::Scene scene = scenes::gap_with_rail();
  mcplan::Surface slope = scenes::rectangle("slope", 1.3, 2.0, -1, 1, 0, "foot");
  for (auto& v : slope.vertices_W) v.z() += std::tan(0.52) * v.x();
  if (with_slope) scene.surfaces.push_back(slope);
  scene.start.yaw = 0.4;
  mcplan::Robot robot = scenes::humanoid44();
  robot.inertia = {4.0, 5.0, 6.0};
  for (int i : {0, 1}) robot.end_effectors[i].max_moment = {20.0, 30.0, 10.0};
  for (auto& end : robot.end_effectors) end.yaw_range = {-0.3, 0.5};
  return ddp::Problem(scene, robot, options);
}

inline VectorXd random_z(const ddp::Problem& problem, Random& random, double size) {
  VectorXd z(problem.layout.nz());
  const ddp::Trajectory t = problem.initial_guess({});
  z << t.x[2], t.u[2];
  return z + noise(random, problem.layout.nz(), size);
}

inline VectorXd values(const ddp::Problem& problem, const Writer& write, const VectorXd& z) {
  Rows rows(problem.layout.nz(), true);
  write(z.head(problem.layout.nx()), z.tail(problem.layout.nu()), rows);
  VectorXd out(rows.count());
  for (int r = 0; r < rows.count(); ++r) out[r] = rows.value(r);
  return out;
}

/// Check every row's gradient against differences and the value-only cost against the full one. Returns the number of
/// rows; points whose set of active rows changes within the differences are passed over (0).
inline int check_rows(const ddp::Problem& problem, const Writer& write, const VectorXd& z, double tolerance = 1e-8) {
  constexpr double kStep = 1e-4;
  const int nx = problem.layout.nx(), nu = problem.layout.nu();
  Rows rows(problem.layout.nz(), true), value_only(problem.layout.nz(), false);
  write(z.head(nx), z.tail(nu), rows);
  write(z.head(nx), z.tail(nu), value_only);
  CHECK(value_only.cost() == doctest::Approx(rows.cost()).epsilon(1e-14));
  double sum = 0.0;
  for (int r = 0; r < rows.count(); ++r) sum += 0.5 * rows.precision(r) * rows.value(r) * rows.value(r);
  CHECK(sum == doctest::Approx(rows.cost()).epsilon(1e-14));
  if (rows.count() == 0) return 0;
  for (int i = 0; i < nx + nu; ++i)
    for (double by : {-2 * kStep, -kStep, kStep, 2 * kStep}) {
      VectorXd moved = z;
      moved[i] += by;
      if (values(problem, write, moved).size() != rows.count()) return 0;
    }
  const MatrixXd expected = differences([&](const VectorXd& at) { return values(problem, write, at); }, z, kStep);
  for (int r = 0; r < rows.count(); ++r) {
    CAPTURE(r);
    const double size = 1.0 + rows.gradient(r).cwiseAbs().maxCoeff();
    CHECK((rows.gradient(r) - expected.row(r).transpose()).cwiseAbs().maxCoeff() <= tolerance * size);
    if (rows.single(r) >= 0) CHECK(rows.gradient(r)[rows.single(r)] == 1.0);
  }
  return rows.count();
}

/// The same at random points until `wanted` rows have been checked.
inline void check_rows(const ddp::Problem& problem, const Writer& write, std::uint64_t seed, double size, int wanted) {
  Random random(seed);
  int checked = 0;
  for (int i = 0; i < 200 && checked < wanted; ++i)
    checked += check_rows(problem, write, random_z(problem, random, size));
  CHECK(checked >= wanted);
}

inline double cost(const ddp::Problem& problem, const Writer& write, const VectorXd& x, const VectorXd& u) {
  Rows rows(problem.layout.nz(), false);
  write(x, u, rows);
  return rows.cost();
}

/// A base turned about all axes, every end-effector at its nominal place in the base's frame.
inline VectorXd nominal(const ddp::Problem& problem) {
  VectorXd x = VectorXd::Zero(problem.layout.nx());
  const Eigen::Vector3d com(0.3, -0.2, 1.1), rpy(0.3, -0.2, 1.0);
  x.segment<3>(problem.layout.com()) = com;
  x.segment<3>(problem.layout.angle()) = rpy;
  for (int l = 0; l < problem.layout.end_effector_count(); ++l)
    x.segment<3>(problem.layout.end(l)) = com + mcplan::rotation_from_rpy(rpy) * problem.limits[l].nominal;
  return x;
}

}  // namespace support
