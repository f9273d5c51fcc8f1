#include "wb/block_band.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace mcplan::wb {

using Eigen::MatrixXd;

BlockBand::BlockBand(int blocks, int size) : blocks_(blocks), size_(size) {
  columns_.assign(blocks, MatrixXd::Zero(3 * size, size));
}

void BlockBand::set_zero() {
  for (MatrixXd& column : columns_) column.setZero();
}

Eigen::Ref<MatrixXd> BlockBand::block(int i, int below) { return columns_[i].middleRows(below * size_, size_); }

bool BlockBand::factor() {
  for (int i = 0; i < blocks_; ++i) {
    auto diagonal = columns_[i].topRows(size_);
    Eigen::LLT<Eigen::Ref<MatrixXd>> cholesky(diagonal);
    if (cholesky.info() != Eigen::Success) return false;
    const int left = std::min(2, blocks_ - 1 - i);
    if (left == 0) continue;
    auto below = columns_[i].middleRows(size_, left * size_);
    diagonal.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(below);
    const auto next = below.topRows(size_);
    columns_[i + 1].topRows(size_).selfadjointView<Eigen::Lower>().rankUpdate(next, -1.0);
    if (left < 2) continue;
    const auto last = below.bottomRows(size_);
    columns_[i + 1].middleRows(size_, size_).noalias() -= last * next.transpose();
    columns_[i + 2].topRows(size_).selfadjointView<Eigen::Lower>().rankUpdate(last, -1.0);
  }
  return true;
}

void BlockBand::solve(Eigen::Ref<Eigen::VectorXd> b) const {
  for (int i = 0; i < blocks_; ++i) {
    auto own = b.segment(i * size_, size_);
    columns_[i].topRows(size_).triangularView<Eigen::Lower>().solveInPlace(own);
    const int left = std::min(2, blocks_ - 1 - i) * size_;
    b.segment((i + 1) * size_, left).noalias() -= columns_[i].middleRows(size_, left) * own;
  }
  for (int i = blocks_ - 1; i >= 0; --i) {
    auto own = b.segment(i * size_, size_);
    const int left = std::min(2, blocks_ - 1 - i) * size_;
    own.noalias() -= columns_[i].middleRows(size_, left).transpose() * b.segment((i + 1) * size_, left);
    columns_[i].topRows(size_).triangularView<Eigen::Lower>().transpose().solveInPlace(own);
  }
}

}  // namespace mcplan::wb
