#include "ddp/problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/base_rotation.hpp"
#include "ddp/constants.hpp"
#include "ddp/problem_layout.hpp"
#include "ddp/virtual_leg.hpp"
#include "mcplan/base/error.hpp"
#include "plan/clearance.hpp"
#include "surface_boxes.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// Where a hand that may touch nothing is held where there is no room for its nominal place: arms of robots with a body
/// fold in beside it as far as their box reaches.
Vector3d folded_in(const Robot& robot, const EndEffector& hand) {
  Vector3d place = hand.nominal_B;
  if (!robot.trunk.empty())
    place.y() = place.y() < 0.0 ? std::min(hand.reach_max_B.y(), 0.0) : std::max(hand.reach_min_B.y(), 0.0);
  return place;
}

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

/// Whether the plan's robot balances on this end-effector alone, with nothing below it that a controller could shift
/// its force on. The paper's model and method know forces that point at the CoM alone.
bool is_balancing_point(const Robot& robot, const EndEffector& end, Model model) {
  return robot.tracked && model == Model::wrench && end.kind == "foot" && end.half_size.maxCoeff() <= 0.0;
}

}  // namespace

Robot robot_for(Robot robot, const Options& options) {
  if (!options.joint_limits || options.method == Method::paper)
    for (EndEffector& end : robot.end_effectors) end.limb = {};
  return robot;
}

Problem::Problem(const Scene& scene_in, const Robot& robot_in, const Options& options_in, const Course& course_in)
    : scene(scene_in), robot(robot_in), options(options_in), course(course_in) {
  robot = robot_for(robot, options);
  scene.validate();
  robot.validate();
  options.validate();
  model = options.effective_model();
  units.length = robot.com_height;
  units.time = std::sqrt(robot.com_height / scene.gravity);
  units.mass = robot.mass;
  similarity = similarity_of(robot, scene.gravity);
  swing_height = swing_height_of(robot, similarity) / units.length;
  inertia = robot.inertia / (units.mass * units.length * units.length);
  edge_margin = pressure_margin = kEdgeMargin_m * similarity.length / units.length;
  make_durations();
  make_surfaces();
  const std::vector<std::vector<int>> surfaces = make_ends();
  layout = model == Model::lipm ? lipm_layout(limits, options.method == Method::paper)
                                : wrench_layout(limits, polygons, surfaces);
  rules = ContactRules(surfaces, make_state_rules(), options.one_switch_per_step,
                       std::max(options.min_contacts, options.allow_flight ? 0 : 1));

  const ResolvedStance from = resolve_stance(scene, robot, scene.start, "start");
  const ResolvedStance to = resolve_stance(scene, robot, scene.goal, "goal");
  base_rpy = from.base_rpy;
  start_yaw.assign(layout.end_effector_count(), from.yaw);
  goal_yaw = to.yaw;
  make_foothold_margins(from.com_W, to.com_W);
  steps = options.phases > 0 ? options.phases : automatic_steps(from, to);
  start = state_of(from);
  for (int e : active) {
    start_contacts.push_back(from.contacts[e]);
    goal_contacts.push_back(to.contacts[e]);
  }
  for (const ContactState* state : {&start_contacts, &goal_contacts}) {
    const auto standing = std::count_if(state->begin(), state->end(), [](int contact) { return contact != kFree; });
    if (standing < options.min_contacts)
      throw InvalidOptions(
          "min_contacts",
          "must be at most the number of contacts at start and goal, " + text(static_cast<int>(standing)),
          text(options.min_contacts));
  }
  make_reference(state_of(to));
  make_slack();
}

void Problem::make_durations() {
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
  const bool chosen = options.flight_duration_min_s != Options().flight_duration_min_s;
  if (chosen && flight_s > longest_s)
    throw InvalidOptions("flight_duration_min_s", "must be at most the longest phase, " + text(longest_s),
                         text(flight_s));
  flight_duration_min = std::min(flight_s, longest_s) / units.time;
  const double middle_s = model == Model::wrench ? 0.5 * (shortest_s + longest_s) : kLipmDuration_s * similarity.time;
  duration_initial = (options.duration_initial_s > 0.0 ? options.duration_initial_s : middle_s) / units.time;
}

