#include "ipm/order.hpp"

#include <algorithm>
#include <numeric>

namespace mcplan::ipm {
namespace {

/// Sets of variables, joined one after another.
class Sets {
 public:
  explicit Sets(int count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  int of(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) { parent_[std::max(of(a), of(b))] = std::min(of(a), of(b)); }

 private:
  std::vector<int> parent_;
};

/// Equalities are unknowns of their own and join no variables.
bool has_inequality(const nlp::Problem::Block& block, const Unknowns& unknowns) {
  for (int i = 0; i < block.piece->rows(); ++i)
    if (unknowns.slack_of[block.first_row + i] >= 0) return true;
  return false;
}

/// Variables of one stage that no piece joins to those of another, and that have a bound: it makes their block of the
/// matrix positive, so that they can be eliminated by themselves.
std::vector<bool> inputs(const nlp::Problem& problem, const Unknowns& unknowns) {
  std::vector<bool> out(problem.variable_count(), false);
  for (int i = 0; i < unknowns.free_count(); ++i) {
    const nlp::Stages at = problem.variable_stages(unknowns.free[i]);
    const bool bounded = unknowns.lower[i] > -nlp::kInfinity || unknowns.upper[i] < nlp::kInfinity;
    out[unknowns.free[i]] = bounded && at.first == at.last;
  }
  for (const nlp::Problem::Block& block : problem.blocks()) {
    const nlp::Stages at = problem.piece_stages(*block.piece);
    if (at.first == at.last) continue;
    for (int variable : block.piece->variables()) out[variable] = false;
  }
  return out;
}

/// A stage with more equalities than variables to solve them for is eliminated with the one before, and so on: by
/// itself its block of the matrix would be singular. So ends a horizon whose last state is fixed, until as many inputs
/// have come together as it takes to reach it. `inputs`: of each stage, those that go ahead of it and stand in
/// equalities.
void join_overdetermined(int n, const std::vector<int>& inputs, std::vector<std::vector<int>>& own) {
  for (std::size_t stage = own.size() - 1; stage > 0; --stage) {
    int surplus = -inputs[stage];
    for (int unknown : own[stage]) surplus += unknown < n ? -1 : 1;
    if (surplus <= 0) continue;
    own[stage - 1].insert(own[stage - 1].end(), own[stage].begin(), own[stage].end());
    own[stage].clear();
  }
}

}  // namespace

std::vector<std::vector<int>> elimination_order(const nlp::Problem& problem, const Unknowns& unknowns) {
  const int n = unknowns.free_count();
  const std::vector<bool> input = inputs(problem, unknowns);
  int stages = 1;
  for (int variable : unknowns.free) stages = std::max(stages, problem.variable_stages(variable).first + 1);

  Sets sets(problem.variable_count());
  std::vector<int> row_stage(problem.row_count(), 0), inputs_in_equalities(stages, 0);
  std::vector<bool> counted(problem.variable_count(), false);
  for (const nlp::Problem::Block& block : problem.blocks()) {
    int stage = -1, input_stage = 0, first_input = -1;
    const bool couples = block.is_cost() || has_inequality(block, unknowns);
    for (int variable : block.piece->variables()) {
      if (unknowns.index_of[variable] < 0) continue;
      const int first = problem.variable_stages(variable).first;
      if (!input[variable]) {
        stage = std::max(stage, first);
        continue;
      }
      input_stage = first;
      if (!couples && !counted[variable]) {
        counted[variable] = true;
        ++inputs_in_equalities[first];
      }
      if (couples && first_input >= 0) sets.join(first_input, variable);
      first_input = variable;
    }
    if (block.is_cost()) continue;
    for (int i = 0; i < block.piece->rows(); ++i) row_stage[block.first_row + i] = stage >= 0 ? stage : input_stage;
  }

  std::vector<std::vector<int>> own(stages), out;
  std::vector<std::vector<std::vector<int>>> sets_of(stages);
  std::vector<int> place(problem.variable_count(), -1);
  for (int i = 0; i < n; ++i) {
    const int variable = unknowns.free[i], stage = problem.variable_stages(variable).first;
    if (!input[variable]) {
      own[stage].push_back(i);
      continue;
    }
    int& at = place[sets.of(variable)];
    if (at < 0) {
      at = static_cast<int>(sets_of[stage].size());
      sets_of[stage].emplace_back();
    }
    sets_of[stage][at].push_back(i);
  }
  for (int i = 0; i < unknowns.equality_count(); ++i) own[row_stage[unknowns.equalities[i]]].push_back(n + i);
  join_overdetermined(n, inputs_in_equalities, own);
  for (int stage = stages - 1; stage >= 0; --stage) {
    for (std::vector<int>& set : sets_of[stage]) out.push_back(std::move(set));
    if (!own[stage].empty()) out.push_back(std::move(own[stage]));
  }
  return out;
}

}  // namespace mcplan::ipm
