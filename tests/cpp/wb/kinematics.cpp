#include "wb/kinematics.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <random>

using namespace mcplan::wb;
using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// The base's six joints and a branched tree behind them, at random places.
Problem tree(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
  Problem out;
  for (int i = 0; i < 12; ++i) {
    Link link;
    link.joint = "joint " + std::to_string(i);
    link.parent = i < 7 ? i - 1 : (i == 9 ? 6 : i - 1);
    link.prismatic = i < 3 || i == 10;
    link.axis = i < 6 ? Vector3d(Vector3d::Unit(i < 3 ? i : 5 - i)) : Vector3d(vector().normalized());
    link.rotation = AngleAxisd(normal(random), vector().normalized()).toRotationMatrix();
    link.position = vector();
    link.mass = 1.0 + std::abs(normal(random));
    link.center_of_mass = vector();
    out.links.push_back(link);
  }
  return out;
}

}  // namespace

TEST_CASE("Jacobians of points, rotations, the CoM and velocities are those of differences") {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const Problem problem = tree(random);
  Kinematics kinematics(problem);
  const int nv = problem.velocity_count(), link = 8;
  const VectorXd q = VectorXd::NullaryExpr(nv, [&] { return normal(random); });
  const VectorXd v = VectorXd::NullaryExpr(nv, [&] { return normal(random); });
  const Vector3d in_link(0.3, -0.2, 0.5);
  kinematics.update(q);
  const Vector3d place = kinematics.point(link, in_link);
  const Matrix3d R = kinematics.rotation(link);
  MatrixXd point(3, nv), turn(3, nv), com(3, nv), rate(6, nv);
  kinematics.point_jacobian(link, place, point);
  kinematics.rotation_jacobian(link, turn);
  kinematics.com_jacobian(com);
  kinematics.velocity_derivative(link, place, v, rate);
  const auto speed = kinematics.velocity(link, place, v);
  CHECK((point * v - speed.head<3>()).norm() < 1e-12);
  CHECK((turn * v - speed.tail<3>()).norm() < 1e-12);
  const double h = 1e-6;
  for (int i = 0; i < nv; ++i) {
    Vector3d points[2], coms[2];
    Matrix3d turns[2];
    Eigen::Matrix<double, 6, 1> speeds[2];
    for (int side = 0; side < 2; ++side) {
      VectorXd moved = q;
      moved[i] += side == 0 ? -h : h;
      kinematics.update(moved);
      points[side] = kinematics.point(link, in_link);
      coms[side] = kinematics.com();
      turns[side] = kinematics.rotation(link);
      speeds[side] = kinematics.velocity(link, place, v);
    }
    CHECK(((points[1] - points[0]) / (2.0 * h) - point.col(i)).norm() < 1e-8);
    CHECK(((coms[1] - coms[0]) / (2.0 * h) - com.col(i)).norm() < 1e-8);
    CHECK((rotation_log(turns[1] * turns[0].transpose()) / (2.0 * h) - turn.col(i)).norm() < 1e-8);
    CHECK(((speeds[1] - speeds[0]) / (2.0 * h) - rate.col(i)).norm() < 1e-7);
  }
  CHECK((R.transpose() * R - Matrix3d::Identity()).norm() < 1e-12);
}

TEST_CASE("the logarithm of rotations, and what small rotations add to it") {
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  for (double angle : {0.0, 1e-10, 1e-5, 0.3, 2.0, 3.0, 3.14159}) {
    const Vector3d axis = Vector3d(normal(random), normal(random), normal(random)).normalized();
    const Matrix3d R = AngleAxisd(angle, axis).toRotationMatrix();
    const Vector3d log = rotation_log(R);
    CHECK((log - angle * axis).norm() < 1e-7);
    if (angle > 3.1) continue;
    const Matrix3d jacobian = rotation_log_jacobian(log);
    const double h = 1e-6;
    for (int i = 0; i < 3; ++i) {
      const Matrix3d little = AngleAxisd(h, Vector3d::Unit(i)).toRotationMatrix();
      const Vector3d slope = (rotation_log(R * little) - rotation_log(R * little.transpose())) / (2.0 * h);
      CHECK((slope - jacobian.col(i)).norm() < 1e-6);
    }
  }
}
