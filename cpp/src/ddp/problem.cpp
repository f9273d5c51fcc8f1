#include "mcplan/ddp/problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "mcplan/base/error.hpp"
#include "mcplan/base/rotation.hpp"
#include "mcplan/ddp/constants.hpp"
#include "mcplan/plan/clearance.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using Eigen::VectorXd;

std::vector<int> addressed(const std::vector<std::string>& who, const Robot& robot, const std::vector<int>& active) {
  std::vector<int> out;
  for (std::size_t l = 0; l < active.size(); ++l)
    for (const std::string& w : who)
      if (addresses(w, robot.end_effectors[active[l]])) {
        out.push_back(static_cast<int>(l));
        break;
      }
  return out;
}

/// Directions in which an end-effector's centre of pressure, or its moments, may lie: the common plane or normal of all
/// surfaces that it may touch, or all of space where these differ. The dynamics must not depend on which one it is;
/// rows of the contact then keep to its plane and normal.
std::optional<Vector3d> common_normal(const std::vector<Polygon>& polygons, const std::vector<int>& surfaces) {
  constexpr double kParallel = 1e-9;
  for (int i : surfaces)
    if ((polygons[i].normal_W() - polygons[surfaces.front()].normal_W()).norm() > kParallel) return std::nullopt;
  return polygons[surfaces.front()].normal_W();
}

/// An end-effector that stands below the CoM shifts its force's line sideways: along itself would be nearly the same as
/// another stiffness. Where it may touch surfaces that it meets at an angle, walls above all, the line goes anywhere.
Matrix3Xd force_line_directions(const Vector3d& nominal, const std::vector<Polygon>& polygons,
                                const std::vector<int>& surfaces) {
  const bool facing = std::all_of(surfaces.begin(), surfaces.end(), [&](int i) {
    return std::abs(polygons[i].normal_W().dot(nominal)) > kFacing * nominal.norm();
  });
  // The two are level: those of an end-effector that hangs down.
  return Eigen::Matrix3d::Identity().leftCols(facing && std::abs(nominal.z()) > kFacing * nominal.norm() ? 2 : 3);
}

Layout wrench_layout(const std::vector<EndLimits>& limits, const std::vector<Polygon>& polygons,
                     const std::vector<std::vector<int>>& surfaces) {
  std::vector<Layout::Offsets> ends;
  std::vector<Layout::Moment> moments;
  for (std::size_t l = 0; l < limits.size(); ++l) {
    const std::optional<Vector3d> normal = common_normal(polygons, surfaces[l]);
    Layout::Offsets offsets;
    if (limits[l].half_size.maxCoeff() > 0.0) {
      if (normal)
        offsets.pressure = mcplan::sole_frame(*normal, 0.0).leftCols<2>();
      else
        offsets.pressure = Eigen::Matrix3d::Identity();
    }
    offsets.force_line = force_line_directions(limits[l].nominal, polygons, surfaces[l]);
    ends.push_back(offsets);
    const double most = limits[l].moment_max.z();
    if (most <= 0.0) continue;
    if (normal)
      moments.push_back({static_cast<int>(l), *normal, most});
    else
      for (int i = 0; i < 3; ++i) moments.push_back({static_cast<int>(l), Vector3d::Unit(i), most});
  }
  return Layout(ends, {0, 1, 2}, moments);
}

/// The paper's: axes that no moment drives are left out, unless `all_axes`.
Layout lipm_layout(const std::vector<EndLimits>& limits, bool all_axes) {
  std::vector<int> axes;
  for (int axis = 0; axis < 3; ++axis)
    if (all_axes ||
        std::any_of(limits.begin(), limits.end(), [&](const EndLimits& e) { return e.moment_max[axis] > 0.0; }))
      axes.push_back(axis);
  std::vector<Layout::Moment> moments;
  for (std::size_t l = 0; l < limits.size(); ++l)
    for (int axis : axes)
      if (all_axes || limits[l].moment_max[axis] > 0.0)
        moments.push_back({static_cast<int>(l), Vector3d::Unit(axis), limits[l].moment_max[axis]});
  return Layout(std::vector<Layout::Offsets>(limits.size()), axes, moments);
}

/// Tangents of a pyramid of `sides` sides about a normal.
std::vector<Vector3d> pyramid_tangents(const Vector3d& normal, int sides) {
  const Eigen::Matrix3d frame = mcplan::sole_frame(normal, 0.0);
  std::vector<Vector3d> out;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * M_PI * i / sides;
    out.push_back(std::cos(angle) * frame.col(0) + std::sin(angle) * frame.col(1));
  }
  return out;
}

}  // namespace