/// The ratio of friction that contacts may use.
double Problem::friction_ratio() const {
  if (options.friction_ratio >= 0.0) return options.friction_ratio;
  const auto balancing = [&](const EndEffector& end) { return is_balancing_point(robot, end, model); };
  return std::any_of(robot.end_effectors.begin(), robot.end_effectors.end(), balancing) ? kTrackedFrictionRatio : 1.0;
}

void Problem::make_surfaces() {
  const double ratio = friction_ratio();
  for (const Surface& surface : scene.surfaces) {
    std::vector<Vector3d> scaled;
    for (const Vector3d& v : surface.vertices_W) scaled.push_back(v / units.length);
    polygons.emplace_back(scaled);
    thickness.push_back(surface.thickness / units.length);
    keep_out_depth.push_back(kKeepOutDepth * surface.thickness / units.length);
    friction.push_back(surface.grasp ? std::numeric_limits<double>::infinity()
                                     : std::max(std::min(surface.friction - kFrictionMargin, ratio * surface.friction),
                                                kFrictionRatioMin * surface.friction));
    pyramid.push_back(pyramid_tangents(polygons.back().normal_W(), options.friction_sides));
  }
  if (options.friction_sides > 0) pyramid_ratio = std::cos(M_PI / options.friction_sides);
}

/// The active end-effectors with their limits; the surfaces that each of them may touch.
std::vector<std::vector<int>> Problem::make_ends() {
  std::vector<std::vector<int>> surfaces;
  for (std::size_t e = 0; e < robot.end_effectors.size(); ++e) {
    std::vector<int> list;
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i)
      if (may_touch(scene.surfaces[i], robot.end_effectors[e])) list.push_back(static_cast<int>(i));
    if (list.empty() && options.method != Method::paper) {
      const EndEffector& end = robot.end_effectors[e];
      if (end.kind != "foot") idle_hands.push_back(folded_in(robot, end) / units.length);
      continue;
    }
    active.push_back(static_cast<int>(e));
    surfaces.push_back(list);
    limits.push_back(limits_of(robot.end_effectors[e]));
    if (!limits.back().limb.given()) continue;
    jointed.ends.push_back(static_cast<int>(limits.size()) - 1);
    jointed.nominal_sum += limits.back().nominal;
  }
  const auto feet = std::count_if(limits.begin(), limits.end(), [](const EndLimits& l) { return l.balances; });
  const double load_ratio = options.load_ratio >= 0.0 ? options.load_ratio : kLoadRatio;
  if (feet > 0) load_min = load_ratio / static_cast<double>(feet);
  return surfaces;
}

double Problem::reach_margin_m() const {
  return options.method == Method::paper ? 0.0
                                         : by_size(options.reach_margin_m, Options().reach_margin_m, similarity.length);
}

void Problem::set_box(EndLimits& l, const Eigen::AlignedBox3d& box) const {
  // A box thinner than the margins keeps its middle.
  const Vector3d middle = box.center(), margin = Vector3d::Constant(reach_margin_m());
  l.reach_min = (box.min() + margin).cwiseMin(middle) / units.length;
  l.reach_max = (box.max() - margin).cwiseMax(middle) / units.length;
}

void Problem::reach_far() {
  for (std::size_t l = 0; l < limits.size(); ++l) {
    const EndEffector& end = robot.end_effectors[active[l]];
    set_box(limits[l], {end.reach_min_B, end.reach_max_B});
  }
}

