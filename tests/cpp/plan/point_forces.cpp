#include "plan/point_forces.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <random>

#include "plan/point_fixtures.hpp"

namespace {

using Eigen::Vector3d;
using namespace fixtures;
using mcplan::CentroidalState;
using mcplan::ForceLaw;
using mcplan::Phase;
using mcplan::laws::Held;
using mcplan::laws::Linear;

constexpr double kMass = 60.0, kG = 9.81;

struct Random {
  std::mt19937 engine;
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
  Vector3d vector(double scale) { return {(*this)(-scale, scale), (*this)(-scale, scale), (*this)(-scale, scale)}; }
};

/// Two contacts of three and four points, forces of some hundred newtons in all directions.
Phase random_phase(Random& random, ForceLaw law) {
  Phase phase;
  phase.law = law;
  phase.intervals = 5;
  phase.duration = random(0.2, 1.2);
  phase.contacts.resize(3);
  for (int l : {0, 2}) {
    phase.contacts[l].surface = 0;
    for (int i = 0; i < 3 + l / 2; ++i) phase.contacts[l].points_W.push_back(random.vector(1.0));
    for (int j = 0; j < phase.node_count() * (3 + l / 2); ++j)
      phase.contacts[l].point_forces_W.push_back(random.vector(300.0));
  }
  return phase;
}

CentroidalState random_state(Random& random) { return {random.vector(1.0), random.vector(1.0), random.vector(5.0)}; }

/// Force of a point at the time t of a phase, inside interval j.
Vector3d force(const Phase& phase, int l, std::size_t i, int j, double t) {
  const auto& contact = phase.contacts[l];
  const std::size_t n = contact.points_W.size();
  const double s = t / (phase.duration / phase.intervals) - j;
  return std::holds_alternative<Held>(phase.law)
             ? contact.point_forces_W[j * n + i]
             : Vector3d(contact.point_forces_W[j * n + i] * (1 - s) + contact.point_forces_W[(j + 1) * n + i] * s);
}

/// c'' = sum f / m - g,  L' = sum (p - c) x f, by 40 steps of RK4 in every interval.
CentroidalState integrate(const Phase& phase, CentroidalState x, double until) {
  using Rate = Eigen::Matrix<double, 9, 1>;
  const double length = phase.duration / phase.intervals;
  for (int j = 0; j < phase.intervals && j * length < until; ++j) {
    const double begin = j * length, h = (std::min(begin + length, until) - begin) / 40;
    const auto rate = [&](double t, const Rate& state) {
      Rate out;
      out << state.segment<3>(3), 0, 0, -kG, 0, 0, 0;
      for (int l = 0; l < 3; ++l)
        for (std::size_t i = 0; i < phase.contacts[l].points_W.size(); ++i) {
          const Vector3d f = force(phase, l, i, j, t);
          out.segment<3>(3) += f / kMass;
          out.segment<3>(6) += (phase.contacts[l].points_W[i] - state.head<3>()).cross(f);
        }
      return out;
    };
    Rate state;
    state << x.com_W, x.com_velocity_W, x.angular_momentum_W;
    for (int step = 0; step < 40; ++step) {
      const double t = begin + step * h;
      const Rate a = rate(t, state), b = rate(t + h / 2, state + h / 2 * a), c = rate(t + h / 2, state + h / 2 * b),
                 d = rate(t + h, state + h * c);
      state += h / 6 * (a + 2 * b + 2 * c + d);
    }
    x = {state.head<3>(), state.segment<3>(3), state.tail<3>()};
  }
  return x;
}

}  // namespace

TEST_CASE("the closed form of forces at points is what RK4 integrates, at any instant") {
  for (const ForceLaw& law : {ForceLaw(Held()), ForceLaw(Linear())})
    for (unsigned seed = 1; seed <= 20; ++seed) {
      Random random{std::mt19937(seed)};
      const Phase phase = random_phase(random, law);
      const CentroidalState from = random_state(random);
      for (double part : {0.0, 0.13, 0.4, 0.77, 1.0}) {
        const double until = part * phase.duration;
        const CentroidalState ours = mcplan::integrate_phase(phase, from, until, kMass, kG);
        const CentroidalState truth = integrate(phase, from, until);
        CAPTURE(seed);
        CAPTURE(part);
        CHECK((ours.com_W - truth.com_W).norm() < 1e-10);
        CHECK((ours.com_velocity_W - truth.com_velocity_W).norm() < 1e-10);
        CHECK((ours.angular_momentum_W - truth.angular_momentum_W).norm() < 1e-10);
      }
    }
}