Problem::Problem(const Scene& scene_in, const Robot& robot_in, const Options& options_in)
    : scene(scene_in), robot(robot_in), options(options_in) {
  scene.validate();
  robot.validate();
  options.validate();
  model = options.effective_model();
  units.length = robot.com_height;
  units.time = std::sqrt(robot.com_height / scene.gravity);
  units.mass = robot.mass;
  similarity = similarity_of(robot, scene.gravity);
  inertia = robot.inertia / (units.mass * units.length * units.length);
  edge_margin = pressure_margin = kEdgeMargin_m * similarity.length / units.length;
  const Eigen::Vector2d usual_s = phase_duration_of(robot, similarity);
  const double shortest_s = options.duration_min_s > 0.0 ? options.duration_min_s : usual_s[0];
  const double longest_s = options.duration_max_s > 0.0 ? options.duration_max_s : usual_s[1];
  if (longest_s < shortest_s) {
    // Options that are both given were compared before: one of the two is the robot's.
    if (options.duration_min_s > 0.0)
      throw InvalidOptions("duration_min_s", "must be at most the robot's longest phase, " + text(longest_s),
                           text(shortest_s));
    throw InvalidOptions("duration_max_s", "must be at least the robot's shortest phase, " + text(shortest_s),
                         text(longest_s));
  }
  duration_min = shortest_s / units.time;
  duration_max = longest_s / units.time;
  const double flight_s = by_size(options.flight_duration_min_s, Options().flight_duration_min_s, similarity.time);
  flight_duration_min = std::min(flight_s, longest_s) / units.time;
  const double middle_s = model == Model::wrench ? 0.5 * (shortest_s + longest_s) : kLipmDuration_s * similarity.time;
  duration_initial = (options.duration_initial_s > 0.0 ? options.duration_initial_s : middle_s) / units.time;

  const int robot_ends = static_cast<int>(robot.end_effectors.size());
  std::vector<std::vector<int>> surfaces;
  for (int e = 0; e < robot_ends; ++e) {
    std::vector<int> list;
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i)
      if (may_touch(scene.surfaces[i], robot.end_effectors[e])) list.push_back(static_cast<int>(i));
    if (list.empty() && options.method != Method::paper) continue;
    active.push_back(e);
    surfaces.push_back(list);
  }
  for (const Surface& surface : scene.surfaces) {
    std::vector<Vector3d> scaled;
    for (const Vector3d& v : surface.vertices_W) scaled.push_back(v / units.length);
    polygons.emplace_back(scaled);
    keep_out_depth.push_back(kKeepOutDepth * surface.thickness / units.length);
    friction.push_back(surface.grasp
                           ? std::numeric_limits<double>::infinity()
                           : std::max(surface.friction - kFrictionMargin, kFrictionRatioMin * surface.friction));
    pyramid.push_back(pyramid_tangents(polygons.back().normal_W(), options.friction_sides));
  }
  if (options.friction_sides > 0) pyramid_share = std::cos(M_PI / options.friction_sides);
  const double reach_margin_m = by_size(options.reach_margin_m, Options().reach_margin_m, similarity.length);
  for (int e : active) {
    const EndEffector& end = robot.end_effectors[e];
    const Vector3d margin = Vector3d::Constant(options.method == Method::paper ? 0.0 : reach_margin_m);
    EndLimits l;
    l.nominal = end.nominal_B / units.length;
    // A box thinner than the margins keeps its middle.
    const Vector3d middle = 0.5 * (end.reach_min_B + end.reach_max_B);
    l.reach_min = (end.reach_min_B + margin).cwiseMin(middle) / units.length;
    l.reach_max = (end.reach_max_B - margin).cwiseMax(middle) / units.length;
    l.force_max = std::min(end.max_force / units.force(), kForceCapMax);
    l.half_size = end.half_size / units.length;
    l.half_width = l.half_size.minCoeff();
    l.pressure_half = robot.pressure_share * l.half_size;
    l.moment_max = end.max_moment / units.moment();
    // The paper's model knows no headings of soles.
    const bool turns = model == Model::wrench;
    l.yaw_min = turns ? end.yaw_range[0] : -std::numeric_limits<double>::infinity();
    l.yaw_max = turns ? end.yaw_range[1] : std::numeric_limits<double>::infinity();
    limits.push_back(l);
  }
  layout = model == Model::lipm ? lipm_layout(limits, options.method == Method::paper)
                                : wrench_layout(limits, polygons, surfaces);
  std::vector<StateRule> state_rules;
  for (const ContactRule& rule : scene.rules) {
    // Judged on the whole robot: a rule about what it does not have is void, and what a required name does not find, or
    // finds among those that may touch nothing, can never be in contact.
    const auto known = [&](const std::string& who) {
      return std::any_of(robot.end_effectors.begin(), robot.end_effectors.end(),
                         [&](const EndEffector& e) { return addresses(who, e); });
    };
    if (std::none_of(rule.when_free.begin(), rule.when_free.end(), known)) continue;
    bool possible = std::all_of(rule.require.begin(), rule.require.end(), known);
    for (int e = 0; e < robot_ends; ++e)
      for (const std::string& who : rule.require)
        if (addresses(who, robot.end_effectors[e]) && std::find(active.begin(), active.end(), e) == active.end())
          possible = false;
    StateRule state_rule{addressed(rule.when_free, robot, active), addressed(rule.require, robot, active)};
    // Unless one of `when_free` stands: the only way to keep a rule whose demand cannot be met.
    if (!possible) state_rule.require = state_rule.when_free;
    state_rules.push_back(state_rule);
  }
  rules = ContactRules(surfaces, state_rules, options.one_switch_per_step);

  const ResolvedStance from = resolve_stance(scene, robot, scene.start, "start");
  const ResolvedStance to = resolve_stance(scene, robot, scene.goal, "goal");
  base_rpy = Vector3d(0.0, 0.0, from.yaw);
  start_yaw.assign(layout.ends(), from.yaw);
  goal_yaw = to.yaw;
  make_foothold_margins();
  const auto state_of = [&](const ResolvedStance& stance) {
    VectorXd x = VectorXd::Zero(layout.nx());
    x.segment<3>(layout.com()) = stance.com_W / units.length;
    for (int a = 0; a < layout.axis_count(); ++a)
      if (layout.axes()[a] == 2) x[layout.angle(a)] = stance.yaw;
    for (int l = 0; l < layout.ends(); ++l)
      x.segment<3>(layout.end(l)) = stance.end_effectors_W[active[l]] / units.length;
    return x;
  };
  steps = options.phases > 0 ? options.phases : automatic_steps(from, to);
  start = state_of(from);
  for (int e : active) {
    start_contacts.push_back(from.contacts[e]);
    goal_contacts.push_back(to.contacts[e]);
  }
  make_reference(state_of(to));
  make_slack();
}