EndLimits Problem::limits_of(const EndEffector& end) const {
  const Vector3d margin = Vector3d::Constant(reach_margin_m());
  EndLimits l;
  l.nominal = end.nominal_B / units.length;
  set_box(l, end.usual_box());
  l.usual_stride = l.reach_max.x() - l.reach_min.x();
  l.cuts = static_cast<int>(end.reach_cut.A.rows());
  for (int i = 0; i < l.cuts; ++i) {
    l.cut_A.row(i) = end.reach_cut.A.row(i);
    // A nominal place that is closer to the face than the margin keeps the margin that it has.
    const double spare = end.reach_cut.b[i] - end.reach_cut.A.row(i).dot(end.nominal_B);
    l.cut_b[i] = (end.reach_cut.b[i] - std::clamp(spare, 0.0, margin.x())) / units.length;
  }
  l.force_max = std::min(end.max_force / units.force(), kForceCapMax);
  l.half_size = end.half_size / units.length;
  l.half_width = l.half_size.minCoeff();
  l.pressure_half = robot.pressure_ratio * l.half_size;
  l.moment_max = end.max_moment / units.moment();
  l.limb = end.limb;
  for (Vector3d* length : {&l.limb.hip_B, &l.limb.ankle}) *length /= units.length;
  for (double* length : {&l.limb.upper, &l.limb.lower, &l.limb.margin, &l.limb.radius, &l.limb.beside})
    *length /= units.length;
  if (l.limb.given()) {
    const double longest = VirtualLeg::max_length({l.limb.upper, l.limb.lower}) - l.limb.margin;
    l.leg_max = longest;
    l.shorten_leg(margin.x() / units.length);
  }
  l.limb.knee_torque /= units.moment();
  l.limb.hip_torque /= units.moment();
  l.limb.ankle_torque /= units.moment();
  l.limb.knee_speed *= units.time;
  // The paper's model knows no headings of soles.
  const bool turns = model == Model::wrench;
  l.yaw_min = turns ? end.yaw_range[0] : -std::numeric_limits<double>::infinity();
  l.yaw_max = turns ? end.yaw_range[1] : std::numeric_limits<double>::infinity();
  l.balances = is_balancing_point(robot, end, model);
  return l;
}

/// The scene's rules by active end-effector. They are judged on the whole robot: a rule about what it does not have is
/// void, and what a required name does not find, or finds among those that may touch nothing, can never be in contact.
std::vector<StateRule> Problem::make_state_rules() const {
  std::vector<StateRule> out;
  for (const ContactRule& rule : scene.rules) {
    const auto known = [&](const std::string& who) {
      return std::any_of(robot.end_effectors.begin(), robot.end_effectors.end(),
                         [&](const EndEffector& e) { return addresses(who, e); });
    };
    if (std::none_of(rule.when_free.begin(), rule.when_free.end(), known)) continue;
    bool possible = std::all_of(rule.require.begin(), rule.require.end(), known);
    for (int e = 0; e < static_cast<int>(robot.end_effectors.size()); ++e)
      for (const std::string& who : rule.require)
        if (addresses(who, robot.end_effectors[e]) && std::find(active.begin(), active.end(), e) == active.end())
          possible = false;
    StateRule state_rule{addressed(rule.when_free, robot, active), addressed(rule.require, robot, active)};
    // Unless one of `when_free` stands: the only way to keep a rule whose demand cannot be met.
    if (!possible) state_rule.require = state_rule.when_free;
    out.push_back(state_rule);
  }
  return out;
}

/// The state of standing there.
VectorXd Problem::state_of(const ResolvedStance& stance) const {
  VectorXd x = VectorXd::Zero(layout.nx());
  x.segment<3>(layout.com()) = stance.com_W / units.length;
  for (int a = 0; a < layout.axis_count(); ++a) x[layout.angle(a)] = stance.base_rpy[layout.axes()[a]];
  for (int l = 0; l < layout.end_effector_count(); ++l)
    x.segment<3>(layout.end(l)) = stance.end_effectors_W[active[l]] / units.length;
  return x;
}

Eigen::Matrix3d Problem::sole_frame(int surface, double yaw) const {
  return mcplan::sole_frame(polygons[surface].normal_W(), yaw);
}