TEST_CASE("without forces the CoM falls and the angular momentum stays") {
  const CentroidalState from{{1, 2, 3}, {0.5, -0.4, 2.0}, {1.5, -2.5, 0.5}};
  const CentroidalState to = mcplan::integrate_interval(from, {}, {}, 0.4, kMass, kG);
  CHECK((to.com_W - Vector3d(1.2, 1.84, 3.8 - 0.08 * kG)).norm() < 1e-14);
  CHECK((to.com_velocity_W - Vector3d(0.5, -0.4, 2.0 - 0.4 * kG)).norm() < 1e-14);
  CHECK((to.angular_momentum_W - from.angular_momentum_W).norm() < 1e-12);
}

TEST_CASE("forces that cancel along one line move nothing") {
  Random random{std::mt19937(3)};
  Phase phase;
  phase.law = Linear();
  phase.duration = 0.7;
  phase.intervals = 2;
  phase.contacts.resize(1);
  const Vector3d a = random.vector(1.0), b = random.vector(1.0);
  phase.contacts[0].points_W = {a, b};
  for (double size : {100.0, -250.0, 400.0})
    for (double sign : {1.0, -1.0}) phase.contacts[0].point_forces_W.push_back(sign * size * (b - a));
  const CentroidalState from = random_state(random);
  const CentroidalState to = mcplan::integrate_phase(phase, from, 0.7, kMass, 0.0);
  CHECK((to.com_W - from.com_W - 0.7 * from.com_velocity_W).norm() < 1e-14);
  CHECK((to.angular_momentum_W - from.angular_momentum_W).norm() < 1e-12);
}

TEST_CASE("the momentum about a fixed point grows by the moment of the forces about it") {
  // d/dt (L + c x m v) = sum p x f - c x m g e_z: the left side sees the CoM's motion, the right side hardly does.
  Random random{std::mt19937(4)};
  const Phase phase = random_phase(random, Linear());
  const CentroidalState from = random_state(random);
  const CentroidalState to = mcplan::integrate_phase(phase, from, phase.duration, kMass, 0.0);
  const auto about_origin = [](const CentroidalState& x) {
    return Vector3d(x.angular_momentum_W + kMass * x.com_W.cross(x.com_velocity_W));
  };
  Vector3d impulse = Vector3d::Zero();
  for (const auto& contact : phase.contacts) {
    const std::size_t n = contact.points_W.size();
    for (std::size_t i = 0; i < n; ++i)
      for (int j = 0; j <= phase.intervals; ++j)  // the trapezoidal rule is exact for linear forces
        impulse += (j == 0 || j == phase.intervals ? 0.5 : 1.0) * phase.duration / phase.intervals *
                   contact.points_W[i].cross(contact.point_forces_W[j * n + i]);
  }
  CHECK((about_origin(to) - about_origin(from) - impulse).norm() < 1e-10);
}

TEST_CASE("an instant belongs to the interval that begins there, rounding aside") {
  Phase phase;
  phase.law = Held();
  phase.duration = 0.7;
  phase.intervals = 7;
  CHECK(mcplan::interval_time(phase, 0.0).interval == 0);
  for (int j = 1; j < 7; ++j) {
    CHECK(mcplan::interval_time(phase, 0.7 * j / 7).interval == j);
    CHECK(mcplan::interval_time(phase, 0.1 * j - 1e-15).interval == j);
    CHECK(mcplan::interval_time(phase, 0.1 * j - 1e-9).interval == j - 1);
  }
  CHECK(mcplan::interval_time(phase, 0.7).interval == 6);
  CHECK(mcplan::interval_time(phase, 0.7).fraction == doctest::Approx(1.0));
  CHECK(mcplan::interval_time(phase, 0.25).since_s == doctest::Approx(0.05));
}

TEST_CASE("an instant of a phase that lasts next to nothing has an interval too") {
  Phase phase;
  phase.law = Held();
  phase.intervals = 8;
  for (double duration : {5e-324, 1e-323, 1e-310, 1e-300, 1e-12, 1e300}) {
    phase.duration = duration;
    for (double t : {0.0, 0.5 * duration, duration, duration + 1e-9}) {
      const mcplan::IntervalTime at = mcplan::interval_time(phase, t);
      CHECK(at.interval >= 0);
      CHECK(at.interval < phase.intervals);
      CHECK(at.fraction >= 0.0);
      CHECK(at.fraction <= 1.0);
    }
  }
}

TEST_CASE("held forces stay over an interval, linear ones go from node to node") {
  Random random{std::mt19937(5)};
  for (const ForceLaw& law : {ForceLaw(Held()), ForceLaw(Linear())}) {
    const Phase phase = random_phase(random, law);
    const double t = 0.53 * phase.duration;  // interval 2, 65 % of it
    const auto forces = mcplan::point_forces(phase, phase.contacts[2], mcplan::interval_time(phase, t));
    REQUIRE(forces.size() == 4);
    for (int i = 0; i < 4; ++i) CHECK((forces[i] - force(phase, 2, i, 2, t)).norm() < 1e-10);
    CHECK(mcplan::point_forces(phase, phase.contacts[1], mcplan::interval_time(phase, t)).empty());
  }
}