/// As many steps as the end-effectors that stand need to cover the way, level and up, one after the other, a swing and
/// a phase of full support each; at least the paper's 18. The stride is what the reach box allows, in the paper's model
/// inside the friction cone, since forces point at the CoM there.
int Problem::automatic_steps(const ResolvedStance& from, const ResolvedStance& to) const {
  double strides = 0.0;
  for (std::size_t l = 0; l < active.size(); ++l) {
    const int e = active[l];
    if (from.contacts[e] == kFree || to.contacts[e] == kFree) continue;
    double tangent = 0.0;
    for (int surface : rules.surfaces(static_cast<int>(l))) tangent = std::max(tangent, friction[surface]);
    const EndLimits& limit = limits[l];
    const double spread = std::min(tangent, kStrideFrictionMax) * std::abs(limit.nominal.z());
    const double ahead = model == Model::wrench
                             ? std::numeric_limits<double>::infinity()
                             : std::sqrt(std::max(spread * spread - limit.nominal.y() * limit.nominal.y(), 0.0));
    const double stride = std::min(limit.reach_max.x(), ahead) - std::max(limit.reach_min.x(), -ahead);
    const Vector3d way = (to.end_effectors_W[e] - from.end_effectors_W[e]) / units.length;
    const double level = stride > 0.0 ? way.head<2>().norm() / stride : 0.0;
    const double up = std::abs(way.z()) / (limit.reach_max.z() - limit.reach_min.z());
    strides += std::ceil(std::min(std::max(level, up) - 1e-9, 1e3));
  }
  return std::clamp(2 * static_cast<int>(strides) + 2, kPaperPhases, kPhasesMax);
}

