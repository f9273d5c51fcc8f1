#include "ipm/jacobian.hpp"

#include <algorithm>
#include <utility>

#include "ipm/all_finite.hpp"

namespace mcplan::ipm {

using Eigen::VectorXd;

Jacobian::Jacobian(const nlp::Problem& problem, VectorXd scales) : problem_(problem), scales_(std::move(scales)) {
  values_.resize(static_cast<int>(problem.jacobian_structure().size()));
  int most_variables = 0, largest_block = 0;
  for (const nlp::Problem::Block& block : problem.blocks()) {
    if (block.is_cost() || block.piece->linear() || block.jacobian_at.empty()) continue;
    nonlinear_.push_back(&block);
    most_variables = std::max(most_variables, block.piece->size());
    largest_block = std::max(largest_block, block.piece->rows() * block.piece->size());
    const int first = block.jacobian_at.front();  // the entries of a constraint follow one another
    if (ranges_.empty() || ranges_.back().first + ranges_.back().count != first) ranges_.push_back({first, 0});
    ranges_.back().count += static_cast<int>(block.jacobian_at.size());
  }
  x_.resize(most_variables);
  block_.resize(largest_block);
}

bool Jacobian::evaluate(const VectorXd& x) {
  if (!known_) {
    problem_.jacobian(x, values_);
    if (!all_finite(values_)) return false;
    if (scales_.size() > 0) values_.array() *= scales_.array();
    return known_ = true;
  }
  evaluate_nonlinear(x);
  for (const Range& range : ranges_) {
    auto values = values_.segment(range.first, range.count);
    if (!all_finite(values)) return false;
    if (scales_.size() > 0) values.array() *= scales_.segment(range.first, range.count).array();
  }
  return true;
}

void Jacobian::evaluate_nonlinear(const VectorXd& x) {
  for (const nlp::Problem::Block* block : nonlinear_) {
    const nlp::Piece& piece = *block->piece;
    for (int i = 0; i < piece.size(); ++i) x_[i] = x[piece.variables()[i]];
    Eigen::Map<Eigen::MatrixXd> J(block_.data(), piece.rows(), piece.size());
    J.setZero();
    piece.jacobian(x_.head(piece.size()), J);
    double* to = values_.data() + block->jacobian_at.front();
    for (int from : block->jacobian_from) *to++ = J.data()[from];
  }
}

}  // namespace mcplan::ipm