Vector3d Problem::rpy(const VectorXd& x) const {
  Vector3d out = base_rpy;
  for (int a = 0; a < layout.axis_count(); ++a) out[layout.axes()[a]] = x[layout.angle(a)];
  return out;
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

void Problem::look_near(int count, double within) {
  std::size_t max_surfaces = 0;
  for (int l = 0; l < layout.end_effector_count(); ++l) max_surfaces = std::max(max_surfaces, rules.surfaces(l).size());
  rules.look_near({});
  const std::size_t few = within > 0.0 ? kFewSurfaces : std::max(count, 0);
  if (count <= 0 || max_surfaces <= few) return;
  const SurfaceBoxes boxes(polygons);
  std::vector<std::vector<std::vector<int>>> near(steps + 1);
  std::vector<std::pair<double, int>> distances;  // a heap of the nearest
  for (int k = 0; k <= steps; ++k)
    for (int l = 0; l < layout.end_effector_count(); ++l) {
      const Vector3d due = reference.x[k].segment<3>(layout.end(l));
      const double most = within > 0.0 ? within * (limits[l].reach_max - limits[l].reach_min).norm()
                                       : std::numeric_limits<double>::infinity();
      distances.clear();
      for (int surface : rules.surfaces(l)) {
        const bool full = distances.size() == static_cast<std::size_t>(count);
        if (full && boxes.min_squared_distance(surface, due) > distances.front().first) continue;
        const std::pair<double, int> here((polygons[surface].nearest(due) - due).squaredNorm(), surface);
        if (here.first > most * most || (full && !(here < distances.front()))) continue;
        if (full) std::pop_heap(distances.begin(), distances.end());
        if (full) distances.pop_back();
        distances.push_back(here);
        std::push_heap(distances.begin(), distances.end());
      }
      std::vector<int>& list = near[k].emplace_back();
      for (const auto& [distance, surface] : distances) list.push_back(surface);
      std::sort(list.begin(), list.end());
    }
  rules.look_near(std::move(near));
}

VectorXd Problem::state_of(const Knot& knot) const {
  VectorXd x = VectorXd::Zero(layout.nx());
  x.segment<3>(layout.com()) = knot.com_W / units.length;
  x.segment<3>(layout.velocity()) = knot.com_velocity_W / units.velocity();
  // What the base's rates make of it where the momentum was not measured; in `lipm` angles are small.
  Vector3d momentum = knot.angular_momentum_W;
  if (model == Model::lipm)
    momentum = robot.inertia.cwiseProduct(knot.base_rpy_rate);
  else if (momentum.isZero(0.0))
    momentum = base_momentum_W(knot.base_rpy, knot.base_rpy_rate, robot.inertia);
  for (int a = 0; a < layout.axis_count(); ++a) {
    x[layout.angle(a)] = knot.base_rpy[layout.axes()[a]];
    x[layout.momentum(a)] = momentum[layout.axes()[a]] / units.angular_momentum();
  }
  for (int l = 0; l < layout.end_effector_count(); ++l)
    x.segment<3>(layout.end(l)) = knot.end_effectors_W[active[l]] / units.length;
  return x;
}

void Problem::set_end(const Knot& state, const ContactState& contacts) {
  reference.x.back() = state_of(state);
  goal_contacts = contacts;
  end_yaw.clear();
  for (int e : active)
    end_yaw.push_back(static_cast<int>(state.end_effector_yaw.size()) > e ? state.end_effector_yaw[e]
                                                                          : state.base_rpy.z());
  pinned_end = true;
}

void Problem::set_start(const Knot& state, const ContactState& contacts) {
  const VectorXd goal = reference.x.back();
  start = state_of(state);
  base_rpy = state.base_rpy;
  for (int l = 0; l < layout.end_effector_count(); ++l)
    start_yaw[l] = static_cast<int>(state.end_effector_yaw.size()) > active[l] ? state.end_effector_yaw[active[l]]
                                                                               : state.base_rpy.z();
  start_contacts = contacts;
  measured = true;
  start_end_velocities_W = state.end_effector_velocities_W;
  for (EndLimits& l : limits)
    if (robot.tracked && l.limb.given()) l.shorten_leg(kLegMargin_m * similarity.length / units.length);
  const VectorXd measured_start = start;
  start.segment<3>(layout.velocity()).setZero();
  start.segment(layout.momentum(), layout.axis_count()).setZero();
  make_reference(goal);
  start = measured_start;
  reference.x.front() = start;
  if (pinned_end) reference.x.back() = goal;
  make_slack();
}

}  // namespace mcplan::ddp
