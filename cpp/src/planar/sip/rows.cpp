#include "planar/sip/rows.hpp"

#include <cmath>

#include "planar/sip/polynomial.hpp"

namespace mcplan::sip {

Eigen::RowVectorXd powers(double s, int degree) {
  Eigen::RowVectorXd out(degree + 1);
  out[0] = 1.0;
  for (int k = 1; k <= degree; ++k) out[k] = s * out[k - 1];
  return out;
}

Rows::Rows(const TaylorGraph& graph, std::vector<Limited> limited, const Options& options)
    : graph_(graph), limited_(std::move(limited)) {
  std::vector<double> lower, upper;
  const auto row = [&](double from, double to, std::size_t owner) {
    lower.push_back(from);
    upper.push_back(to);
    owner_.push_back(static_cast<int>(owner));
  };
  for (std::size_t i = 0; i < limited_.size(); ++i) {
    const Limited& it = limited_[i];
    first_row_.push_back(static_cast<int>(lower.size()));
    const int degree = graph_.order(it.node);
    const double low = it.lower * it.scale, high = it.upper * it.scale;
    Eigen::MatrixXd matrix;
    const bool constant = degree == 0 && it.when == Limited::When::always;
    if (it.when == Limited::When::coefficients) {
      matrix = Eigen::MatrixXd::Identity(std::min(it.highest, degree) + 1, degree + 1);
    } else if (it.when == Limited::When::instant || constant) {
      matrix = powers(it.when == Limited::When::instant ? it.at : 0.0, degree);
    } else if (options.continuous == Continuous::hull) {
      matrix = bernstein_matrix(degree);
    } else if (options.continuous == Continuous::grid) {
      matrix.resize(options.grid_points, degree + 1);
      for (int g = 0; g < options.grid_points; ++g)
        matrix.row(g) = powers(-1.0 + 2.0 * g / (options.grid_points - 1), degree);
    } else {
      extremum_ = true;
      if (std::isfinite(low)) row(low, INFINITY, i);
      if (std::isfinite(high)) row(-INFINITY, high, i);
    }
    for (int r = 0; r < matrix.rows(); ++r) row(low, high, i);
    matrices_.push_back(it.scale * matrix);
  }
  first_row_.push_back(static_cast<int>(lower.size()));
  lower_ = Eigen::Map<Eigen::VectorXd>(lower.data(), static_cast<Eigen::Index>(lower.size()));
  upper_ = Eigen::Map<Eigen::VectorXd>(upper.data(), static_cast<Eigen::Index>(upper.size()));
}

const Eigen::MatrixXd& Rows::matrix(int i, const TaylorGraph::Workspace& work) const {
  if (matrices_[i].size() > 0) return matrices_[i];
  const Limited& it = limited_[i];
  const int degree = graph_.order(it.node);
  const Extrema found = extrema(graph_.coefficients(work, it.node));
  const int first = first_row_[i], count = first_row_[i + 1] - first;
  moving_.resize(count, degree + 1);
  for (int r = 0; r < count; ++r)
    moving_.row(r) = it.scale * powers(std::isfinite(lower_[first + r]) ? found.at_min : found.at_max, degree);
  return moving_;
}

void Rows::values(const TaylorGraph::Workspace& work, Eigen::Ref<Eigen::VectorXd> f) const {
  for (std::size_t i = 0; i < limited_.size(); ++i) {
    const Eigen::MatrixXd& R = matrix(static_cast<int>(i), work);
    f.segment(first_row_[i], R.rows()).noalias() = R * graph_.coefficients(work, limited_[i].node);
  }
}

void Rows::jacobian(const TaylorGraph::Workspace& work, Eigen::Ref<Eigen::VectorXd> f,
                    Eigen::Ref<Eigen::MatrixXd> J) const {
  for (std::size_t i = 0; i < limited_.size(); ++i) {
    const TaylorGraph::Node node = limited_[i].node;
    const Eigen::MatrixXd& R = matrix(static_cast<int>(i), work);
    f.segment(first_row_[i], R.rows()).noalias() = R * graph_.coefficients(work, node);
    product_.noalias() = R * graph_.tangents(work, node);
    const std::vector<int>& columns = graph_.columns(node);
    for (std::size_t c = 0; c < columns.size(); ++c)
      J.col(columns[c]).segment(first_row_[i], R.rows()) = product_.col(static_cast<Eigen::Index>(c));
  }
}

void Rows::add_adjoints(TaylorGraph::Workspace& work, const Eigen::Ref<const Eigen::VectorXd>& weights) const {
  for (std::size_t i = 0; i < limited_.size(); ++i) {
    const Eigen::MatrixXd& R = matrix(static_cast<int>(i), work);
    graph_.adjoints(work, limited_[i].node).noalias() += R.transpose() * weights.segment(first_row_[i], R.rows());
  }
}

}  // namespace mcplan::sip