/// Cubic from start to goal, at rest at both ends (Tazaki, sec. III-A), tied to the step index. End-effectors keep
/// their place relative to the base where that turns.
void Problem::make_reference(const VectorXd& goal) {
  const double total = steps * duration_initial;
  const double yaw_from = rpy(start).z(), yaw_to = rpy(goal).z();
  const auto level = [](double yaw) { return rotation_from_rpy({0.0, 0.0, yaw}); };
  const VectorXd way = goal - start;
  reference.x.clear();
  for (int k = 0; k <= steps; ++k) {
    const double s = static_cast<double>(k) / steps, blend = s * s * (3.0 - 2.0 * s);
    VectorXd x = start + blend * way;
    const double rate = 6.0 * s * (1.0 - s) / total;
    x.segment<3>(layout.velocity()) = rate * way.segment<3>(layout.com());
    for (int a = 0; a < layout.axis_count(); ++a)
      x[layout.momentum(a)] = inertia[layout.axes()[a]] * rate * way[layout.angle(a)];
    if (yaw_from != yaw_to)
      for (int l = 0; l < layout.ends(); ++l) {
        const auto offset = [&](const VectorXd& at, double yaw) -> Vector3d {
          return level(yaw).transpose() * (at.segment<3>(layout.end(l)) - at.segment<3>(layout.com()));
        };
        const Vector3d from = offset(start, yaw_from), to = offset(goal, yaw_to);
        x.segment<3>(layout.end(l)) =
            x.segment<3>(layout.com()) + level(yaw_from + blend * (yaw_to - yaw_from)) * (from + blend * (to - from));
      }
    reference.x.push_back(x);
  }
}

Eigen::Matrix3d Problem::sole_frame(int surface, double yaw) const {
  return mcplan::sole_frame(polygons[surface].normal_W(), yaw);
}

void Problem::set_sole_yaw(const ContactSequence& sequence, Trajectory& t) const {
  t.sole_yaw.assign(steps + 1, std::vector<double>(layout.ends()));
  for (int l = 0; l < layout.ends(); ++l)
    for (int k = 0; k <= steps; ++k) {
      t.sole_yaw[k][l] = rpy(t.x[k]).z();
      if (sequence[k][l] == kFree) continue;
      // Phases first..k are one contact, which holds the knots first..last_knot.
      const int first = k;
      while (k < steps && sequence[k + 1][l] == sequence[first][l]) ++k;
      const int last_knot = std::min(k + 1, steps);
      double yaw = 0.0;
      for (int j = first; j <= last_knot; ++j) yaw += rpy(t.x[j]).z() / (last_knot - first + 1);
      if (k == steps) yaw = goal_yaw;
      if (first == 0) yaw = start_yaw[l];
      for (int j = first; j <= k; ++j) t.sole_yaw[j][l] = yaw;
    }
}

Vector3d Problem::rpy(const VectorXd& x) const {
  Vector3d out = base_rpy;
  for (int a = 0; a < layout.axis_count(); ++a) out[layout.axes()[a]] = x[layout.angle(a)];
  return out;
}

/// Footholds where the reference is in the middle of each contact, straight lines between them.
void Problem::place_footholds(const ContactSequence& sequence, Trajectory& guess) const {
  for (int l = 0; l < layout.ends(); ++l) {
    int known = 0;  // the last knot whose position stands
    for (int k = 0; k <= steps; ++k) {
      if (sequence[k][l] == kFree) continue;
      const int first = k;
      while (k < steps && sequence[k + 1][l] == sequence[k][l]) ++k;
      const int last = std::min(k + 1, steps);
      const int middle = last == steps ? steps : (first + last) / 2;
      Vector3d foothold = guess.x[first].segment<3>(layout.end(l));
      if (first > 0) foothold = polygons[sequence[k][l]].nearest(reference.x[middle].segment<3>(layout.end(l)));
      const Vector3d before = guess.x[known].segment<3>(layout.end(l));
      for (int j = known + 1; j < first; ++j)
        guess.x[j].segment<3>(layout.end(l)) = before + (foothold - before) * (j - known) / (first - known);
      for (int j = first; j <= last; ++j) guess.x[j].segment<3>(layout.end(l)) = foothold;
      known = last;
    }
  }
}

Trajectory Problem::initial_guess(const ContactSequence& sequence) const {
  Trajectory guess = reference;
  if (!sequence.empty()) place_footholds(sequence, guess);
  for (int k = 0; k < steps; ++k) {
    VectorXd u = VectorXd::Zero(layout.nu());
    int standing = 0;
    if (!sequence.empty())
      for (int contact : sequence[k]) standing += contact != kFree;
    for (int l = 0; l < layout.ends(); ++l) {
      u.segment<3>(layout.stride(l)) = guess.x[k + 1].segment<3>(layout.end(l)) - guess.x[k].segment<3>(layout.end(l));
      double mu = 1.0 / layout.ends();
      if (!sequence.empty()) mu = sequence[k][l] == kFree ? 0.0 : 1.0 / standing;
      u[layout.stiffness(l)] = options.stiffness_input == StiffnessInput::lambda ? std::sqrt(mu) : mu;
    }
    u[layout.duration()] = k == 0 && first_duration > 0.0 ? first_duration : duration_initial;
    guess.u.push_back(u);
  }
  // Without a sequence every sole goes with the base.
  set_sole_yaw(sequence.empty() ? ContactSequence(steps + 1, ContactState(layout.ends(), kFree)) : sequence, guess);
  return guess;
}

