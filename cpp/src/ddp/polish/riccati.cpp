#include "ddp/polish/riccati.hpp"

#include "ddp/elimination.hpp"

namespace mcplan::ddp::polish {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Riccati::Riccati(const FixedSequence& fixed) : fixed_(&fixed), models_(fixed.steps() + 1), stages_(fixed.steps()) {
  for (int k = 0; k <= fixed.steps(); ++k) {
    models_[k].g.setZero(fixed.size(k));
    models_[k].h.setZero(fixed.size(k), fixed.size(k));
  }
  for (int k = 0; k < fixed.steps(); ++k)
    stages_[k].jacobian.setZero(fixed.body_size(), static_cast<int>(fixed.phase(k).moving.size()));
}

/// The rows of [A B] that are not those of end-effectors: the others are an identity and the strides.
void Riccati::linearise(const Motion& motion, int k) {
  const Layout& at = fixed_->problem().layout;
  const Phase& phase = fixed_->phase(k);
  const PendulumStep& step = motion.end(k);
  MatrixXd& out = stages_[k].jacobian;
  const int com = Layout::com(), velocity = Layout::velocity();
  for (int j = 0; j < 3; ++j) {
    out(com + j, com + j) = out(velocity + j, velocity + j) = step.pp;
    out(com + j, velocity + j) = step.pv;
    out(velocity + j, com + j) = step.vp;
  }
  for (const Standing& s : phase.standing) {
    for (const auto& [row, by] : {std::pair(com, step.p_end * step.mu[s.l]), {velocity, step.v_end * step.mu[s.l]}}) {
      for (int j = 0; j < 3; ++j) out(row + j, s.end + j) = by;
      if (s.pressure_count > 0) out.block(row, s.pressure, 3, s.pressure_count) = by * at.offsets(s.l).pressure;
      if (s.line_count > 0) out.block(row, s.line, 3, s.line_count) = by * at.offsets(s.l).force_line;
    }
    out.col(s.stiffness).segment<3>(com) = step.p_mu.col(s.l);
    out.col(s.stiffness).segment<3>(velocity) = step.v_mu.col(s.l);
  }
  out.col(phase.duration).segment<3>(com) = step.velocity;
  out.col(phase.duration).segment<3>(velocity) = step.acceleration;
  const int turning = 2 * at.axis_count();
  for (std::size_t j = 0; j < phase.full.size(); ++j)
    out.col(static_cast<int>(j)).segment(Layout::angle(), turning) = step.turn.col(phase.full[j]);
}

bool Riccati::backward(const Motion& motion, int k, double proximal) {
  const Phase& phase = fixed_->phase(k);
  const int nx = fixed_->nx(), n = fixed_->size(k), nv = n - nx, body = fixed_->body_size();
  Stage& stage = stages_[k];
  StageModel& here = models_[k];
  const StageModel& next = models_[k + 1];
  const auto value = next.h.topLeftCorner(nx, nx);
  linearise(motion, k);
  // J' V J with J = [A B]: columns of V J first, then its rows from the left.
  stage.scattered.noalias() = value.leftCols(body) * stage.jacobian;
  stage.pushed.setZero(nx, n);
  for (std::size_t j = 0; j < phase.moving.size(); ++j)
    stage.pushed.col(phase.moving[j]) = stage.scattered.col(static_cast<int>(j));
  stage.pushed.middleCols(body, nx - body) += value.rightCols(nx - body);
  for (const Phase::Swinging& s : phase.swinging)
    stage.pushed.middleCols<3>(s.stride) += value.middleCols<3>(fixed_->problem().layout.end(s.l));
  stage.pulled.noalias() = stage.pushed.topRows(body).transpose() * stage.jacobian;
  for (std::size_t j = 0; j < phase.moving.size(); ++j)
    here.h.col(phase.moving[j]) += stage.pulled.col(static_cast<int>(j));
  here.h.middleCols(body, nx - body) += stage.pushed.bottomRows(nx - body).transpose();
  for (const Phase::Swinging& s : phase.swinging)
    here.h.middleCols<3>(s.stride) += stage.pushed.middleRows<3>(fixed_->problem().layout.end(s.l)).transpose();
  stage.w = next.g.head(nx);
  stage.w.noalias() += value * motion.defect(k);
  stage.offset.noalias() = stage.jacobian.transpose() * stage.w.head(body);
  for (std::size_t j = 0; j < phase.moving.size(); ++j) here.g[phase.moving[j]] += stage.offset[static_cast<int>(j)];
  here.g.segment(body, nx - body) += stage.w.tail(nx - body);
  for (const Phase::Swinging& s : phase.swinging)
    here.g.segment<3>(s.stride) += stage.w.segment<3>(fixed_->problem().layout.end(s.l));
  // Minimise over the inputs.
  here.h.diagonal().tail(nv).array() += proximal;
  if (!eliminate_last(here.h, nv)) return false;
  auto left = here.h.topLeftCorner(nx, nx);
  left.triangularView<Eigen::StrictlyLower>() = left.transpose();
  auto offset = here.g.tail(nv);
  here.h.bottomRightCorner(nv, nv).triangularView<Eigen::Upper>().solveInPlace(offset);
  here.g.head(nx).noalias() -= here.h.topRightCorner(nx, nv) * offset;
  return true;
}

bool Riccati::solve(const Motion& motion, double proximal, std::vector<VectorXd>& dz) {
  const Layout& at = fixed_->problem().layout;
  const int n = fixed_->steps(), nx = fixed_->nx(), body = fixed_->body_size();
  for (int k = n - 1; k >= 0; --k)
    if (!backward(motion, k, proximal)) return false;
  for (int k = 0; k <= n; ++k) dz[k].resize(fixed_->size(k));
  dz[0].head(nx).setZero();
  if (const int free = fixed_->free_start(); free > 0) {
    const Eigen::LLT<Eigen::Matrix3d> factor(models_[0].h.topLeftCorner<3, 3>());
    if (factor.info() != Eigen::Success) return false;
    dz[0].head<3>() = -factor.solve(models_[0].g.head<3>());
  }
  for (int k = 0; k < n; ++k) {
    Stage& stage = stages_[k];
    const Phase& phase = fixed_->phase(k);
    const StageModel& here = models_[k];
    const int nv = fixed_->size(k) - nx;
    auto dv = dz[k].tail(nv);
    dv = -here.g.tail(nv);
    dv.noalias() -= here.h.topRightCorner(nx, nv).transpose() * dz[k].head(nx);
    here.h.bottomRightCorner(nv, nv).triangularView<Eigen::Upper>().transpose().solveInPlace(dv);
    stage.w.resize(static_cast<int>(phase.moving.size()));
    for (std::size_t j = 0; j < phase.moving.size(); ++j) stage.w[static_cast<int>(j)] = dz[k][phase.moving[j]];
    auto next = dz[k + 1].head(nx);
    next = motion.defect(k);
    next.head(body).noalias() += stage.jacobian * stage.w;
    next.tail(nx - body) += dz[k].segment(body, nx - body);
    for (const Phase::Swinging& s : phase.swinging) next.segment<3>(at.end(s.l)) += dz[k].segment<3>(s.stride);
  }
  return true;
}

}  // namespace mcplan::ddp::polish
