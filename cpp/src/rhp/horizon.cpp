#include "rhp/horizon.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <string>

#include "rhp/pieces/contact_rows.hpp"
#include "rhp/pieces/costs.hpp"
#include "rhp/pieces/euler_step.hpp"
#include "rhp/pieces/linear_force_step.hpp"
#include "rhp/pieces/momentum_rate.hpp"
#include "rhp/pieces/momentum_within.hpp"
#include "rhp/pieces/reach_rows.hpp"
#include "rhp/pieces/torque_bound.hpp"

namespace mcplan::rhp {
namespace {

using Eigen::Vector3d;
using nlp::kInfinity;
using nlp::Stages;

// Faces of com_reach are left out where the guess stays this far inside them. Towards the end of the horizon, where the
// goal pulls the CoM ahead, a guess says less.
constexpr double kReachMargin_m = 0.1, kLastReachMargin_m = 0.5;
constexpr double kRestWeight = 100.0;  // of the goal at the end of the walk, over goal_weight: rest where it is
constexpr double kNearGoal_m = 0.5;    // from the last footholds as guessed: from farther off it is not reached
constexpr double kPaperLow[2] = {0.0, -1.0}, kPaperHigh[2] = {30.0, 1.0};  // CoM, world x and y [m]

/// How far the CoM is inside each face of a foot's reach [m].
Eigen::VectorXd reach_distance(const Polytope& reach_W, const Horizon& horizon, const Eigen::VectorXd& x, int node,
                               int placement) {
  const Vector3d com_W = horizon.shift_W + x.segment<3>(horizon.nodes[node].com);
  return reach_W.b - reach_W.A * (com_W - horizon.position_W(x, placement));
}

class Builder {
 public:
  Builder(const Walker& walker, const Footsteps& footsteps, const HorizonRequest& request)
      : walker_(walker),
        options_(walker.options),
        request_(request),
        euler_(options_.transcription == Transcription::euler) {
    const Vector3d& com = request.state.com_W;
    out_.steps = request.steps;
    out_.shift_W = Vector3d(com.x(), com.y(), 0.0);
    last_stage_ = 3 * request.steps * options_.intervals;
    add_placements(footsteps);
    add_phases(footsteps);
    add_nodes();
    for (Horizon::Phase& phase : out_.phases) add_controls(phase);
    for (const Horizon::Phase& phase : out_.phases) {
      add_dynamics(phase);
      add_running_cost(phase);
    }
    out_.guess = request.guess(out_);
    add_reach();
    add_end();
    out_.problem.finish();
  }

  Horizon take() { return std::move(out_); }

 private:
  nlp::Problem& problem() { return out_.problem; }

  void fix(int first, const Eigen::VectorXd& values) {
    for (int i = 0; i < values.size(); ++i) problem().set_bounds(first + i, values[i], values[i]);
  }

  Placement placement(int foot, int surface, const Vector3d& position_W, Stages stages) {
    Placement out;
    out.foot = foot;
    out.surface = surface;
    out.origin_W = position_W - out_.shift_W;
    out.axes_W = walker_.frame_W(surface);
    out.variable = problem().add_variables("foothold", 2, -kInfinity, kInfinity, stages);
    return out;
  }

  void add_placements(const Footsteps& footsteps) {
    const State& state = request_.state;
    const int per_step = 3 * options_.intervals;
    for (int foot = 0; foot < 2; ++foot) {
      out_.placements.push_back(placement(foot, state.surfaces[foot], state.feet_W[foot], {0, last_stage_}));
      fix(out_.placements.back().variable, Eigen::Vector2d::Zero());
    }
    for (int i = 0; i < out_.steps; ++i) {
      const Footstep step = footsteps[request_.first + i];
      // A foothold is in use from the touch-down on to the foot's next lift-off, at most to the end of the next step.
      const int begins = i * per_step + 2 * options_.intervals;
      out_.placements.push_back(placement(step.foot, step.surface, request_.footholds_W[i], {begins, last_stage_}));
    }
  }

