#include "mcplan/planar/robot.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "mcplan/base/error.hpp"
#include "model/read.hpp"
#include "plane.hpp"
#include "robot_fields.hpp"

namespace mcplan {
namespace {

using planar::cross;
using planar::left_of;

using Eigen::Vector2d;

void relate_body(const PlanarBody& body, int index, const std::string& field) {
  if (index == 0) {
    if (body.parent != -1) throw InvalidRobot(field + ".parent", "must be -1 for the base", text(body.parent));
  } else if (body.parent < 0 || body.parent >= index) {
    throw InvalidRobot(field + ".parent", "must be an earlier body, 0 to " + text(index - 1) + " (no loops)",
                       text(body.parent));
  }
}

void require_range(const PlanarBody& body, const std::string& field) {
  if (!(body.position_min < body.position_max))
    throw InvalidRobot(field + ".position_max", "must exceed position_min",
                       text(body.position_min) + " to " + text(body.position_max));
}

void require_body(const PlanarEndEffector& end, int bodies, const std::string& field) {
  if (end.body < 0 || end.body >= bodies)
    throw InvalidRobot(field + ".body", "must be the index of a body (below " + text(bodies) + ")", text(end.body));
}

void require_different(const std::vector<double>& points, const std::string& field) {
  for (double point : points)
    if (std::count(points.begin(), points.end(), point) > 1)
      throw InvalidRobot(field + ".points", "must differ from each other", text(point) + " twice");
}

void validate_pair(const PlanarRobot& robot, const std::pair<int, int>& pair, const std::string& field) {
  const int bodies = static_cast<int>(robot.bodies.size());
  for (int body : {pair.first, pair.second}) {
    if (body < 0 || body >= bodies)
      throw InvalidRobot(field, "must be indices of bodies (below " + text(bodies) + ")", text(body));
    if (robot.bodies[body].capsules.empty())
      throw InvalidRobot(field, "must be bodies with capsules", text(robot.bodies[body].name));
  }
  if (pair.first == pair.second)
    throw InvalidRobot(field, "must be two different bodies", text(robot.bodies[pair.first].name) + " twice");
}

/// The names of bodies or end-effectors must differ.
template <class Items>
void require_unique_names(const Items& items, const std::string& list, model::Findings& found) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string field = list + "[" + std::to_string(i) + "].name";
    found.check({field}, [&] {
      if (!names.insert(items[i].name).second) throw InvalidRobot(field, "must be unique", text(items[i].name));
    });
  }
}

}  // namespace

double PlanarRobot::mass() const {
  double sum = 0.0;
  for (const PlanarBody& body : bodies) sum += body.mass;
  return sum;
}

int PlanarRobot::body_index(const std::string& body_name) const {
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies[b].name == body_name) return static_cast<int>(b);
  return -1;
}

int PlanarRobot::end_effector_index(const std::string& who) const {
  for (std::size_t l = 0; l < end_effectors.size(); ++l)
    if (end_effectors[l].name == who) return static_cast<int>(l);
  return -1;
}

std::vector<int> PlanarRobot::joints_to(int body) const {
  std::vector<int> joints;
  for (int b = body; b > 0; b = bodies[b].parent) joints.push_back(b - 1);
  std::reverse(joints.begin(), joints.end());
  return joints;
}

void PlanarRobot::validate() const {
  model::Findings found;
  model::check_struct(*this, model::Place(), found);
  model::relations(*this, found);
  found.raise<InvalidRobot>();
}

