#pragma once

#include <utility>
#include <vector>

#include "rhp/pieces/linear_force_step.hpp"
#include "rhp/pieces/support.hpp"

/// A walk's interval with linear forces, made from points and forces alone.
namespace mcplan::rhp::tests {

inline constexpr double kMass = 95.0, kGravity = 9.80665;
inline constexpr int kIntervals = 7;

struct Motion {
  Vector3d com, velocity, momentum;
};

/// Points at which forces act that go linearly from `begin` to `end` within h.
struct Contacts {
  std::vector<Vector3d> points, begin, end;
  double h = 0.0;

  Vector3d acceleration(double t) const {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) sum += begin[i] + (end[i] - begin[i]) * t / h;
    return sum / kMass - kGravity * Vector3d::UnitZ();
  }
  Vector3d rate(double t, const Vector3d& com) const {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i)
      sum += (points[i] - com).cross(begin[i] + (end[i] - begin[i]) * t / h);
    return sum;
  }

  /// Newton and Euler up to a fraction of h, in small steps of the classical Runge-Kutta method, which knows nothing of
  /// polynomials in closed form.
  Motion integrate(Motion at, double until = 1.0) const {
    constexpr int kSteps = 400;
    const double dt = until * h / kSteps;
    const auto slope = [&](double t, const Motion& m) { return Motion{m.velocity, acceleration(t), rate(t, m.com)}; };
    const auto ahead = [](const Motion& m, const Motion& s, double dt) {
      return Motion{m.com + dt * s.com, m.velocity + dt * s.velocity, m.momentum + dt * s.momentum};
    };
    for (int i = 0; i < kSteps; ++i) {
      const double t = i * dt;
      const Motion k1 = slope(t, at), k2 = slope(t + dt / 2, ahead(at, k1, dt / 2)),
                   k3 = slope(t + dt / 2, ahead(at, k2, dt / 2)), k4 = slope(t + dt, ahead(at, k3, dt));
      for (const auto& [k, weight] : {std::pair(k1, 1.0), std::pair(k2, 2.0), std::pair(k3, 2.0), std::pair(k4, 1.0)})
        at = ahead(at, k, dt / 6.0 * weight);
    }
    return at;
  }
};

/// One interval of a walk: five points, forces of some hundred newtons that change a lot.
struct Interval {
  Contacts contacts;
  Motion begin, end;
  Vector3d a0, a1, R0, R1;

  explicit Interval(unsigned seed) {
    Random random(seed);
    contacts.h = random.in(0.02, 0.2);
    for (int i = 0; i < 5; ++i) {
      contacts.points.push_back(random.three(0.4));
      contacts.begin.push_back(Vector3d(0.0, 0.0, 190.0) + random.three(100.0));
      contacts.end.push_back(Vector3d(0.0, 0.0, 190.0) + random.three(100.0));
    }
    begin = {Vector3d(0.1, 0.0, 0.75) + random.three(0.1), random.three(), random.three(2.0)};
    end = contacts.integrate(begin);
    a0 = contacts.acceleration(0.0);
    a1 = contacts.acceleration(contacts.h);
    R0 = contacts.rate(0.0, begin.com);
    R1 = contacts.rate(contacts.h, end.com);
  }
  double duration() const { return kIntervals * contacts.h; }
  Motion at(double s) const { return contacts.integrate(begin, s); }
};

inline VectorXd row(const std::vector<Vector3d>& triples, double duration) {
  VectorXd out(3 * triples.size() + 1);
  for (std::size_t i = 0; i < triples.size(); ++i) out.segment<3>(3 * i) = triples[i];
  out[out.size() - 1] = duration;
  return out;
}

inline const LinearForceInterval kPlaces{0, 3, 6, 9, 12, 15, 18, 21, 24, 27, 30, kIntervals};

}  // namespace mcplan::rhp::tests