  void add_phases(const Footsteps& footsteps) {
    std::array<int, 2> stands{0, 1};
    const bool reduced = options_.fidelity != Fidelity::single;
    for (int i = 0; i < out_.steps; ++i)
      for (int kind = 0; kind < 3; ++kind) {
        Horizon::Phase phase;
        const int foot = footsteps[request_.first + i].foot;
        phase.step = i;
        phase.swing = kind == 1 ? foot : -1;
        phase.centroidal = i == 0 || !reduced;
        phase.single_force = !phase.centroidal && options_.fidelity == Fidelity::point;
        if (kind == 2) stands[foot] = 2 + i;
        phase.placements = stands;
        if (kind == 1) phase.placements[foot] = -1;
        phase.first_node = (3 * i + kind) * options_.intervals;
        Range range = kind == 1 ? options_.single_support_s : options_.double_support_s;
        if (i == 0 && kind == 0) range.max += options_.landing_s;
        const double fixed = kind == 1 ? options_.predicted_single_support_s : options_.predicted_double_support_s;
        phase.duration = problem().add_variables("duration", 1, phase.centroidal ? range.min : fixed,
                                                 phase.centroidal ? range.max : fixed,
                                                 {phase.first_node, phase.first_node + options_.intervals});
        out_.phases.push_back(phase);
      }
  }

  /// Three variables, each component within +- limit in the axes of the heading: bounds where these are the world's.
  int add_boxed(const char* name, double limit, int stage) {
    const bool aligned = (walker_.r_WH.cwiseAbs().array() > 1.0 - 1e-12).count() == 3;
    const double bound = aligned ? limit : kInfinity;
    const int first = problem().add_variables(name, 3, -bound, bound, {stage, stage});
    if (!aligned && stage > 0)
      problem().add_constraint(
          std::make_unique<nlp::LinearPiece>(std::string(name) + "_box", std::vector<int>{first, first + 1, first + 2},
                                             walker_.r_WH.transpose()),
          -limit, limit);
    return first;
  }

  void add_nodes() {
    const State& state = request_.state;
    const int centroidal_nodes =
        1 + options_.intervals *
                static_cast<int>(std::count_if(out_.phases.begin(), out_.phases.end(),
                                               [](const Horizon::Phase& phase) { return phase.centroidal; }));
    for (int k = 0; k <= last_stage_; ++k) {
      Horizon::Node node;
      node.com = problem().add_variables("com", 3, -kInfinity, kInfinity, {k, k});
      const double v = options_.com_velocity_max, L = options_.momentum_max;
      node.velocity = add_boxed("velocity", v, k);
      if (k < centroidal_nodes) node.momentum = add_boxed("angular_momentum", L, k);
      if (options_.paper) {
        for (int i = 0; i < 2; ++i)
          problem().set_bounds(node.com + i, kPaperLow[i] - out_.shift_W[i], kPaperHigh[i] - out_.shift_W[i]);
        problem().set_bounds(node.com + 2, kPaperComHeight.min, kPaperComHeight.max);
      }
      out_.nodes.push_back(node);
    }
    fix(out_.nodes[0].com, state.com_W - out_.shift_W);
    fix(out_.nodes[0].velocity, state.com_velocity_W);
    fix(out_.nodes[0].momentum, state.angular_momentum_W);
  }

