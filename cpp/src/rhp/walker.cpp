#include "rhp/walker.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mcplan/base/error.hpp"
#include "model/names.hpp"
#include "model/text.hpp"
#include "rhp/polytopes.hpp"

namespace mcplan::rhp {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// No CoM and no other foot is further than this from a foot in contact, along either horizontal axis [m].
constexpr double kFarthest_m = 2.0;

std::array<int, 2> two_feet(const Robot& robot) {
  std::vector<int> feet;
  for (std::size_t i = 0; i < robot.end_effectors.size(); ++i)
    if (robot.end_effectors[i].kind == "foot") feet.push_back(static_cast<int>(i));
  if (feet.size() != 2)
    throw InvalidRobot("end_effectors", "must have exactly two of kind \"foot\" to walk with rhp",
                       text(static_cast<int>(feet.size())));
  return {feet[0], feet[1]};
}

Range com_height_range(const Robot& robot, const Options& options) {
  // With the paper's absolute box feet are at most that much above or below the world's zero on its terrains.
  if (options.paper) return {kPaperComHeight.min - kPaperTerrain_m, kPaperComHeight.max + kPaperTerrain_m};
  return {options.com_height.min * robot.com_height, options.com_height.max * robot.com_height};
}

}  // namespace

Footstep Footsteps::operator[](int i) const {
  if (i < count()) return steps_[i];
  const Footstep& last = steps_.back();
  return {(i - count()) % 2 == 0 ? 1 - last.foot : last.foot, last.surface};
}

Walker::Walker(const Scene& scene_in, const Robot& robot_in, const Options& options_in)
    : scene(scene_in), robot(robot_in), options(options_in) {
  scene.validate();
  robot.validate();
  options.validate();
  r_WH = Eigen::AngleAxisd(scene.start.yaw, Vector3d::UnitZ()).toRotationMatrix();
  for (const Surface& surface : scene.surfaces) surfaces.emplace_back(surface.vertices_W);
  com_height_m = com_height_range(robot, options);
  goal_com_W = resolve_stance(scene, robot, scene.goal, "goal").com_W;

  const std::array<int, 2> end_effectors = two_feet(robot);
  for (int i = 0; i < 2; ++i) {
    const EndEffector& foot = robot.end_effectors[end_effectors[i]];
    const EndEffector& other = robot.end_effectors[end_effectors[1 - i]];
    Polytope com_reach = com_reach_of(foot), partner_reach = partner_reach_of(foot, other);
    if (!options.all_faces) {
      const Vector3d far(kFarthest_m, kFarthest_m, 0.0);
      com_reach = without_implied_rows(com_reach, -far + com_height_m.min * Vector3d::UnitZ(),
                                       far + com_height_m.max * Vector3d::UnitZ());
      // Feet in contact at the same time differ in height by at most the range of the CoM over each of them.
      const double rise = com_height_m.max - com_height_m.min;
      partner_reach =
          without_implied_rows(partner_reach, -far - rise * Vector3d::UnitZ(), far + rise * Vector3d::UnitZ());
    }
    feet[i].end_effector = end_effectors[i];
    feet[i].half_size = foot.half_size;
    // A force without a cap still needs a scale: four times the weight is beyond any walk.
    feet[i].max_force = std::min(foot.max_force, 4.0 * robot.mass * scene.gravity);
    feet[i].com_reach_W = rotated(com_reach, r_WH);
    feet[i].partner_reach_W = rotated(partner_reach, r_WH);
  }
}

Eigen::Matrix3d Walker::frame_W(int surface) const {
  const Vector3d& n = surfaces[surface].normal_W();
  Vector3d t1 = r_WH.col(0) - n * n.dot(r_WH.col(0));
  if (t1.norm() < 1e-6) t1 = r_WH.col(2) - n * n.dot(r_WH.col(2));
  t1.normalize();
  Eigen::Matrix3d out;
  out << t1, n.cross(t1), n;
  return out;
}

