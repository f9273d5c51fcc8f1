#include "planar/sip/contact_gain.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "mcplan/planar/plan.hpp"
#include "tasks.hpp"

using mcplan::sip::ContactGain;

namespace {

/// Three points on a slope and two on a wall; parameters weigh them as case 3 does.
std::vector<ContactGain::Point> five_points() {
  const Eigen::Vector2d slope(std::cos(0.4), std::sin(0.4)), wall(0.0, -1.0);
  return {{{-0.5, -0.3}, slope, -1},
          {{-0.4, -0.25}, slope, 0},
          {{0.6, 0.2}, slope, 1},
          {{-0.9, 0.8}, wall, 2},
          {{-0.9, 0.6}, wall, 3}};
}

Eigen::VectorXd random_logs(std::mt19937& random, int count) {
  std::uniform_real_distribution<double> draw(-2.0, 2.0);
  Eigen::VectorXd out(count);
  for (double& p : out) p = draw(random);
  return out;
}

Eigen::VectorXd weights_of(const std::vector<ContactGain::Point>& points, const Eigen::VectorXd& logs) {
  Eigen::VectorXd out(points.size());
  for (std::size_t v = 0; v < points.size(); ++v)
    out[static_cast<int>(v)] = points[v].parameter < 0 ? 1.0 : std::exp(logs[points[v].parameter]);
  return out;
}

/// Forces and moment about p that unit forces along tangents and normals give.
Eigen::MatrixXd grasp_of(const std::vector<ContactGain::Point>& points) {
  Eigen::MatrixXd G(3, 2 * points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Eigen::Vector2d &x = points[v].place, t = points[v].tangent, n(-t.y(), t.x());
    const int c = 2 * static_cast<int>(v);
    G.col(c) << t.x(), t.y(), x.x() * t.y() - x.y() * t.x();
    G.col(c + 1) << n.x(), n.y(), x.x() * n.y() - x.y() * n.x();
  }
  return G;
}

}  // namespace

TEST_CASE("the gain solves the weighted least norm: its optimality system, by elimination") {
  std::mt19937 random(1);
  const auto points = five_points();
  ContactGain gain(points, 4);
  const Eigen::MatrixXd G = grasp_of(points);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::VectorXd logs = random_logs(random, 4), weights = weights_of(points, logs);
    gain.update(logs);
    // [W G'; G 0] [f; -lambda] = [0; D]
    const int forces = static_cast<int>(G.cols());
    Eigen::MatrixXd kkt = Eigen::MatrixXd::Zero(forces + 3, forces + 3);
    for (int v = 0; v < weights.size(); ++v) {
      kkt(2 * v, 2 * v) = 10.0 * weights[v];
      kkt(2 * v + 1, 2 * v + 1) = weights[v];
    }
    kkt.topRightCorner(forces, 3) = G.transpose();
    kkt.bottomLeftCorner(3, forces) = G;
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(forces + 3, 3);
    right.bottomRows(3).setIdentity();
    const Eigen::MatrixXd forces_of_unit = kkt.fullPivLu().solve(right).topRows(forces);
    CAPTURE(trial);
    CHECK((gain.value() - forces_of_unit).cwiseAbs().maxCoeff() < 1e-10);
    CHECK((G * gain.value() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-12);
  }
}

TEST_CASE("only ratios of weights matter") {
  // All five weighed by one parameter: whatever its value, the forces are those of weights of 1.
  auto points = five_points();
  for (auto& point : points) point.parameter = 0;
  ContactGain gain(points, 1);
  const Eigen::MatrixXd at_one = gain.value();
  gain.update(Eigen::VectorXd::Constant(1, 3.0));
  CHECK((gain.value() - at_one).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(gain.first(0).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(gain.second(0, 0).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("derivatives with respect to log weights agree with central differences") {
  std::mt19937 random(2);
  auto one_for_two = five_points();  // as case 2: a parameter weighs several points
  one_for_two[2].parameter = one_for_two[1].parameter = 0;
  one_for_two[3].parameter = one_for_two[4].parameter = 1;
  for (const auto& [points, parameters] : {std::pair(five_points(), 4), std::pair(one_for_two, 2)}) {
    ContactGain gain(points, parameters), moved(points, parameters);
    for (int trial = 0; trial < 10; ++trial) {
      const Eigen::VectorXd logs = random_logs(random, parameters);
      gain.update(logs);
      for (int a = 0; a < parameters; ++a) {
        const double step = 1e-5;
        Eigen::VectorXd above = logs, below = logs;
        above[a] += step;
        below[a] -= step;
        moved.update(above);
        Eigen::MatrixXd slope = moved.value();
        std::vector<Eigen::MatrixXd> bend;
        for (int b = 0; b < parameters; ++b) bend.push_back(moved.first(b));
        moved.update(below);
        slope = (slope - moved.value()) / (2.0 * step);
        CAPTURE(trial);
        CHECK((gain.first(a) - slope).cwiseAbs().maxCoeff() < 1e-8);
        for (int b = 0; b < parameters; ++b) {
          bend[b] = (bend[b] - moved.first(b)) / (2.0 * step);
          CHECK((gain.second(b, a) - bend[b]).cwiseAbs().maxCoeff() < 1e-8);
          CHECK((gain.second(a, b) - gain.second(b, a)).cwiseAbs().maxCoeff() < 1e-12);
        }
      }
    }
  }
}

TEST_CASE("the gain is that of planar plans") {
  const mcplan::PlanarTask task = planar_tasks::climbing();
  for (int phase : {0, 1, 3}) {
    const Eigen::Vector2d about = mcplan::moment_point_W(task, phase);
    std::vector<ContactGain::Point> points;
    for (const auto& contact : task.phases[phase].contacts)
      for (double along : task.robot.end_effectors[contact.end_effector].points) {
        const Eigen::Vector2d t(std::cos(contact.angle), std::sin(contact.angle));
        points.push_back({contact.position_W + along * t - about, t, static_cast<int>(points.size()) - 1});
      }
    std::mt19937 random(3);
    ContactGain gain(points, static_cast<int>(points.size()) - 1);
    const Eigen::VectorXd logs = random_logs(random, static_cast<int>(points.size()) - 1);
    gain.update(logs);
    const Eigen::MatrixXd expected = mcplan::least_norm_gain(task, phase, weights_of(points, logs));
    CHECK((gain.value() - expected).cwiseAbs().maxCoeff() < 1e-11);
  }
}
