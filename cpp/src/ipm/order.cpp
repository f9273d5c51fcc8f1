#include "ipm/order.hpp"

#include <Eigen/Cholesky>
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

constexpr std::size_t kMaxJoined = 500;  // unknowns of stages that are eliminated together

/// Equalities are unknowns of their own and join no variables.
bool has_inequality(const nlp::Problem::Block& block, const Unknowns& unknowns) {
  for (int i = 0; i < block.piece->rows(); ++i)
    if (unknowns.slack_of[block.first_row + i] >= 0) return true;
  return false;
}

/// Whether a piece's inequalities bound all of its variables, as the rows of a friction cone do: a linear map A of full
/// rank, whose A' D A is positive with any positive D.
bool bounds_all(const nlp::Problem::Block& block, const Unknowns& unknowns) {
  const nlp::Piece& piece = *block.piece;
  const int rows = piece.rows(), columns = piece.size();
  if (block.is_cost() || !piece.linear() || rows < columns) return false;
  for (int i = 0; i < rows; ++i)
    if (unknowns.slack_of[block.first_row + i] < 0) return false;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows, columns);
  piece.jacobian(Eigen::VectorXd::Zero(columns), A);
  const Eigen::MatrixXd square = A.transpose() * A;
  const Eigen::LLT<Eigen::MatrixXd> factor(square);
  constexpr double kLeastPivot = 1e-3;  // of L, over the length of the column
  if (factor.info() != Eigen::Success) return false;
  const Eigen::ArrayXd pivots = factor.matrixLLT().diagonal();
  return (pivots >= kLeastPivot * square.diagonal().array().sqrt()).all();
}

/// Variables of one stage that no piece joins to those of another, and that have bounds or rows that bound them: these
/// make their block of the matrix positive, so that they can be eliminated by themselves.
std::vector<bool> inputs(const nlp::Problem& problem, const Unknowns& unknowns) {
  std::vector<bool> out(problem.variable_count(), false);
  for (int i = 0; i < unknowns.free_count(); ++i)
    out[unknowns.free[i]] = unknowns.lower[i] > -nlp::kInfinity || unknowns.upper[i] < nlp::kInfinity;
  for (const nlp::Problem::Block& block : problem.blocks()) {
    if (!bounds_all(block, unknowns)) continue;
    for (int variable : block.piece->variables()) out[variable] = unknowns.index_of[variable] >= 0;
  }
  for (int variable : unknowns.free) {
    const nlp::Stages at = problem.variable_stages(variable);
    out[variable] = out[variable] && at.first == at.last;
  }
  for (const nlp::Problem::Block& block : problem.blocks()) {
    const nlp::Stages at = problem.piece_stages(*block.piece);
    if (at.first == at.last) continue;
    for (int variable : block.piece->variables()) out[variable] = false;
  }
  return out;
}

/// Pairs equalities with variables that they could be solved for, none twice.
class Pairing {
 public:
  /// columns: of each equality, the free variables that it sees; stage_of: at which each of these is eliminated.
  Pairing(const std::vector<std::vector<int>>& columns, const std::vector<int>& stage_of)
      : columns_(columns),
        stage_of_(stage_of),
        row_of_(stage_of.size(), -1),
        tried_(stage_of.size(), -1),
        useless_at_(stage_of.size(), -1) {}

  /// False: among the variables of this stage and later ones there is none left for this equality.
  bool add(int row, int stage) {
    ++round_;
    path_.assign(1, {row, -1, 0});
    seen_.clear();
    while (!path_.empty()) {
      if (const int column = path_.back().next == 0 ? unpaired(path_.back().row, stage) : -1; column >= 0) {
        row_of_[column] = path_.back().row;
        // Whoever was to give way has another one now.
        for (std::size_t i = path_.size() - 1; i-- > 0;) row_of_[path_[i].wanted] = path_[i].row;
        return true;
      }
      if (!ask_next(path_.back(), stage)) path_.pop_back();
    }
    for (int column : seen_) useless_at_[column] = stage;  // no later search of this stage has to look there again
    return false;
  }

 private:
  struct Asking {
    int row, wanted;   ///< the variable that its owner is asked to give up
    std::size_t next;  ///< of its variables, the one to ask for next
  };

  int unpaired(int row, int stage) const {
    for (int column : columns_[row])
      if (stage_of_[column] >= stage && row_of_[column] < 0) return column;
    return -1;
  }

  bool ask_next(Asking& asking, int stage) {
    while (asking.next < columns_[asking.row].size()) {
      const int column = columns_[asking.row][asking.next++];
      if (stage_of_[column] < stage || tried_[column] == round_ || useless_at_[column] == stage) continue;
      tried_[column] = round_;
      seen_.push_back(column);
      asking.wanted = column;
      path_.push_back({row_of_[column], -1, 0});
      return true;
    }
    return false;
  }