  void add_controls(Horizon::Phase& phase) {
    phase.first_control = static_cast<int>(out_.controls.size());
    phase.control_count = options_.intervals + (euler_ ? 0 : 1);
    for (int k = 0; k < phase.control_count; ++k) {
      Horizon::Control control;
      control.node = phase.first_node + k;
      const Stages here{control.node, control.node};
      for (int foot = 0; foot < 2; ++foot)
        if (phase.placements[foot] >= 0) add_points(phase, foot, here, control);
      control.acceleration = problem().add_variables("acceleration", 3, -kInfinity, kInfinity, here);
      add_acceleration(problem(), control.acceleration, out_.placements, control.points, walker_.robot.mass,
                       walker_.scene.gravity);
      if (phase.centroidal) {
        const double R = options_.momentum_rate_max;
        control.rate = add_boxed("momentum_rate", R, control.node);
        problem().add_equality(std::make_unique<MomentumRate>(control.rate, out_.nodes[control.node].com,
                                                              out_.placements, control.points));
      } else if (options_.fidelity != Fidelity::com) {
        add_relaxation(phase, k, control);
      }
      out_.controls.push_back(std::move(control));
    }
  }

  void add_points(const Horizon::Phase& phase, int foot, Stages here, Horizon::Control& control) {
    const Placement& placement = out_.placements[phase.placements[foot]];
    const double friction =
        (options_.paper ? 1.0 : options_.friction_ratio) * walker_.scene.surfaces[placement.surface].friction;
    const Eigen::Vector2d half = (options_.paper ? 1.0 : options_.sole_ratio) * walker_.feet[foot].half_size;
    const bool one = phase.single_force || half.maxCoeff() == 0.0;
    for (double s1 : {1.0, -1.0})
      for (double s2 : {1.0, -1.0}) {
        ContactPoint point;
        point.placement = phase.placements[foot];
        if (!one) point.offset_W = placement.axes_W.leftCols<2>() * Eigen::Vector2d(s1 * half[0], s2 * half[1]);
        if (friction_rows()) {
          point.variable = problem().add_variables("force", 3, -kInfinity, kInfinity, here);
          problem().set_bounds(point.variable + 2, 0.0, kInfinity);
          add_friction(problem(), point, friction, options_.friction_sides, options_.paper, !options_.friction_rows);
        } else {
          point.edges_W = pyramid_edges(placement, friction, options_.friction_sides, options_.paper);
          point.variable = problem().add_variables("force", point.count(), 0.0, kInfinity, here);
        }
        add_force_box(problem(), placement, point, force_limit(foot, one), friction);
        control.points.push_back(point);
        if (one) return;
      }
  }

  /// The kernel eliminates the rows of a pyramid at little cost, and takes fewer steps with three variables for a force
  /// than with one for each edge. Ipopt takes half as long again with rows.
  bool friction_rows() const { return options_.friction_rows || options_.solver != nlp::Solver::ipopt; }

  double force_limit(int foot, bool one) const { return walker_.feet[foot].max_force / (one ? 1.0 : 4.0); }

  void add_relaxation(const Horizon::Phase& phase, int k, Horizon::Control& control) {
    const double psi_max = options_.psi_max;
    for (const ContactPoint& point : control.points) {
      const Placement& placement = out_.placements[point.placement];
      const double unit = force_limit(placement.foot, phase.single_force);
      const int com = out_.nodes[control.node].com;
      // The duration is fixed in these phases.
      const double time = ratio(k) * problem().variable_lower()[phase.duration] / options_.intervals;
      if (!options_.lifted_psi) {
        problem().add_constraint(std::make_unique<TorqueBound>(com, placement, point, unit), -kInfinity, psi_max);
        problem().add_cost(std::make_unique<TorqueCost>(com, placement, point, unit, time));
        continue;
      }
      const int psi = problem().add_variables("psi", TorqueForms::kCount, 0.0, psi_max, {control.node, control.node});
      control.psi.push_back(psi);
      problem().add_constraint(std::make_unique<TorqueBound>(com, placement, point, unit, psi), -kInfinity, 0.0);
      problem().add_cost(
          std::make_unique<SquaredDistance>("torque_cost", psi, Eigen::VectorXd::Zero(TorqueForms::kCount), time));
    }
  }

  /// Weight of control node k of a phase in an integral over the phase, over h: rectangles or trapezoids.
  double ratio(int k) const { return euler_ || (k > 0 && k < options_.intervals) ? 1.0 : 0.5; }