namespace {

/// How far a rectangle of this half size, centred at p, sticks out of a polygon at its worst edge.
std::pair<double, int> sticks_out(const Polygon& polygon, const Eigen::Matrix3d& frame, const Vector2d& half,
                                  const Vector3d& p) {
  std::pair<double, int> worst{-1e9, -1};
  for (int j = 0; j < polygon.edge_count(); ++j) {
    const Vector2d along = frame.leftCols<2>().transpose() * polygon.edge_outward_W(j);
    worst = std::max(worst, {polygon.overshoot(j, p) + along.cwiseAbs().dot(half), j});
  }
  return worst;
}

Vector3d moved_inside(const Polygon& polygon, const Eigen::Matrix3d& frame, const Vector2d& half, Vector3d p) {
  constexpr int kRounds = 100;
  for (int round = 0; round < kRounds; ++round) {
    const auto [over, edge] = sticks_out(polygon, frame, half, p);
    if (over <= 0.0) break;
    p -= over * polygon.edge_outward_W(edge);
  }
  return p;
}

}  // namespace

Vector2d Walker::taken_size(int foot, int surface) const {
  const Polygon& polygon = surfaces[surface];
  const Eigen::Matrix3d frame = frame_W(surface);
  const auto limit = margin_ratios.find({foot, surface});
  const double max_ratio = limit == margin_ratios.end() ? 1.0 : limit->second;
  for (double ratio : kMarginRatios) {
    if (options.paper) break;
    if (ratio > max_ratio) continue;
    const Vector2d half = feet[foot].half_size.array() + ratio * options.foothold_margin_m;
    if (sticks_out(polygon, frame, half, moved_inside(polygon, frame, half, polygon.centroid_W())).first <= 1e-9)
      return half;
  }
  return feet[foot].half_size;
}

void Walker::limit_margin(int foot, int surface, double ratio) {
  if (ratio >= 1.0) return;
  const auto [at, fresh] = margin_ratios.try_emplace({foot, surface}, ratio);
  if (!fresh) at->second = std::min(at->second, ratio);
}

Vector3d Walker::nearest_foothold_W(int foot, int surface, const Vector3d& desired_W) const {
  const Polygon& polygon = surfaces[surface];
  return moved_inside(polygon, frame_W(surface), taken_size(foot, surface),
                      desired_W - polygon.normal_W() * polygon.height(desired_W));
}

int Walker::foot_of(int end_effector) const {
  for (int i = 0; i < 2; ++i)
    if (feet[i].end_effector == end_effector) return i;
  return -1;
}

State Walker::start() const {
  const ResolvedStance stance = resolve_stance(scene, robot, scene.start, "start");
  State state;
  state.com_W = stance.com_W;
  for (const Foot& foot : feet) {
    if (stance.contacts[foot.end_effector] < 0)
      throw InvalidScene("start.contacts", "must put both feet on surfaces",
                         robot.end_effectors[foot.end_effector].name);
    state.feet_W.push_back(stance.end_effectors_W[foot.end_effector]);
    state.surfaces.push_back(stance.contacts[foot.end_effector]);
  }
  return state;
}

namespace {

std::vector<std::string> foot_names(const Walker& walker) {
  std::vector<std::string> out;
  for (const Foot& foot : walker.feet) out.push_back(walker.robot.end_effectors[foot.end_effector].name);
  return out;
}

}  // namespace

Footsteps footsteps_of(const Walker& walker) {
  const Scene& scene = walker.scene;
  if (scene.steps.empty())
    throw InvalidScene("steps", "must list at least one step (end_effector, surface), or take the sequence of a plan",
                       "none");
  std::vector<Footstep> out;
  for (std::size_t i = 0; i < scene.steps.size(); ++i) {
    const std::string field = "steps[" + std::to_string(i) + "]";
    const Step& step = scene.steps[i];
    const int foot = walker.foot_of(walker.robot.end_effector_index(step.end_effector));
    if (foot < 0)
      throw InvalidScene(field + ".end_effector",
                         model::name_rule("a foot of " + walker.robot.name, step.end_effector, foot_names(walker)),
                         text(step.end_effector));
    const int surface = scene.surface_index(step.surface);
    if (surface < 0)
      throw InvalidScene(field + ".surface",
                         model::name_rule("a surface", step.surface, model::names_of(scene.surfaces).names),
                         text(step.surface));
    if (!may_touch(scene.surfaces[surface], walker.robot.end_effectors[walker.feet[foot].end_effector]))
      throw InvalidScene(field + ".surface", "must admit " + step.end_effector, text(step.surface));
    out.push_back({foot, surface});
  }
  return {out, false};
}