  const std::vector<std::vector<int>>& columns_;
  const std::vector<int>& stage_of_;
  std::vector<int> row_of_, tried_, useless_at_, seen_;
  std::vector<Asking> path_;  ///< a stack of its own: a horizon may be longer than the thread's is deep
  int round_ = 0;
};

/// A stage whose equalities have too few variables to be solved for is eliminated with the one before, and so on: by
/// itself its block of the matrix would be singular. So ends a horizon whose last state is fixed, until as many inputs
/// have come together as it takes to reach it.
/// sums: equalities that are eliminated ahead of their stage.
void join_overdetermined(const nlp::Problem& problem, const Unknowns& unknowns,
                         const std::vector<std::vector<int>>& sums, std::vector<std::vector<int>>& own) {
  const int n = unknowns.free_count();
  std::vector<std::vector<int>> columns(unknowns.equality_count());
  for (const nlp::Entry& entry : problem.jacobian_structure()) {
    const int row = unknowns.equality_of[entry.row], column = unknowns.index_of[entry.column];
    if (row >= 0 && column >= 0) columns[row].push_back(column);
  }
  std::vector<int> stage_of(n);
  for (int i = 0; i < n; ++i) stage_of[i] = problem.variable_stages(unknowns.free[i]).first;
  // Equalities that have no variable in the whole horizon say what others say: no joining helps them.
  Pairing pairing(columns, stage_of), whole(columns, stage_of);
  std::vector<bool> paired(unknowns.equality_count());
  for (int row = 0; row < unknowns.equality_count(); ++row) paired[row] = !whole.add(row, 0);
  for (int stage = static_cast<int>(own.size()) - 1; stage > 0; --stage) {
    bool all = true;
    for (int unknown : sums[stage]) paired[unknown - n] = pairing.add(unknown - n, stage);
    for (int unknown : own[stage])
      if (unknown >= n && !paired[unknown - n]) all &= paired[unknown - n] = pairing.add(unknown - n, stage);
    if (all || own[stage].size() + own[stage - 1].size() > kMaxJoined) continue;
    own[stage - 1].insert(own[stage - 1].end(), own[stage].begin(), own[stage].end());
    own[stage].clear();
  }
}

/// Equalities that could be solved for inputs of their own, as an acceleration is a sum of contact forces: -1 or the
/// stage of these. With the inputs eliminated, their block of the matrix is negative.
std::vector<int> sums_of_inputs(const nlp::Problem& problem, const Unknowns& unknowns, const std::vector<bool>& input) {
  std::vector<std::vector<int>> columns(unknowns.equality_count());
  std::vector<int> out(unknowns.equality_count(), -1);
  for (const nlp::Entry& entry : problem.jacobian_structure())
    if (const int row = unknowns.equality_of[entry.row]; row >= 0 && input[entry.column])
      columns[row].push_back(unknowns.index_of[entry.column]);
  const std::vector<int> any_stage(unknowns.free_count(), 0);
  Pairing pairing(columns, any_stage);
  for (const nlp::Problem::Block& block : problem.blocks()) {
    bool all = !block.is_cost();
    for (int i = 0; i < block.piece->rows() && all; ++i) {
      const int row = unknowns.equality_of[block.first_row + i];
      all = row >= 0 && pairing.add(row, 0);
    }
    for (int i = 0; i < block.piece->rows() && all; ++i) {
      const int row = unknowns.equality_of[block.first_row + i];
      out[row] = problem.variable_stages(unknowns.free[columns[row].front()]).first;
    }
  }
  return out;
}

}  // namespace

std::vector<std::vector<int>> elimination_order(const nlp::Problem& problem, const Unknowns& unknowns,
                                                bool sums_ahead) {
  const int n = unknowns.free_count();
  const std::vector<bool> input = inputs(problem, unknowns);
  int stages = 1;
  for (int variable : unknowns.free) stages = std::max(stages, problem.variable_stages(variable).first + 1);

  Sets sets(problem.variable_count());
  std::vector<int> row_stage(problem.row_count(), 0);
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
  std::vector<std::vector<int>> sums(stages);
  std::vector<int> sum_at(unknowns.equality_count(), -1);
  if (sums_ahead) sum_at = sums_of_inputs(problem, unknowns, input);
  for (int i = 0; i < unknowns.equality_count(); ++i)
    (sum_at[i] >= 0 ? sums[sum_at[i]] : own[row_stage[unknowns.equalities[i]]]).push_back(n + i);
  join_overdetermined(problem, unknowns, sums, own);
  for (int stage = stages - 1; stage >= 0; --stage) {
    for (std::vector<int>& set : sets_of[stage]) out.push_back(std::move(set));
    if (!sums[stage].empty()) out.push_back(std::move(sums[stage]));
    if (!own[stage].empty()) out.push_back(std::move(own[stage]));
  }
  return out;
}

}  // namespace mcplan::ipm