void model::relations(const PlanarRobot& robot, Findings& found) {
  const int bodies = static_cast<int>(robot.bodies.size());
  require_unique_names(robot.bodies, "bodies", found);
  for (int b = 0; b < bodies; ++b) {
    const PlanarBody& body = robot.bodies[b];
    const std::string field = "bodies[" + std::to_string(b) + "]";
    found.check({field + ".parent"}, [&] { relate_body(body, b, field); });
    found.check({field + ".position_min", field + ".position_max"}, [&] { require_range(body, field); });
  }
  require_unique_names(robot.end_effectors, "end_effectors", found);
  for (std::size_t l = 0; l < robot.end_effectors.size(); ++l) {
    const PlanarEndEffector& end = robot.end_effectors[l];
    const std::string field = "end_effectors[" + std::to_string(l) + "]";
    found.check({field + ".body"}, [&] { require_body(end, bodies, field); });
    found.check({field + ".points"}, [&] { require_different(end.points, field); });
  }
  for (std::size_t i = 0; i < robot.collision_pairs.size(); ++i) {
    const std::string field = "collision_pairs[" + std::to_string(i) + "]";
    found.check({field}, [&] { validate_pair(robot, robot.collision_pairs[i], field); });
  }
}

PlanarMotionOfFrame planar_point(const PlanarMotionOfFrame& body, const Vector2d& point_B, double angle_B) {
  const double c = std::cos(body.angle), s = std::sin(body.angle);
  const Vector2d arm_W(c * point_B.x() - s * point_B.y(), s * point_B.x() + c * point_B.y());
  PlanarMotionOfFrame point = body;
  point.position_W += arm_W;
  point.velocity_W += body.rate * left_of(arm_W);
  point.acceleration_W += body.angular_acceleration * left_of(arm_W) - body.rate * body.rate * arm_W;
  point.angle += angle_B;
  return point;
}

std::vector<PlanarMotionOfFrame> planar_kinematics(const PlanarRobot& robot, const PlanarConfiguration& x) {
  std::vector<PlanarMotionOfFrame> frames(robot.bodies.size());
  frames[0] = {x.base.head<2>(), x.base_velocity.head<2>(), x.base_acceleration.head<2>(),
               x.base[2],        x.base_velocity[2],        x.base_acceleration[2]};
  for (std::size_t b = 1; b < robot.bodies.size(); ++b) {
    const PlanarBody& body = robot.bodies[b];
    const Eigen::Index j = static_cast<Eigen::Index>(b) - 1;
    frames[b] = planar_point(frames[body.parent], body.joint_P, body.offset + x.q[j]);
    frames[b].rate += x.velocity[j];
    frames[b].angular_acceleration += x.acceleration[j];
  }
  return frames;
}

PlanarInverseDynamics planar_inverse_dynamics(const PlanarRobot& robot, const std::vector<PlanarMotionOfFrame>& frames,
                                              const std::vector<PlanarForce>& forces) {
  const int bodies = static_cast<int>(robot.bodies.size());
  // What a body's joint hands on to it: force, and moment about the body's origin.
  std::vector<Vector2d> force(bodies);
  std::vector<double> moment(bodies);
  for (int b = 0; b < bodies; ++b) {
    const PlanarBody& body = robot.bodies[b];
    const PlanarMotionOfFrame com = planar_point(frames[b], body.com_B);
    force[b] = body.mass * (com.acceleration_W + Vector2d(0.0, robot.gravity));
    moment[b] = body.inertia * frames[b].angular_acceleration + cross(com.position_W - frames[b].position_W, force[b]);
  }
  for (const PlanarForce& f : forces) {
    force[f.body] -= f.force_W;
    moment[f.body] -= cross(f.point_W - frames[f.body].position_W, f.force_W);
  }

  PlanarInverseDynamics out;
  out.torque.resize(bodies - 1);
  for (int b = bodies - 1; b > 0; --b) {
    const int parent = robot.bodies[b].parent;
    out.torque[b - 1] = moment[b];
    force[parent] += force[b];
    moment[parent] += moment[b] + cross(frames[b].position_W - frames[parent].position_W, force[b]);
  }
  out.base_residual << force[0], moment[0];
  return out;
}

PlanarInverseDynamics planar_inverse_dynamics(const PlanarRobot& robot, const PlanarConfiguration& configuration,
                                              const std::vector<PlanarForce>& forces) {
  return planar_inverse_dynamics(robot, planar_kinematics(robot, configuration), forces);
}

}  // namespace mcplan
