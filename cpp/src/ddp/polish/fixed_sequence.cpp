#include "ddp/polish/fixed_sequence.hpp"

#include <algorithm>

#include "ddp/footholds.hpp"
#include "ddp/moment_limits.hpp"

namespace mcplan::ddp::polish {

FixedSequence::FixedSequence(const Problem& problem, const ContactSequence& sequence)
    : problem_(&problem), sequence_(sequence) {
  for (int k = 0; k < steps(); ++k) phases_.push_back(make_phase(sequence[k]));
  for (int k = 1; k <= steps(); ++k)
    for (int l = 0; l < problem.layout.end_effector_count(); ++l)
      if (sequence[k][l] != kFree && sequence[k][l] != sequence[k - 1][l])
        touchdowns_.push_back({k, l, sequence[k][l]});
}

bool FixedSequence::last(const Touchdown& touchdown) const {
  const auto stands = [&](const ContactState& state) { return state[touchdown.l] == touchdown.surface; };
  return std::all_of(sequence_.begin() + touchdown.knot, sequence_.end(), stands);
}

Phase FixedSequence::make_phase(const ContactState& state) const {
  const Layout& at = problem_->layout;
  Phase phase;
  const int ends = at.end_effector_count();
  for (int i = 0; i < body_size(); ++i) phase.moving.push_back(i);
  phase.full = phase.moving;
  for (int l = 0; l < ends; ++l) {
    if (state[l] == kFree) {
      phase.swinging.push_back({l, nx() + static_cast<int>(phase.inputs.size())});
      for (int i = 0; i < 3; ++i) phase.inputs.push_back(at.stride(l) + i);
      continue;
    }
    Standing& s = phase.standing.emplace_back();
    s.l = l;
    s.surface = state[l];
    s.end = static_cast<int>(phase.moving.size());
    for (int i = 0; i < 3; ++i) phase.moving.push_back(at.end(l) + i);
    for (int i = 0; i < 3; ++i) phase.full.push_back(at.end(l) + i);
  }
  const auto vary = [&](int input) {
    phase.moving.push_back(nx() + static_cast<int>(phase.inputs.size()));
    phase.full.push_back(nx() + input);
    phase.inputs.push_back(input);
    return static_cast<int>(phase.moving.size()) - 1;
  };
  const auto next = [&] { return static_cast<int>(phase.moving.size()); };
  for (Standing& s : phase.standing) s.stiffness = vary(at.stiffness(s.l));
  for (Standing& s : phase.standing) {
    s.pressure = next();
    s.pressure_count = at.pressure_count(s.l);
    for (int i = 0; i < s.pressure_count; ++i) vary(at.pressure(s.l) + i);
  }
  for (Standing& s : phase.standing) {
    s.line = next();
    s.line_count = at.force_line_count(s.l);
    for (int i = 0; i < s.line_count; ++i) vary(at.force_line(s.l) + i);
  }
  for (Standing& s : phase.standing) {
    s.moment = next();
    for (int i = 0; i < at.moment_count(); ++i) {
      const Layout::Moment& m = at.moments()[i];
      if (m.end_effector != s.l || !about_normal(*problem_, m, s.surface)) continue;
      s.moments.push_back(i);
      vary(at.moment(i));
    }
  }
  phase.duration = vary(at.duration());
  return phase;
}

void FixedSequence::impose(Trajectory& trajectory) const {
  trajectory.x[0].tail(nx() - free_start()) = problem_->start.tail(nx() - free_start());
  snap_positions(*problem_, sequence_, trajectory);
  for (int k = 0; k < steps(); ++k) {
    Eigen::VectorXd& u = trajectory.u[k];
    const std::vector<int>& inputs = phases_[k].inputs;
    std::size_t next = 0;
    for (int i = 0; i < static_cast<int>(u.size()); ++i) {
      if (next < inputs.size() && inputs[next] == i)
        ++next;
      else
        u[i] = 0.0;
    }
  }
}

}  // namespace mcplan::ddp::polish
