#include "ddp/local_model.hpp"

#include <algorithm>
#include <cmath>

#include "ddp/constants.hpp"

namespace mcplan::ddp {

using Eigen::VectorXd;

namespace {

/// Turn the quadratic of step k into the metric of the least change.
void hold_inputs(const Problem& problem, int k, const std::vector<char>* fixed, Quadratic& q) {
  const int nx = problem.layout.nx(), fixed_states = nx - (problem.model == Model::wrench ? 0 : Layout::angle());
  q.g.setZero();
  q.h *= kCostShare;
  q.h.diagonal().array() += 1.0;
  if (k == 0) q.h.diagonal().segment(nx - fixed_states, fixed_states).array() += kFixed;
  if (!fixed && problem.pinned_end) q.h.diagonal().head(nx).array() += kFixed;
  if (!fixed) return;
  for (std::size_t i = 0; i < fixed->size(); ++i)
    if ((*fixed)[i]) q.h(nx + static_cast<int>(i), nx + static_cast<int>(i)) += kFixed;
}

}  // namespace

LocalModel::LocalModel(const Problem& problem)
    : problem_(&problem),
      pendulum_(problem.layout, problem.inertia, problem.options.stiffness_input, problem.model),
      stages_(problem.steps + 1),
      base_rows_(problem.layout.nz(), true) {
  for (Stage& stage : stages_) {
    stage.flight = Rows(problem.layout.nz(), true);
    for (int l = 0; l < problem.layout.end_effector_count(); ++l)
      stage.blocks.emplace_back(problem.rules.surfaces(l).size() + 1);
  }
  for (int l = 0; l < problem.layout.end_effector_count(); ++l) {
    choice_.emplace_back(problem.polygons.size(), 0);
    int choice = 0;
    for (int surface : problem.rules.surfaces(l)) choice_[l][surface] = ++choice;
  }
}

void LocalModel::expand(const Trajectory& trajectory, const Schedule& schedule) {
  const Layout& at = problem_->layout;
  trajectory_ = &trajectory;
  schedule_ = schedule;
  ++expansion_;
  for (int k = 0; k <= steps(); ++k) {
    Stage& stage = stages_[k];
    const bool last = k == steps();
    const VectorXd& x = trajectory.x[k];
    const VectorXd* u = last ? nullptr : &trajectory.u[k];
    base_rows_.clear();
    if (!last) stage.instants.of(*problem_, pendulum_, x, *u);
    write_terms(Scope::step, view(k), base_rows_);
    stage.base.c = 0.0;
    stage.base.g.setZero(at.nz());
    stage.base.h.setZero(at.nz(), at.nz());
    base_rows_.accumulate(stage.base.c, stage.base.g, stage.base.h);
    if (schedule.fixed_inputs) hold_inputs(*problem_, k, last ? nullptr : &(*schedule.fixed_inputs)[k], stage.base);
    stage.flight_made = false;
    if (last) {
      stage.base.g.conservativeResize(at.nx());
      stage.base.h.conservativeResize(at.nx(), at.nx());
      continue;
    }
    stage.base.h.diagonal().tail(at.nu()).array() += schedule.proximal_weight;
    pendulum_.step(x, *u, 1.0, stage.dynamics);
    stage.defect.resize(at.nx());
    stage.defect.segment<3>(at.com()) = stage.dynamics.com;
    stage.defect.segment<3>(at.velocity()) = stage.dynamics.velocity;
    stage.defect.segment(at.angle(), at.axis_count()) = stage.dynamics.angle;
    stage.defect.segment(at.momentum(), at.axis_count()) = stage.dynamics.momentum;
    for (int l = 0; l < at.end_effector_count(); ++l)
      stage.defect.segment<3>(at.end(l)) = x.segment<3>(at.end(l)) + u->segment<3>(at.stride(l));
    stage.defect -= trajectory.x[k + 1];
  }
}

StepView LocalModel::view(int k) const {
  return {*problem_,          pendulum_, schedule_, k, trajectory_->x[k], k < steps() ? &trajectory_->u[k] : nullptr,
          stages_[k].instants};
}

const Rows& LocalModel::block(int k, int l, int contact) {
  Stage& stage = stages_[k];
  const int choice = contact == kFree ? 0 : choice_[l][contact];
  std::unique_ptr<Block>& block = stage.blocks[l][choice];
  if (!block) block = std::make_unique<Block>(Block{Rows(problem_->layout.nz(), true), 0});
  Rows& rows = block->rows;
  if (block->made != expansion_) {
    rows.clear();
    StepView about = view(k);
    about.look_at(l, contact, *trajectory_);
    write_terms(contact == kFree ? Scope::free : Scope::contact, about, rows);
    block->made = expansion_;
  }
  return rows;
}

const Rows* LocalModel::state_block(int k, const ContactState& state) {
  if (k == steps() || !in_flight(state)) return nullptr;
  Stage& stage = stages_[k];
  if (!stage.flight_made) {
    stage.flight.clear();
    write_terms(Scope::flight, view(k), stage.flight);
    stage.flight_made = true;
  }
  return &stage.flight;
}

void LocalModel::make_blocks(int k, const ContactState& state) {
  for (int l = 0; l < problem_->layout.end_effector_count(); ++l) block(k, l, state[l]);
  state_block(k, state);
}

void LocalModel::add_contacts(int k, const ContactState& state, Quadratic& q) {
  if (schedule_.fixed_inputs) return;
  if (k == steps()) {
    // Rows at the last knot touch x alone but are stored over z.
    const int nx = problem_->layout.nx();
    for (int l = 0; l < problem_->layout.end_effector_count(); ++l) {
      const Rows& rows = block(k, l, state[l]);
      q.c += rows.cost();
      for (int r = 0; r < rows.count(); ++r) {
        const auto g = rows.gradient(r).head(nx);
        q.g += rows.precision(r) * rows.value(r) * g;
        q.h += rows.precision(r) * g * g.transpose();
      }
    }
    return;
  }
  q.c += state_cost(*problem_, state);
  if (const Rows* rows = state_block(k, state)) rows->accumulate(q.c, q.g, q.h);
  for (int l = 0; l < problem_->layout.end_effector_count(); ++l) block(k, l, state[l]).accumulate(q.c, q.g, q.h);
}

Evaluator::Evaluator(const Problem& problem)
    : problem_(&problem),
      pendulum_(problem.layout, problem.inertia, problem.options.stiffness_input, problem.model),
      rows_(problem.layout.nz(), false) {}

Evaluation Evaluator::operator()(const Trajectory& trajectory, const ContactSequence& sequence,
                                 const Schedule& schedule) {
  Evaluation out;
  rows_.clear();
  for (int k = 0; k <= problem_->steps; ++k) {
    const bool last = k == problem_->steps;
    const VectorXd& x = trajectory.x[k];
    const VectorXd* u = last ? nullptr : &trajectory.u[k];
    if (!last) instants_.of(*problem_, pendulum_, x, *u);
    StepView about{*problem_, pendulum_, schedule, k, x, u, instants_};
    write_terms(Scope::step, about, rows_);
    for (int l = 0; l < problem_->layout.end_effector_count(); ++l) {
      about.look_at(l, sequence[k][l], trajectory);
      write_terms(about.surface == kFree ? Scope::free : Scope::contact, about, rows_);
    }
    if (last) break;
    if (in_flight(sequence[k])) write_terms(Scope::flight, about, rows_);
    write_state_cost(*problem_, sequence[k], rows_);
    pendulum_.next(x, *u, next_);
    next_ -= trajectory.x[k + 1];
    out.defect_sum += problem_->layout.distance(next_);
    out.defect_max = std::max(out.defect_max, next_.lpNorm<Eigen::Infinity>());
  }
  if (schedule.interior_weight > 0.0) write_change_cost(*problem_, sequence, rows_);
  out.cost = rows_.cost();
  out.terms = rows_.terms();
  return out;
}

}  // namespace mcplan::ddp
