#include "planar/sip/interval_motion.hpp"

#include <cmath>

#include "mcplan/planar/plan.hpp"

namespace mcplan::sip {
namespace {

using Terms = std::vector<TaylorGraph::Term>;

void append(Terms& to, const Terms& terms, double factor) {
  for (const TaylorGraph::Term& term : terms) to.push_back({factor * term.factor, term.node});
}

/// a.x b.y - a.y b.x
TaylorGraph::Node cross(TaylorGraph& graph, const IntervalMotion::Point& a, const IntervalMotion::Point& b, int order) {
  return graph.linear({{1.0, graph.product(a.x, b.y, order)}, {-1.0, graph.product(a.y, b.x, order)}});
}

Eigen::Vector2d direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace

IntervalMotion::IntervalMotion(const PlanarTask& of, const Options& with, const Layout& layout, int interval)
    : task(of), options(with), local(of, layout, interval), graph(local.count()) {
  origin_W = moment_point_W(task, local.phase);
  add_inputs(layout);
  add_angles();
  add_base();
  add_contact_errors();
  if (options.dynamics) add_dynamics();
}

void IntervalMotion::add_inputs(const Layout& layout) {
  const bool fixed_basis = layout.durations == 1;  // knots stay equally spaced: only h depends on the duration
  for (int j = 0; j < layout.splines; ++j) {
    std::vector<int> columns;
    for (std::size_t c = 0; c < local.controls.size(); ++c)
      columns.push_back(local.control_column(j, static_cast<int>(c)));
    if (!fixed_basis)
      for (std::size_t d = 0; d < local.durations.size(); ++d)
        columns.push_back(local.duration_column(static_cast<int>(d)));
    const int count = static_cast<int>(columns.size());
    splines_.push_back(graph.input(3, std::move(columns)));
    if (!fixed_basis) graph.input_of(splines_.back()).curvature.assign(4, Eigen::MatrixXd::Zero(count, count));
  }
  const double ratio = local.knot_ratio[2];
  const int own = local.duration_column(local.own_duration);
  const auto power = [&](double factor, int exponent) {
    const Node node = graph.input(0, {own});
    graph.input_of(node).curvature.assign(1, Eigen::MatrixXd::Zero(1, 1));
    powers_.push_back({node, factor, exponent});
  };
  power(0.5 * ratio, 1);
  for (int k = 1; k <= 3; ++k) power(std::pow(2.0 / ratio, k), -k);
  half_length = powers_[0].node;

  const int joint_count = task.robot.joint_count();
  joints.assign(splines_.begin(), splines_.begin() + joint_count);
}

IntervalMotion::Node IntervalMotion::timed(Node node, int power) {
  return graph.product(powers_[power].node, node, TaylorGraph::kMaxOrder);
}

IntervalMotion::Point IntervalMotion::point(int body, const Eigen::Vector2d& p) {
  const Body& b = bodies[body];
  return {graph.linear({{1.0, b.joint.x}, {p.x(), b.cosine}, {-p.y(), b.sine}}),
          graph.linear({{1.0, b.joint.y}, {p.x(), b.sine}, {p.y(), b.cosine}})};
}

/// Angles of all bodies in the world with their sines and cosines; that of the base by eq. 11 or from its own spline.
void IntervalMotion::add_angles() {
  const PlanarRobot& robot = task.robot;
  const PlanarPhase& phase = task.phases[local.phase];
  const int count = static_cast<int>(robot.bodies.size());
  const double ratio = 1.0 / static_cast<double>(phase.contacts.size());

  // Angles relative to the base, as sums of joints.
  std::vector<Terms> relative(count);
  std::vector<double> offset(count, 0.0);
  for (int b = 1; b < count; ++b) {
    relative[b] = relative[robot.bodies[b].parent];
    relative[b].push_back({1.0, joints[b - 1]});
    offset[b] = offset[robot.bodies[b].parent] + robot.bodies[b].offset;
  }
  // theta_w = mean_i (theta_i^e - theta_i^q), eq. 11
  Terms base_angle;
  double base_offset = 0.0;
  if (base_computed()) {
    for (const PlanarContact& contact : phase.contacts) {
      const PlanarEndEffector& foot = robot.end_effectors[contact.end_effector];
      append(base_angle, relative[foot.body], -ratio);
      base_offset += ratio * (contact.angle - offset[foot.body] - foot.angle_B);
    }
  } else {
    base_angle = {{1.0, splines_[robot.joint_count() + 2]}};
  }
  bodies.resize(count);
  const int order = options.order + 2;  // two are lost to accelerations
  for (int b = 0; b < count; ++b) {
    Terms angle = base_angle;
    append(angle, relative[b], 1.0);
    // A joint between the body and every contact appears with factors that cancel.
    std::vector<double> factor(splines_.size(), 0.0);
    for (const auto& term : angle)
      for (std::size_t j = 0; j < splines_.size(); ++j)
        if (splines_[j] == term.node) factor[j] += term.factor;
    Terms merged;
    for (std::size_t j = 0; j < splines_.size(); ++j)
      if (std::abs(factor[j]) > 1e-12) merged.push_back({factor[j], splines_[j]});
    bodies[b].angle = graph.linear(merged, base_offset + offset[b], 3);
    std::tie(bodies[b].sine, bodies[b].cosine) = graph.sin_cos(bodies[b].angle, order);
  }
}

/// Where the base is, by eq. 12 or from its own splines, and with it joints and CoMs of all bodies.
void IntervalMotion::add_base() {
  const PlanarRobot& robot = task.robot;
  const PlanarPhase& phase = task.phases[local.phase];
  const int count = static_cast<int>(robot.bodies.size());
  const double ratio = 1.0 / static_cast<double>(phase.contacts.size());

  // Joints relative to the base's origin: constant combinations of sines and cosines.
  struct Place {
    Terms x, y;
  };
  const auto moved = [&](const Place& from, int body, const Eigen::Vector2d& p) {
    Place out = from;
    append(out.x, {{p.x(), bodies[body].cosine}, {-p.y(), bodies[body].sine}}, 1.0);
    append(out.y, {{p.x(), bodies[body].sine}, {p.y(), bodies[body].cosine}}, 1.0);
    return out;
  };
  std::vector<Place> joint(count);
  for (int b = 1; b < count; ++b)
    joint[b] = moved(joint[robot.bodies[b].parent], robot.bodies[b].parent, robot.bodies[b].joint_P);
  // P_w = mean_i (P_i^e - A_w P_i^q), eq. 12
  Terms base_x, base_y;
  Eigen::Vector2d base_constant = Eigen::Vector2d::Zero();
  if (base_computed()) {
    for (const PlanarContact& contact : phase.contacts) {
      const PlanarEndEffector& foot = robot.end_effectors[contact.end_effector];
      const Place place = moved(joint[foot.body], foot.body, foot.position_B);
      append(base_x, place.x, -ratio);
      append(base_y, place.y, -ratio);
      // One rounding, whatever the compiler makes of this function: the last bits of plans depend on it.
      for (int i = 0; i < 2; ++i)
        base_constant[i] = std::fma(ratio, contact.position_W[i] - origin_W[i], base_constant[i]);
    }
  } else {
    base_x = {{1.0, splines_[robot.joint_count()]}};
    base_y = {{1.0, splines_[robot.joint_count() + 1]}};
    base_constant = -origin_W;
  }
  bodies[0].joint = {graph.linear(base_x, base_constant.x()), graph.linear(base_y, base_constant.y())};
  for (int b = 1; b < count; ++b) {
    const int parent = robot.bodies[b].parent;
    bodies[b].joint = point(parent, robot.bodies[b].joint_P);
  }
  for (int b = 0; b < count; ++b) bodies[b].com = point(b, robot.bodies[b].com_B);
}

void IntervalMotion::add_contact_errors() {
  const PlanarPhase& phase = task.phases[local.phase];
  for (const PlanarContact& expected : phase.contacts) {
    const PlanarEndEffector& foot = task.robot.end_effectors[expected.end_effector];
    const Point actual = point(foot.body, foot.position_B);
    Contact contact;
    const Eigen::Vector2d place = expected.position_W - origin_W;
    contact.error = {graph.linear({{1.0, actual.x}}, -place.x()), graph.linear({{1.0, actual.y}}, -place.y())};
    contact.angle_error = graph.linear({{1.0, bodies[foot.body].angle}}, foot.angle_B - expected.angle);
    contact.free = !base_computed() || phase.contacts.size() > 1;
    contacts.push_back(contact);
  }
}

void IntervalMotion::add_forces(const std::array<Node, 3>& demand) {
  const PlanarPhase& phase = task.phases[local.phase];
  std::vector<ContactGain::Point> points;
  for (std::size_t i = 0; i < phase.contacts.size(); ++i) {
    const PlanarContact& contact = phase.contacts[i];
    const Eigen::Vector2d tangent = direction(contact.angle);
    for (double along : task.robot.end_effectors[contact.end_effector].points) {
      ContactGain::Point point;
      point.place = contact.position_W + along * tangent - origin_W;
      point.tangent = tangent;
      const int first = options.forces == Forces::per_body ? static_cast<int>(i) : static_cast<int>(points.size());
      point.parameter = options.forces == Forces::per_body || options.forces == Forces::per_point ? first - 1 : -1;
      contacts[i].forces.push_back(static_cast<int>(points.size()));
      forces.push_back({static_cast<int>(i), -1, -1});
      points.push_back(point);
    }
  }
  if (options.forces == Forces::parameters) {
    std::array<Terms, 3> left{Terms{{1.0, demand[0]}}, Terms{{1.0, demand[1]}}, Terms{{1.0, demand[2]}}};
    for (std::size_t v = 0; v < points.size(); ++v) {
      const Eigen::Vector2d &t = points[v].tangent, &x = points[v].place;
      for (int component = 0; component < 2; ++component) {
        std::vector<int> columns;
        for (int m = 0; m < 4; ++m) columns.push_back(local.force_column(8 * static_cast<int>(v) + 4 * component + m));
        const Node node = graph.input(3, std::move(columns));
        graph.input_of(node).tangents.setIdentity();
        force_inputs_.push_back(node);
        (component == 0 ? forces[v].tangential : forces[v].normal) = node;
        const Eigen::Vector2d d = component == 0 ? t : Eigen::Vector2d(-t.y(), t.x());
        left[0].push_back({-d.x(), node});
        left[1].push_back({-d.y(), node});
        left[2].push_back({-(x.x() * d.y() - x.y() * d.x()), node});
      }
    }
    for (int i = 0; i < 3; ++i) balance[i] = graph.linear(left[i]);
    return;
  }
  gain_.emplace(points, local.weights);
  const Eigen::MatrixXd& gain = gain_->value();
  std::vector<int> columns;
  for (int a = 0; a < local.weights; ++a) columns.push_back(local.weight_column(a));
  for (int row = 0; row < gain.rows(); ++row) {
    Node force = -1;
    if (columns.empty()) {
      force = graph.linear({{gain(row, 0), demand[0]}, {gain(row, 1), demand[1]}, {gain(row, 2), demand[2]}});
    } else {
      Terms sum;
      std::array<Node, 3> nodes{};
      for (int i = 0; i < 3; ++i) {
        nodes[i] = graph.input(0, columns);
        graph.input_of(nodes[i]).curvature.assign(1, Eigen::MatrixXd::Zero(local.weights, local.weights));
        sum.push_back({1.0, graph.product(nodes[i], demand[i], options.order)});
      }
      gain_nodes_.push_back(nodes);
      force = graph.linear(sum);
    }
    (row % 2 == 0 ? forces[row / 2].tangential : forces[row / 2].normal) = force;
  }
}

/// Inertial forces and moments about the origin of a body and all that hangs on it, and what contacts give to these.
struct IntervalMotion::Subtree {
  Terms force_x, force_y, moment;  ///< of s-derivatives, to be scaled by (2/h)^2
  Terms weight_moment;             ///< g sum m x
  double weight = 0.0;
  Terms contact_x, contact_y, contact_moment;
};

void IntervalMotion::add_dynamics() {
  std::vector<Subtree> tree = inertial_subtrees();
  for (int b = static_cast<int>(tree.size()) - 1; b > 0; --b) {
    Subtree& parent = tree[task.robot.bodies[b].parent];
    append(parent.force_x, {{1.0, graph.linear(tree[b].force_x)}}, 1.0);
    append(parent.force_y, {{1.0, graph.linear(tree[b].force_y)}}, 1.0);
    append(parent.moment, {{1.0, graph.linear(tree[b].moment)}}, 1.0);
    append(parent.weight_moment, {{1.0, graph.linear(tree[b].weight_moment, 0.0, options.order)}}, 1.0);
    parent.weight += tree[b].weight;
  }
  add_forces(demand_of(tree[0]));
  add_contact_wrenches(tree);
  add_torques(tree);
}

/// Of each body alone.
std::vector<IntervalMotion::Subtree> IntervalMotion::inertial_subtrees() {
  const PlanarRobot& robot = task.robot;
  const int count = static_cast<int>(robot.bodies.size());
  std::vector<Subtree> tree(count);
  for (int b = 0; b < count; ++b) {
    const PlanarBody& body = robot.bodies[b];
    const Body& nodes = bodies[b];
    const Point acceleration{graph.derivative(nodes.com.x, 2), graph.derivative(nodes.com.y, 2)};
    tree[b].force_x = {{body.mass, acceleration.x}};
    tree[b].force_y = {{body.mass, acceleration.y}};
    tree[b].moment = {{body.inertia, graph.derivative(nodes.angle, 2)},
                      {body.mass, cross(graph, nodes.com, acceleration, options.order)}};
    tree[b].weight = body.mass * robot.gravity;
    tree[b].weight_moment = {{body.mass * robot.gravity, nodes.com.x}};
  }
  return tree;
}

/// [m (a - g); moment about the origin] of a subtree, which contacts and the joint that carries it must give; the
/// gravity of m (a - g) points up.
std::array<IntervalMotion::Node, 3> IntervalMotion::demand_of(const Subtree& subtree) {
  const Node moment = timed(graph.linear(subtree.moment), 2);
  Terms all = subtree.weight_moment;
  all.push_back({1.0, moment});
  return {timed(graph.linear(subtree.force_x), 2),
          graph.linear({{1.0, timed(graph.linear(subtree.force_y), 2)}}, subtree.weight),
          graph.linear(all, 0.0, options.order)};
}

/// What the contacts take, at their actual points x_i + d_v tau: moment x_i x sum_v f_v + tau x sum_v d_v f_v.
void IntervalMotion::add_contact_wrenches(std::vector<Subtree>& tree) {
  const PlanarPhase& phase = task.phases[local.phase];
  const int order = options.order;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const PlanarContact& expected = phase.contacts[i];
    const PlanarEndEffector& foot = task.robot.end_effectors[expected.end_effector];
    const Eigen::Vector2d t = direction(expected.angle), n(-t.y(), t.x());
    Terms x, y, lever_x, lever_y;
    for (std::size_t v = 0; v < contacts[i].forces.size(); ++v) {
      const Force& force = forces[contacts[i].forces[v]];
      const double along = foot.points[v];
      append(x, {{t.x(), force.tangential}, {n.x(), force.normal}}, 1.0);
      append(y, {{t.y(), force.tangential}, {n.y(), force.normal}}, 1.0);
      append(lever_x, {{t.x(), force.tangential}, {n.x(), force.normal}}, along);
      append(lever_y, {{t.y(), force.tangential}, {n.y(), force.normal}}, along);
    }
    const Point total{graph.linear(x), graph.linear(y)}, lever{graph.linear(lever_x), graph.linear(lever_y)};
    const Point place = point(foot.body, foot.position_B);
    const Body& body = bodies[foot.body];
    const double c = std::cos(foot.angle_B), s = std::sin(foot.angle_B);
    const Point tau{graph.linear({{c, body.cosine}, {-s, body.sine}}),
                    graph.linear({{c, body.sine}, {s, body.cosine}})};
    Subtree& leaf = tree[foot.body];
    leaf.contact_x.push_back({1.0, total.x});
    leaf.contact_y.push_back({1.0, total.y});
    leaf.contact_moment.push_back({1.0, cross(graph, place, total, order)});
    leaf.contact_moment.push_back({1.0, cross(graph, tau, lever, order)});
  }
}

/// Of each joint, so that its subtree gets what it demands beyond its contacts.
void IntervalMotion::add_torques(std::vector<Subtree>& tree) {
  const int count = static_cast<int>(tree.size());
  torques.assign(count - 1, -1);
  for (int b = count - 1; b > 0; --b) {
    const Subtree& t = tree[b];
    const std::array<Node, 3> demand = demand_of(t);
    Terms x{{1.0, demand[0]}}, y{{1.0, demand[1]}}, moment{{1.0, demand[2]}};
    append(x, t.contact_x, -1.0);
    append(y, t.contact_y, -1.0);
    append(moment, t.contact_moment, -1.0);
    // about the joint: moment about the origin - joint x force
    const Point force{graph.linear(x), graph.linear(y)};
    moment.push_back({-1.0, cross(graph, bodies[b].joint, force, options.order)});
    torques[b - 1] = graph.linear(moment);
    Subtree& parent = tree[task.robot.bodies[b].parent];
    append(parent.contact_x, t.contact_x, 1.0);
    append(parent.contact_y, t.contact_y, 1.0);
    append(parent.contact_moment, t.contact_moment, 1.0);
  }
}

}  // namespace mcplan::sip