Footsteps footsteps_of(const Walker& walker, const Plan& plan) {
  plan.validate();
  const int phases = static_cast<int>(plan.phases.size());
  const auto surface_here = [&](int k, int end) {
    const int index = k < phases ? plan.phases[k].contacts[end].surface : plan.final_contacts[end];
    if (index < 0) return -1;
    const int here = walker.scene.surface_index(plan.scene.surfaces[index].name);
    if (here < 0)
      throw InvalidPlan("scene.surfaces", "must exist in scene " + walker.scene.name,
                        text(plan.scene.surfaces[index].name));
    return here;
  };
  std::array<int, 2> end{-1, -1};
  for (int foot = 0; foot < 2; ++foot) {
    const std::string& name = walker.robot.end_effectors[walker.feet[foot].end_effector].name;
    end[foot] = plan.robot.end_effector_index(name);
    if (end[foot] < 0) throw InvalidPlan("robot.end_effectors", "must have the feet of " + walker.robot.name, name);
  }
  std::vector<Footstep> out;
  for (int k = 0; k <= phases; ++k) {
    const std::string field = k < phases ? "phases[" + std::to_string(k) + "]" : "final_contacts";
    for (int e = 0; e < plan.end_effector_count(); ++e)
      if (e != end[0] && e != end[1] && surface_here(k, e) >= 0)
        throw InvalidPlan(field, "must have feet alone in contact for rhp", plan.robot.end_effectors[e].name);
    if (surface_here(k, end[0]) < 0 && surface_here(k, end[1]) < 0)
      throw InvalidPlan(field, "must have a foot on the ground for rhp", "flight");
    for (int foot = 0; k > 0 && foot < 2; ++foot) {
      const int before = surface_here(k - 1, end[foot]), now = surface_here(k, end[foot]);
      if (now >= 0 && now != before) out.push_back({foot, now});
    }
  }
  if (out.empty()) throw InvalidPlan("phases", "must have a step in which a foot touches down", "none");
  return {out, true};
}

State start_of(const Walker& walker, const Plan& plan) {
  const Knot& knot = plan.knots.front();
  State state;
  state.com_W = knot.com_W;
  state.com_velocity_W = knot.com_velocity_W;
  state.angular_momentum_W = plan.at(0.0).angular_momentum_W;
  for (const Foot& foot : walker.feet) {
    const int end = plan.robot.end_effector_index(walker.robot.end_effectors[foot.end_effector].name);
    const int surface = plan.phases.front().contacts[end].surface;
    if (surface < 0)
      throw InvalidPlan("phases[0]", "must start on both feet for rhp",
                        walker.robot.end_effectors[foot.end_effector].name);
    state.feet_W.push_back(knot.end_effectors_W[end]);
    state.surfaces.push_back(walker.scene.surface_index(plan.scene.surfaces[surface].name));
  }
  return state;
}

void require_state(const Walker& walker, const State& state) {
  if (state.feet_W.size() != 2 || state.surfaces.size() != 2)
    throw InvalidInput("measured.feet_W", "must have two feet, with a surface for each",
                       text(static_cast<int>(state.feet_W.size())));
  for (int surface : state.surfaces)
    if (surface < 0 || surface >= static_cast<int>(walker.surfaces.size()))
      throw InvalidInput("measured.surfaces", "must be indices of surfaces", text(surface));
  bool finite = state.com_W.allFinite() && state.com_velocity_W.allFinite() && state.angular_momentum_W.allFinite();
  for (const Vector3d& foot : state.feet_W) finite = finite && foot.allFinite();
  if (!finite) throw InvalidInput("measured", "must be finite numbers", "nan or inf");
}

}  // namespace mcplan::rhp
