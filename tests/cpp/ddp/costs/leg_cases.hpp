#pragma once

#include "check_rows.hpp"

namespace support {

/// The paper's robot with all base axes alive and legs that are bodies, on a floor with a post beside the way.
inline ddp::Problem with_legs_by_a_post(double radius = 0.06, bool soles = true) {
  mcplan::Scene scene = scenes::flat();
  mcplan::Surface post = scenes::rectangle("post", 0.3, 0.5, 0.15, 0.35, 1.4, "hand");
  post.thickness = 1.4;
  mcplan::Surface curb = scenes::rectangle("curb", 0.3, 0.5, -0.35, -0.15, 0.08, "hand");
  curb.thickness = 0.08;
  scene.surfaces.push_back(post);
  scene.surfaces.push_back(curb);
  mcplan::Robot robot = scenes::humanoid44();
  robot.inertia = {4.0, 5.0, 6.0};
  for (auto& end : robot.end_effectors) {
    end.yaw_range = {-0.3, 0.5};
    if (end.kind != "foot") continue;
    if (!soles) end.half_size.setZero();
    end.limb.hip_B = Eigen::Vector3d(0.02, 0.8 * end.nominal_B.y(), -0.05);
    end.limb.hip_shift = -0.1;
    end.limb.upper = 0.36;
    end.limb.lower = 0.34;
    if (soles) end.limb.ankle = Eigen::Vector3d(-0.01, 0.005, 0.06);
    end.limb.radius = radius;
    end.limb.beside = end.nominal_B.y() > 0.0 ? 0.04 : -0.04;
  }
  return ddp::Problem(scene, robot, phases(6));
}

/// The end-effector whose nominal place is to the left: the feet come first.
inline int left_foot_of(const ddp::Problem& problem) {
  int foot = 0;
  while (problem.limits[foot].nominal.y() < 0.0) ++foot;
  return foot;
}

/// A state in which the CoM is at a place above the floor, legs beside the post, and a stride.
inline VectorXd beside_the_post(const ddp::Problem& problem, Random& random, double size) {
  VectorXd z = random_z(problem, random, size);
  const Eigen::Vector3d move = Eigen::Vector3d(0.3, -0.06, 0.7) / 0.7 - z.segment<3>(problem.layout.com());
  z.segment<3>(problem.layout.com()) += move;
  for (int l = 0; l < problem.layout.end_effector_count(); ++l) z.segment<3>(problem.layout.end(l)) += move;
  return z;
}

/// Check the gradients of a term at random places at which legs are near the post and not in it, where the deepest
/// point of a line jumps from side to side. The nearest point of a line is known to half of its distance's digits.
inline void check_leg_rows(const ddp::Problem& problem, const Writer& legs, std::uint64_t seed) {
  Random random(seed);
  int checked = 0;
  for (int i = 0; i < 400 && checked < 20; ++i) {
    const VectorXd z = beside_the_post(problem, random, 0.08), found = values(problem, legs, z);
    double room = 1.0;
    for (const auto& rooms : problem.leg_rooms)
      for (double own : rooms) room = std::min(room, own);
    if (found.size() > 0 && found.minCoeff() > 1e-2 - room) checked += check_rows(problem, legs, z, 1e-6);
  }
  CHECK(checked >= 20);
}

}  // namespace support
