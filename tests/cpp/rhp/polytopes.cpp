#include "rhp/polytopes.hpp"

#include <doctest/doctest.h>

#include "rhp/walkers.hpp"

namespace mcplan::rhp::tests {
namespace {

using Eigen::Vector3d;
using walkers::Random;

double excess(const Polytope& polytope, const Vector3d& x) {
  return polytope.A.rows() == 0 ? -1e9 : (polytope.A * x - polytope.b).maxCoeff();
}

/// How far from `from` along d one can go within the polytope.
double way(const Polytope& polytope, const Vector3d& from, const Vector3d& d) {
  double least = 1e9;
  for (int i = 0; i < polytope.A.rows(); ++i) {
    const double slope = polytope.A.row(i).dot(d);
    if (slope > 1e-12) least = std::min(least, (polytope.b[i] - polytope.A.row(i).dot(from)) / slope);
  }
  return least;
}

/// Around zero; with faces that are nearly in one plane, as where a quadrangle was cut into two triangles.
Polytope random_polytope(Random& random) {
  std::vector<Eigen::Vector4d> rows;
  for (int i = 0; i < 24; ++i) {
    Eigen::Vector4d row;
    row << random.three().normalized(), random.in(0.3, 0.9);
    rows.push_back(row);
    if (i % 3 == 0) {
      const double little = std::pow(10.0, -random.in(2.0, 7.0));
      row.head<3>() = (row.head<3>() + little * random.three()).normalized();
      rows.push_back(row);
    }
  }
  return walkers::polytope(rows);
}

}  // namespace

TEST_CASE("rows left out are implied by the others wherever x is in the box") {
  int dropped = 0, kept = 0;
  for (unsigned seed = 0; seed < 25; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Polytope all = random_polytope(random);
    const Vector3d low(-2.0, -2.0, random.in(-0.5, -0.1)), high(2.0, 2.0, random.in(0.1, 0.5));
    const Polytope fewer = without_implied_rows(all, low, high), box = box_polytope(low, high);
    dropped += static_cast<int>(all.A.rows() - fewer.A.rows());
    kept += static_cast<int>(fewer.A.rows());
    // To the boundary along each row and about it, where a row that is missing would be passed.
    for (int i = 0; i < all.A.rows(); ++i)
      for (int k = 0; k < 60; ++k) {
        const Vector3d d = (all.A.row(i).transpose() + random.in(0.0, 1.0) * random.three()).normalized();
        const Vector3d at = std::min(way(fewer, Vector3d::Zero(), d), way(box, Vector3d::Zero(), d)) * d;
        CHECK(excess(all, at) < 1e-7);
      }
  }
  CHECK(dropped > 100);
  CHECK(kept > 100);
}

TEST_CASE("random points of the box keep the rows that are left exactly where they keep all") {
  int in = 0, out = 0;
  for (unsigned seed = 100; seed < 110; ++seed) {
    Random random(seed);
    const Polytope all = random_polytope(random);
    const Vector3d low(-2.0, -2.0, -0.3), high(2.0, 2.0, 0.2);
    const Polytope fewer = without_implied_rows(all, low, high);
    for (int k = 0; k < 2000; ++k) {
      const Vector3d x(random.in(-1.0, 1.0), random.in(-1.0, 1.0), random.in(-0.3, 0.2));
      ++(excess(all, x) <= 0.0 ? in : out);
      CHECK((excess(all, x) <= 0.0) == (excess(fewer, x) <= 1e-9));
    }
  }
  CHECK(in > 1000);
  CHECK(out > 1000);
}

TEST_CASE("every row that is left is needed somewhere") {
  Random random(7);
  const Polytope all = random_polytope(random);
  const Vector3d low(-2.0, -2.0, -0.3), high(2.0, 2.0, 0.2);
  const Polytope box = box_polytope(low, high), fewer = without_implied_rows(all, low, high);
  for (int i = 0; i < fewer.A.rows(); ++i) {
    CAPTURE(i);
    bool first_met = false;
    for (int k = 0; k < 20000 && !first_met; ++k) {
      const Vector3d d = (fewer.A.row(i).transpose() + random.three()).normalized();
      const double slope = fewer.A.row(i).dot(d);
      if (slope <= 0.0) continue;
      const double own = fewer.b[i] / slope;
      first_met = own <= std::min(way(fewer, Vector3d::Zero(), d), way(box, Vector3d::Zero(), d)) + 1e-9;
    }
    CHECK(first_met);
  }
}

TEST_CASE("a cube keeps its six faces, loses one far outside and one that touches a corner alone") {
  Polytope cube = box_polytope(Vector3d::Constant(-1.0), Vector3d::Constant(1.0));
  const Polytope more = walkers::polytope({{1, 1, 1, 5.0}, {1, 1, 1, 3.0}, {1, 1, 0, 2.0}});
  Polytope all;
  all.A.resize(9, 3);
  all.A << cube.A, more.A;
  all.b.resize(9);
  all.b << cube.b, more.b;
  const Polytope left = without_implied_rows(all, Vector3d::Constant(-3.0), Vector3d::Constant(3.0));
  CHECK(left.A == cube.A);
  CHECK(left.b == cube.b);
  CHECK(without_implied_rows(all, Vector3d::Constant(-0.5), Vector3d::Constant(0.5)).A.rows() == 0);
}

TEST_CASE("without polytopes a robot has the boxes of its reach") {
  Robot robot = walkers::robot();
  for (EndEffector& foot : robot.end_effectors) {
    foot.com_reach = {};
    foot.partner_reach.clear();
  }
  const EndEffector &left = robot.end_effectors[0], &right = robot.end_effectors[1];
  const Polytope com = com_reach_of(left), partner = partner_reach_of(left, right);
  Random random(9);
  int in = 0;
  for (int k = 0; k < 4000; ++k) {
    // A CoM and two feet: allowed where each foot is in its box, which is fixed to the CoM.
    const Vector3d foot = Vector3d(0.05, 0.2, -0.8) + random.three(0.8);
    const bool inside =
        (foot.array() >= left.reach_min_B.array()).all() && (foot.array() <= left.reach_max_B.array()).all();
    CHECK((excess(com, -foot) <= 0.0) == inside);
    const Vector3d other = Vector3d(0.05, -0.2, -0.8) + random.three(0.8);
    const bool also =
        (other.array() >= right.reach_min_B.array()).all() && (other.array() <= right.reach_max_B.array()).all();
    if (inside && also) {
      CHECK(excess(partner, other - foot) <= 0.0);
      ++in;
    }
  }
  CHECK(in > 10);
  // The corners of the difference of the two boxes are reached.
  CHECK(excess(partner, right.reach_max_B - left.reach_min_B) <= 1e-12);
  CHECK(excess(partner, right.reach_max_B - left.reach_min_B + Vector3d(1e-6, 0.0, 0.0)) > 0.0);
}

TEST_CASE("faces that cut the box of a foot say where the CoM may be, too") {
  EndEffector foot = walkers::robot().end_effectors[0];
  foot.com_reach = {};
  foot.reach_cut = walkers::polytope({{-0.6, 0.0, 0.8, -0.5}, {0.0, 1.0, 0.0, 0.3}});
  const Polytope com = com_reach_of(foot);
  Random random(10);
  int cut = 0;
  for (int k = 0; k < 4000; ++k) {
    const Vector3d place = Vector3d(0.05, 0.2, -0.8) + random.three(0.8);
    const bool in_box =
        (place.array() >= foot.reach_min_B.array()).all() && (place.array() <= foot.reach_max_B.array()).all();
    const bool inside = in_box && excess(foot.reach_cut, place) <= 0.0;
    CHECK((excess(com, -place) <= 0.0) == inside);
    cut += in_box && !inside;
  }
  CHECK(cut > 10);
}

TEST_CASE("a turned polytope holds the turned points") {
  Random random(11);
  const Polytope polytope = random_polytope(random);
  const Eigen::Matrix3d R = random.rotation();
  for (int k = 0; k < 200; ++k) {
    const Vector3d x = random.three();
    CHECK(excess(rotated(polytope, R), R * x) == doctest::Approx(excess(polytope, x)));
  }
}

}  // namespace mcplan::rhp::tests
