#include <Eigen/Geometry>

#include "check_rows.hpp"
#include "plan/clearance.hpp"

namespace {

using namespace support;
using Eigen::Matrix3d;
using Eigen::Vector3d;

enum { before, after, right_pad, left_pad, slope };

constexpr double kContactWeight = 3.0, kYaw = 0.6;

Writer pressure_of(const ddp::Problem& problem, int l, int surface) {
  return term(problem, "pressure", {2, l, surface, kContactWeight, 0.0, kYaw});
}

/// Price of a centre of pressure `offset` from the left foot, which stands at `foot` (non-dimensional).
double price(const ddp::Problem& problem, int surface, const Vector3d& foot, const Vector3d& offset) {
  const ddp::Layout& at = problem.layout;
  VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
  x.segment<3>(at.end(1)) = foot;
  u.segment(at.pressure(1), at.pressure_count(1)) = at.offsets(1).pressure.transpose() * offset;
  return cost(problem, pressure_of(problem, 1, surface), x, u);
}

}  // namespace

TEST_CASE("centre of pressure: gradients, with its plane among the dynamics' directions or among the rows") {
  for (bool differing_normals : {true, false}) {
    const ddp::Problem problem = workshop(phases(6), differing_normals);
    CHECK(problem.layout.pressure_count(1) == (differing_normals ? 3 : 2));
    check_rows(problem, pressure_of(problem, 1, before), 54, 0.4, 60);
    if (differing_normals) check_rows(problem, pressure_of(problem, 1, slope), 55, 0.4, 60);
  }
}

TEST_CASE("the centre of pressure lies in the sole's rectangle, which heads where the sole does") {
  for (bool differing_normals : {true, false}) {
    const ddp::Problem problem = workshop(phases(6), differing_normals);
    const Vector3d middle = problem.polygons[before].centroid_W();
    const Matrix3d sole = mcplan::sole_frame(Vector3d::UnitZ(), kYaw);
    CHECK((sole.col(0) - Vector3d(std::cos(kYaw), std::sin(kYaw), 0)).norm() <= 1e-15);
    const double weight = 0.5 * 100.0 * 100.0;
    for (int i : {0, 1})
      for (double sign : {1.0, -1.0}) {
        const double half = (i == 0 ? 0.10 : 0.05) / 0.7;
        CHECK(price(problem, before, middle, sign * 0.999 * half * sole.col(i)) == doctest::Approx(0).epsilon(1e-20));
        CHECK(price(problem, before, middle, sign * (half + 0.01) * sole.col(i)) == doctest::Approx(weight * 1e-4));
      }
  }
}

TEST_CASE("where the dynamics leave it free, a row keeps the centre of pressure in its surface's plane") {
  const ddp::Problem problem = workshop();
  const double weight = 0.5 * 100.0 * 100.0;
  for (int surface : {before, slope}) {
    const Vector3d middle = problem.polygons[surface].centroid_W(), n = problem.polygons[surface].normal_W();
    const Matrix3d sole = problem.sole_frame(surface, kYaw);
    CHECK((sole.col(2) - n).norm() <= 1e-15);
    const Vector3d inside = 0.05 * sole.col(0) - 0.03 * sole.col(1);
    CHECK(price(problem, surface, middle, inside) <= 1e-25);
    CHECK(price(problem, surface, middle, inside + 0.02 * n) == doctest::Approx(weight * 4e-4));
  }
}

TEST_CASE("nothing presses beyond the edge of a surface, though the sole may stick out") {
  const ddp::Problem problem = workshop();
  const double weight = 0.5 * std::pow(kContactWeight * problem.options.weights.overshoot_factor, 2);
  const double edge = 0.5 / 0.7, margin = 0.002 / 0.7;  // of the ground before the gap
  const Vector3d forward = Vector3d::UnitX();
  CHECK(price(problem, before, {edge, 0, 0}, -2 * margin * forward) == 0.0);
  CHECK(price(problem, before, {edge, 0, 0}, Vector3d::Zero()) == doctest::Approx(weight * margin * margin));
  CHECK(price(problem, before, {edge, 0, 0}, 0.05 * forward) == doctest::Approx(weight * std::pow(0.05 + margin, 2)));
}

TEST_CASE("points and the paper's model have no centre of pressure to be priced") {
  const ddp::Problem wrench = workshop(), lipm = workshop(phases(6, ddp::Model::lipm));
  CHECK(wrench.layout.pressure_count(2) == 0);
  for (int l : {0, 2}) CHECK(lipm.layout.pressure_count(l) == 0);
  Random random(56);
  CHECK(values(wrench, pressure_of(wrench, 2, right_pad), random_z(wrench, random, 1.0)).size() == 0);
  CHECK(values(lipm, pressure_of(lipm, 1, before), random_z(lipm, random, 1.0)).size() == 0);
}