ContactSequence Problem::to_active(const ContactSequence& sequence) const {
  const std::string field = "initial_sequence";
  if (static_cast<int>(sequence.size()) != steps + 1)
    throw InvalidOptions(field, "must have phases + 1 rows (" + text(steps + 1) + ")",
                         text(static_cast<int>(sequence.size())));
  ContactSequence out;
  for (std::size_t k = 0; k < sequence.size(); ++k) {
    if (sequence[k].size() != robot.end_effectors.size())
      throw InvalidOptions(
          field + "[" + std::to_string(k) + "]",
          "must be one surface per end-effector (" + text(static_cast<int>(robot.end_effectors.size())) + ")",
          text(static_cast<int>(sequence[k].size())));
    out.emplace_back();
    for (int e : active) out.back().push_back(sequence[k][e]);
    for (std::size_t e = 0; e < sequence[k].size(); ++e)
      if (sequence[k][e] != kFree && std::find(active.begin(), active.end(), static_cast<int>(e)) == active.end())
        throw InvalidOptions(field + "[" + std::to_string(k) + "][" + std::to_string(e) + "]",
                             "must be -1: " + robot.end_effectors[e].name + " may touch nothing here",
                             text(sequence[k][e]));
  }
  if (out.front() != start_contacts || out.back() != goal_contacts)
    throw InvalidOptions(field, "must go from the start's contacts to the goal's", "others");
  if (!rules.valid(out))
    throw InvalidOptions(field, "must keep permissions, rules and at most one switch a step",
                         "a sequence that does not");
  return out;
}

void Problem::look_near(int count) {
  std::size_t most = 0;
  for (int l = 0; l < layout.ends(); ++l) most = std::max(most, rules.surfaces(l).size());
  rules.look_near({});
  if (count <= 0 || most <= static_cast<std::size_t>(count)) return;
  std::vector<std::vector<std::vector<int>>> near(steps + 1);
  std::vector<std::pair<double, int>> distances;
  for (int k = 0; k <= steps; ++k)
    for (int l = 0; l < layout.ends(); ++l) {
      const Vector3d due = reference.x[k].segment<3>(layout.end(l));
      distances.clear();
      for (int surface : rules.surfaces(l))
        distances.emplace_back((polygons[surface].nearest(due) - due).squaredNorm(), surface);
      const std::size_t kept = std::min(distances.size(), static_cast<std::size_t>(count));
      std::partial_sort(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(kept), distances.end());
      std::vector<int>& list = near[k].emplace_back();
      for (std::size_t i = 0; i < kept; ++i) list.push_back(distances[i].second);
      std::sort(list.begin(), list.end());
    }
  rules.look_near(std::move(near));
}

void Problem::set_start(const Knot& measured, const ContactState& contacts) {
  const VectorXd goal = reference.x.back();
  start.setZero();
  start.segment<3>(layout.com()) = measured.com_W / units.length;
  start.segment<3>(layout.velocity()) = measured.com_velocity_W / units.velocity();
  base_rpy = measured.base_rpy;
  // What the base's rates make of it where the momentum was not measured.
  Vector3d momentum = measured.angular_momentum_W;
  if (model == Model::lipm || momentum.isZero(0.0)) momentum = robot.inertia.cwiseProduct(measured.base_rpy_rate);
  for (int a = 0; a < layout.axis_count(); ++a) {
    start[layout.angle(a)] = measured.base_rpy[layout.axes()[a]];
    start[layout.momentum(a)] = momentum[layout.axes()[a]] / units.angular_momentum();
  }
  for (int l = 0; l < layout.ends(); ++l)
    start_yaw[l] = static_cast<int>(measured.end_effector_yaw.size()) > active[l] ? measured.end_effector_yaw[active[l]]
                                                                                  : measured.base_rpy.z();
  for (int l = 0; l < layout.ends(); ++l)
    start.segment<3>(layout.end(l)) = measured.end_effectors_W[active[l]] / units.length;
  start_contacts = contacts;
  const VectorXd measured_start = start;
  start.segment<3>(layout.velocity()).setZero();
  start.segment(layout.momentum(), layout.axis_count()).setZero();
  make_reference(goal);
  start = measured_start;
  reference.x.front() = start;
  make_slack();
}

}  // namespace mcplan::ddp
