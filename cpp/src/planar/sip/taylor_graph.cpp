#include "planar/sip/taylor_graph.hpp"

#include <algorithm>

namespace mcplan::sip {
namespace {

constexpr int kLanes = 4;  // rows of tangents are padded to whole vectors of doubles

std::vector<int> united(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> out;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

}  // namespace

int TaylorGraph::support_of(std::vector<int> columns) {
  const auto known = std::find(supports_.begin(), supports_.end(), columns);
  if (known != supports_.end()) return static_cast<int>(known - supports_.begin());
  supports_.push_back(std::move(columns));
  placements_.clear();
  return static_cast<int>(supports_.size()) - 1;
}

TaylorGraph::Node TaylorGraph::add(Data node, std::vector<int> columns) {
  const int width = static_cast<int>(columns.size());
  node.support = support_of(std::move(columns));
  node.value = value_size_;
  node.tangent = tangent_size_;
  node.stride = (width + kLanes - 1) / kLanes * kLanes;
  value_size_ += node.order + 1;
  tangent_size_ += (node.order + 1) * node.stride;
  nodes_.push_back(node);
  return size() - 1;
}

TaylorGraph::Node TaylorGraph::input(int order, std::vector<int> columns) {
  std::sort(columns.begin(), columns.end());
  Data node;
  node.operation = Operation::input;
  node.order = order;
  node.input = static_cast<int>(inputs_.size());
  inputs_.push_back(
      {Eigen::VectorXd::Zero(order + 1), RowMajor::Zero(order + 1, static_cast<int>(columns.size())), {}});
  return add(node, std::move(columns));
}

TaylorGraph::Node TaylorGraph::linear(const std::vector<Term>& terms, double constant, int order) {
  Data node;
  node.operation = Operation::linear;
  node.constant = constant;
  node.first_term = static_cast<int>(terms_.size());
  std::vector<int> support;
  int largest = 0;
  for (const Term& term : terms) {
    if (term.factor == 0.0) continue;
    terms_.push_back(term);
    support = united(support, columns(term.node));
    largest = std::max(largest, nodes_[term.node].order);
  }
  node.end_term = static_cast<int>(terms_.size());
  node.order = order < 0 ? largest : std::min(order, largest);
  return add(node, std::move(support));
}

TaylorGraph::Node TaylorGraph::product(Node a, Node b, int order) {
  Data node;
  node.operation = Operation::product;
  // The one with fewer coefficients goes left: it costs the Hessian a row each.
  const bool swap = nodes_[b].order < nodes_[a].order;
  node.a = swap ? b : a;
  node.b = swap ? a : b;
  node.order = std::min(order, nodes_[a].order + nodes_[b].order);
  Data& left = nodes_[node.a];
  if (left.left < 0) {
    left.left = left_rows_;
    left_rows_ += left.order + 1;
  }
  return add(node, united(columns(a), columns(b)));
}

std::pair<TaylorGraph::Node, TaylorGraph::Node> TaylorGraph::sin_cos(Node angle, int order) {
  Data node;
  node.operation = Operation::sine;
  node.order = order;
  node.a = angle;
  node.b = size() + 1;
  Data& left = nodes_[angle];
  if (left.left < 0) {
    left.left = left_rows_;
    left_rows_ += left.order + 1;
  }
  const std::vector<int> support = columns(angle);
  const Node sine = add(node, support);
  node.operation = Operation::cosine;
  node.b = sine;
  return {sine, add(node, support)};
}

TaylorGraph::Node TaylorGraph::derivative(Node a, int times) {
  Data node;
  node.operation = Operation::derivative;
  node.order = std::max(nodes_[a].order - times, 0);
  node.a = a;
  node.times = times;
  const std::vector<int> support = columns(a);
  return add(node, support);
}

TaylorGraph::Node TaylorGraph::integral(Node a, int order) {
  Data node;
  node.operation = Operation::integral;
  node.order = std::min(nodes_[a].order + 1, order);
  node.a = a;
  const std::vector<int> support = columns(a);
  return add(node, support);
}

const std::vector<int>& TaylorGraph::placement(int from, int to) const {
  const std::size_t count = supports_.size();
  if (placements_.size() != count) placements_.assign(count, std::vector<std::vector<int>>(count));
  std::vector<int>& places = placements_[from][to];
  if (places.empty() && from != to)
    for (int column : supports_[from])
      places.push_back(static_cast<int>(std::lower_bound(supports_[to].begin(), supports_[to].end(), column) -
                                        supports_[to].begin()));
  return places;
}

}  // namespace mcplan::sip
