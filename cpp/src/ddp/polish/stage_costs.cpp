#include "ddp/polish/stage_costs.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "ddp/input_limits.hpp"

namespace mcplan::ddp::polish {
namespace {

using Eigen::VectorXd;

/// Weight on the distance of a chosen foothold from its plane: it has the digits that make_exact() needs. Chosen.
constexpr double kPlane = 1000.0;

/// Terms with rows that are taken apart here and in limits.hpp. All others are summed as they are.
constexpr std::array<const char*, 15> kKnown = {
    "task",     "duration",  "contact", "free",      "bounds",   "reach", "interior_reach", "flight_duration",
    "friction", "force_cap", "torsion", "yaw_range", "pressure", "soles", "joint_limits"};

bool known(const CostTerm& term) {
  return std::any_of(kKnown.begin(), kKnown.end(), [&](const char* name) { return !std::strcmp(name, term.name()); });
}

}  // namespace

StageCosts::StageCosts(const FixedSequence& fixed, const Pendulum& pendulum, const Tuning& tuning)
    : fixed_(&fixed),
      pendulum_(&pendulum),
      planes_(fixed.steps() + 1),
      values_(fixed.problem().layout.nz(), false),
      gradients_(fixed.problem().layout.nz(), true) {
  const Problem& problem = fixed.problem();
  const Layout& at = problem.layout;
  const int n = fixed.steps(), nx = fixed.nx();
  schedule_.tuning = tuning;
  schedule_.contact_weight = problem.options.weights.contact_max;
  schedule_.interior_weight = tuning.limit_weight;
  constant_ = change_cost(problem, fixed.contacts());
  for (int k = 0; k < n; ++k) constant_ += state_cost(problem, fixed.contacts()[k]);
  for (const CostTerm* term : cost_terms()) {
    if (known(*term)) continue;
    if (term->scope() == Scope::step) of_step_.push_back(term);
    if (term->scope() == Scope::free) of_free_.push_back(term);
    if (term->scope() == Scope::contact) of_contact_.push_back(term);
    if (term->scope() == Scope::flight) of_flight_.push_back(term);
  }
  // The term "task" is diagonal and quadratic: its rows at zero tell its weights and targets.
  const CostTerm& task = *cost_terms()[cost_term_index("task")];
  const VectorXd x = VectorXd::Zero(nx), u = VectorXd::Zero(at.nu());
  for (int k = 0; k <= n; ++k) {
    Diagonal& q = diagonal_.emplace_back();
    q.weight.setZero(fixed.size(k));
    gradient_.emplace_back(fixed.size(k));
    q.target.setZero(fixed.size(k));
    std::vector<int>& columns = columns_.emplace_back(at.nz(), -1);
    for (int i = 0; i < nx; ++i) columns[i] = i;
    if (k < n)
      for (std::size_t i = 0; i < fixed.phase(k).inputs.size(); ++i)
        columns[nx + fixed.phase(k).inputs[i]] = nx + static_cast<int>(i);
    gradients_.clear();
    task.write({problem, pendulum, schedule_, k, x, k < n ? &u : nullptr, instants_}, gradients_);
    for (int r = 0; r < gradients_.count(); ++r)
      if (const int column = columns[gradients_.single(r)]; column >= 0) {
        q.weight[column] = gradients_.precision(r);
        q.target[column] = -gradients_.value(r);
      }
    if (k == n) break;
    const double w = duration_weight(problem, k);
    q.weight[fixed.size(k) - 1] = w * w;
    q.target[fixed.size(k) - 1] = duration_limits(problem, k).middle;
    // Centres of pressure stay in the plane where the inputs alone do not see to it.
    const Phase& phase = fixed.phase(k);
    for (const Standing& s : phase.standing)
      if (s.pressure_count == 3)
        planes_[k].push_back(
            {phase.moving[s.pressure], 3, problem.polygons[s.surface].normal_W(), 0.0, kPlane * kPlane});
  }
  for (const Touchdown& t : fixed.touchdowns()) {
    const Polygon& polygon = problem.polygons[t.surface];
    planes_[t.knot].push_back(
        {at.end(t.l), 3, polygon.normal_W(), polygon.height(Eigen::Vector3d::Zero()), kPlane * kPlane});
  }
}

double StageCosts::variable(const Motion& motion, int k, int column) const {
  const int nx = fixed_->nx();
  return column < nx ? motion.trajectory.x[k][column] : motion.trajectory.u[k][fixed_->phase(k).inputs[column - nx]];
}

double StageCosts::distance(const Motion& motion, int k, const Plane& plane) const {
  double out = plane.offset;
  for (int i = 0; i < plane.count; ++i) out += plane.along[i] * variable(motion, k, plane.first + i);
  return out;
}

/// The rows of the terms that are not known by name.
Rows& StageCosts::other_rows(const Motion& motion, int k, bool with_gradient) {
  const Problem& problem = fixed_->problem();
  const bool last = k == fixed_->steps();
  const Trajectory& t = motion.trajectory;
  Rows& rows = with_gradient ? gradients_ : values_;
  rows.clear();
  const ContactState& state = fixed_->contacts()[k];
  if (!last) instants_.of(problem, *pendulum_, t.x[k], t.u[k]);
  StepView view{problem, *pendulum_, schedule_, k, t.x[k], last ? nullptr : &t.u[k], instants_};
  const auto write = [&](const std::vector<const CostTerm*>& terms) {
    for (const CostTerm* term : terms)
      if (term->applies(view)) term->write(view, rows);
  };
  write(of_step_);
  for (std::size_t l = 0; l < state.size(); ++l) {
    view.look_at(static_cast<int>(l), state[l], t);
    write(state[l] == kFree ? of_free_ : of_contact_);
  }
  if (!last && in_flight(state)) write(of_flight_);
  return rows;
}

double StageCosts::value(const Motion& motion) {
  double cost = constant_;
  for (int k = 0; k <= fixed_->steps(); ++k) {
    const Diagonal& q = diagonal_[k];
    for (int i = 0; i < static_cast<int>(q.weight.size()); ++i) {
      const double off = variable(motion, k, i) - q.target[i];
      cost += 0.5 * q.weight[i] * off * off;
    }
    for (const Plane& plane : planes_[k]) {
      const double off = distance(motion, k, plane);
      cost += 0.5 * plane.weight * off * off;
    }
    cost += other_rows(motion, k, false).cost();
  }
  return cost;
}

void StageCosts::add(const Motion& motion, int k, StageModel& model) {
  const Diagonal& q = diagonal_[k];
  VectorXd& g = gradient_[k];
  model.h.diagonal() += q.weight;
  for (int i = 0; i < static_cast<int>(q.weight.size()); ++i)
    g[i] = q.weight[i] * (variable(motion, k, i) - q.target[i]);
  for (const Plane& plane : planes_[k]) {
    const double off = distance(motion, k, plane);
    for (int i = 0; i < plane.count; ++i) {
      g[plane.first + i] += plane.weight * off * plane.along[i];
      for (int j = 0; j < plane.count; ++j)
        model.h(plane.first + i, plane.first + j) += plane.weight * plane.along[i] * plane.along[j];
    }
  }
  const Rows& rows = other_rows(motion, k, true);
  const std::vector<int>& columns = columns_[k];
  for (int r = 0; r < rows.count(); ++r) {
    const auto gradient = rows.gradient(r);
    for (int i = 0; i < static_cast<int>(gradient.size()); ++i) {
      if (gradient[i] == 0.0 || columns[i] < 0) continue;
      const double along = rows.precision(r) * gradient[i];
      g[columns[i]] += along * rows.value(r);
      for (int j = 0; j < static_cast<int>(gradient.size()); ++j)
        if (gradient[j] != 0.0 && columns[j] >= 0) model.h(columns[i], columns[j]) += along * gradient[j];
    }
  }
  model.g += g;
}

double StageCosts::slope(const std::vector<VectorXd>& dz) const {
  double out = 0.0;
  for (int k = 0; k <= fixed_->steps(); ++k) out += gradient_[k].dot(dz[k]);
  return out;
}

}  // namespace mcplan::ddp::polish