  void add_dynamics(const Horizon::Phase& phase) {
    const int n = options_.intervals;
    for (int k = 0; k < n; ++k) {
      const Horizon::Node &a = out_.nodes[phase.first_node + k], &b = out_.nodes[phase.first_node + k + 1];
      const Horizon::Control& u = out_.controls[phase.first_control + k];
      if (euler_) {
        const auto step = [&](const char* name, int y0, int y1, int rate) {
          problem().add_equality(std::make_unique<EulerStep>(name, y0, y1, rate, phase.duration, n));
        };
        step("position_step", a.com, b.com, a.velocity);
        step("velocity_step", a.velocity, b.velocity, u.acceleration);
        if (phase.centroidal) step("momentum_step", a.momentum, b.momentum, u.rate);
        continue;
      }
      const LinearForceInterval interval = out_.interval(phase, k, n);
      problem().add_equality(std::make_unique<LinearForcePosition>(interval));
      problem().add_equality(std::make_unique<LinearForceVelocity>(interval));
      if (phase.centroidal) add_momentum(interval);
    }
  }

  void add_momentum(const LinearForceInterval& interval) {
    const double mass = walker_.robot.mass, gravity = walker_.scene.gravity, R = options_.momentum_rate_max;
    problem().add_equality(std::make_unique<LinearForceMomentum>(interval, mass, gravity));
    problem().add_constraint(std::make_unique<MomentumRateWithin>(interval, walker_.r_WH, mass, gravity), -R, R);
  }

  void add_running_cost(const Horizon::Phase& phase) {
    const int n = options_.intervals;
    const auto square = [&](const char* name, int y) {
      problem().add_cost(std::make_unique<SquareOverTime>(name, y, phase.duration, 1.0 / n));
    };
    for (int k = 0; k < n; ++k) {
      const int a = out_.controls[phase.first_control + k].acceleration;
      if (euler_)
        square("acceleration_cost", a);
      else
        problem().add_cost(std::make_unique<LinearSquareOverTime>(
            "acceleration_cost", a, out_.controls[phase.first_control + k + 1].acceleration, phase.duration, n));
    }
    for (int k = 0; k < n && phase.centroidal; ++k)
      if (euler_)
        square("momentum_cost", out_.nodes[phase.first_node + k].momentum);
      else
        problem().add_cost(std::make_unique<MomentumSquareOverTime>(out_.interval(phase, k, n), walker_.robot.mass,
                                                                    walker_.scene.gravity));
  }

  Polytope needed_faces(int node, int placement) {
    const Polytope& all = walker_.feet[out_.placements[placement].foot].com_reach_W;
    if (options_.all_faces) return all;
    const Eigen::VectorXd distance = reach_distance(all, out_, out_.guess, node, placement);
    const double margin = node > last_stage_ - 3 * options_.intervals / 2 ? kLastReachMargin_m : kReachMargin_m;
    std::vector<int> rows;
    for (int row = 0; row < distance.size(); ++row) {
      if (distance[row] < margin || request_.reach_rows.count({node, placement, row}))
        rows.push_back(row);
      else
        out_.left_out.push_back({node, placement, row});
    }
    return {all.A(rows, Eigen::all), all.b(rows)};
  }

  /// Reach and height for the feet in contact at every node of a phase, its two ends included; between the feet once
  /// for every pair on the ground together. What is fixed needs no rows.
  void add_reach() {
    std::set<std::pair<int, int>> done;
    for (const Horizon::Phase& phase : out_.phases)
      for (int k = 0; k <= options_.intervals; ++k)
        for (int placement : phase.placements) {
          const int node = phase.first_node + k;
          if (placement < 0 || node == 0 || !done.insert({node, placement}).second) continue;
          const Placement& foot = out_.placements[placement];
          add_com_reach(problem(), out_.nodes[node].com, foot, needed_faces(node, placement));
          if (!options_.paper) add_com_height(problem(), out_.nodes[node].com, foot, walker_.com_height_m);
        }
    for (int i = 0; i < out_.steps; ++i) {
      const std::array<int, 2>& pair = out_.phases[3 * i + 2].placements;
      for (int foot : {0, 1})
        add_foot_reach(problem(), out_.placements[pair[foot]], out_.placements[pair[1 - foot]],
                       walker_.feet[foot].partner_reach_W);
      const Placement& fresh = out_.placements[2 + i];
      Placement shifted = fresh;
      shifted.origin_W += out_.shift_W;
      add_foothold(problem(), shifted, walker_.surfaces[fresh.surface], walker_.taken_size(fresh.foot, fresh.surface));
    }
  }

  void add_end() {
    const Horizon::Node& end = out_.nodes.back();
    const double weight = options_.goal_weight * (request_.rest ? kRestWeight : 1.0);
    const Vector3d aim_W = request_.rest ? rest_W() : walker_.goal_com_W;
    problem().add_cost(std::make_unique<SquaredDistance>("goal", end.com, aim_W - out_.shift_W, weight));
    if (!request_.rest) return;
    fix(end.velocity, Vector3d::Zero());
    if (end.momentum >= 0) fix(end.momentum, Vector3d::Zero());
  }

  /// Where the CoM comes to rest: at the goal, or above the last two footholds of a sequence that ends far from it. The
  /// goal would pull it there with all that the legs have.
  Vector3d rest_W() const {
    const std::array<int, 2>& feet = out_.phases.back().placements;
    const Vector3d middle_W = 0.5 * (out_.position_W(out_.guess, feet[0]) + out_.position_W(out_.guess, feet[1]));
    const Vector3d& goal_W = walker_.goal_com_W;
    if ((goal_W - middle_W).head<2>().norm() <= kNearGoal_m) return goal_W;
    return middle_W + walker_.robot.com_height * Vector3d::UnitZ();
  }

  const Walker& walker_;
  const Options& options_;
  const HorizonRequest& request_;
  const bool euler_;
  int last_stage_ = 0;
  Horizon out_;
};

}  // namespace

Vector3d Horizon::position_W(const Eigen::VectorXd& x, int placement) const {
  const Placement& foot = placements[placement];
  return shift_W + foot.position_W(x.segment<2>(foot.variable));
}

LinearForceInterval Horizon::interval(const Phase& phase, int k, int intervals) const {
  const Node &a = nodes[phase.first_node + k], &b = nodes[phase.first_node + k + 1];
  const Control &u = controls[phase.first_control + k], &w = controls[phase.first_control + k + 1];
  return {a.com,      b.com,      a.velocity, b.velocity, u.acceleration, w.acceleration,
          a.momentum, b.momentum, u.rate,     w.rate,     phase.duration, intervals};
}

Horizon build_horizon(const Walker& walker, const Footsteps& footsteps, const HorizonRequest& request) {
  return Builder(walker, footsteps, request).take();
}

nlp::Problem::Worst worst_left_out(const Walker& walker, const Horizon& horizon, const Eigen::VectorXd& x) {
  nlp::Problem::Worst worst;
  for (const ReachRow& at : horizon.left_out) {
    const Polytope& all = walker.feet[horizon.placements[at.placement].foot].com_reach_W;
    const double over = -reach_distance(all, horizon, x, at.node, at.placement)[at.row];
    if (over > worst.value) worst = {"com_reach at stage " + std::to_string(at.node), over};
  }
  return worst;
}

std::set<ReachRow> violated_reach(const Walker& walker, const Horizon& horizon, const Eigen::VectorXd& x,
                                  double tolerance) {
  std::set<ReachRow> out;
  for (const ReachRow& at : horizon.left_out) {
    const Polytope& all = walker.feet[horizon.placements[at.placement].foot].com_reach_W;
    if (reach_distance(all, horizon, x, at.node, at.placement)[at.row] < -tolerance) out.insert(at);
  }
  return out;
}

}  // namespace mcplan::rhp
