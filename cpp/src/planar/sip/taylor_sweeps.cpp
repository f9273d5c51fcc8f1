// Evaluation of TaylorGraph: values, tangents, adjoints, Hessian.
#include <algorithm>
#include <cmath>

#include "planar/sip/taylor_graph.hpp"

namespace mcplan::sip {
namespace {

/// out += factor * in, over rows that are padded to whole vectors.
inline void add_row(double* __restrict out, const double* __restrict in, double factor, int width) {
  for (int i = 0; i < width; ++i) out[i] += factor * in[i];
}

inline void add_placed(double* __restrict out, const double* __restrict in, double factor,
                       const std::vector<int>& places) {
  for (std::size_t i = 0; i < places.size(); ++i) out[places[i]] += factor * in[i];
}

double falling(int from, int times) {
  double out = 1.0;
  for (int i = 0; i < times; ++i) out *= from - i;
  return out;
}

}  // namespace

void TaylorGraph::evaluate(Workspace& work, bool tangents) const {
  if (static_cast<int>(work.values.size()) < value_size_) work.values.resize(value_size_);
  evaluate_values(work);
  if (!tangents) return;
  if (static_cast<int>(work.tangents.size()) < tangent_size_) work.tangents.resize(tangent_size_);
  const std::size_t scratch = 2 * (kMaxOrder + 1) * static_cast<std::size_t>(parameters_ + 4);
  if (work.scratch.size() < scratch) work.scratch.resize(scratch);
  evaluate_tangents(work);
}

void TaylorGraph::evaluate_values(Workspace& work) const {
  for (const Data& node : nodes_) {
    double* out = work.values.data() + node.value;
    const double* a = node.a < 0 ? nullptr : work.values.data() + nodes_[node.a].value;
    const int order_a = node.a < 0 ? 0 : nodes_[node.a].order;
    switch (node.operation) {
      case Operation::input:
        std::copy_n(inputs_[node.input].coefficients.data(), node.order + 1, out);
        break;
      case Operation::linear:
        std::fill_n(out, node.order + 1, 0.0);
        out[0] = node.constant;
        for (int t = node.first_term; t < node.end_term; ++t) {
          const Data& term = nodes_[terms_[t].node];
          add_row(out, work.values.data() + term.value, terms_[t].factor, std::min(term.order, node.order) + 1);
        }
        break;
      case Operation::product: {
        const Data& right = nodes_[node.b];
        const double* b = work.values.data() + right.value;
        std::fill_n(out, node.order + 1, 0.0);
        for (int i = 0; i <= std::min(order_a, node.order); ++i)
          add_row(out + i, b, a[i], std::min(right.order, node.order - i) + 1);
        break;
      }
      case Operation::sine: {
        // k S_k = sum_m m theta_m C_{k-m},  k C_k = -sum_m m theta_m S_{k-m}
        double* cosine = work.values.data() + nodes_[node.b].value;
        out[0] = std::sin(a[0]);
        cosine[0] = std::cos(a[0]);
        for (int k = 1; k <= node.order; ++k) {
          double s = 0.0, c = 0.0;
          for (int m = 1; m <= std::min(order_a, k); ++m) {
            s += m * a[m] * cosine[k - m];
            c -= m * a[m] * out[k - m];
          }
          out[k] = s / k;
          cosine[k] = c / k;
        }
        break;
      }
      case Operation::cosine:  // done with its sine
        break;
      case Operation::derivative:
        for (int k = 0; k <= node.order; ++k)
          out[k] = k + node.times <= order_a ? falling(k + node.times, node.times) * a[k + node.times] : 0.0;
        break;
      case Operation::integral:
        out[0] = 0.0;
        for (int k = 1; k <= node.order; ++k) out[k] = a[k - 1] / k;
        break;
    }
  }
}

const double* TaylorGraph::expanded(const Workspace& work, const Data& operand, int support, int stride,
                                    double* scratch) const {
  const double* in = work.tangents.data() + operand.tangent;
  if (operand.support == support) return in;
  const std::vector<int>& places = placement(operand.support, support);
  std::fill_n(scratch, (operand.order + 1) * stride, 0.0);
  for (int k = 0; k <= operand.order; ++k)
    for (std::size_t i = 0; i < places.size(); ++i) scratch[k * stride + places[i]] = in[k * operand.stride + i];
  return scratch;
}

/// dc_{i+j} = a_i db_j + b_j da_i
void TaylorGraph::evaluate_product_tangents(Workspace& work, const Data& node) const {
  double* out = work.tangents.data() + node.tangent;
  const int width = node.stride;
  const Data &left = nodes_[node.a], &right = nodes_[node.b];
  double* scratch = work.scratch.data();
  const double* da = expanded(work, left, node.support, width, scratch);
  const double* db = expanded(work, right, node.support, width, scratch + work.scratch.size() / 2);
  const double* a = work.values.data() + left.value;
  const double* b = work.values.data() + right.value;
  for (int i = 0; i <= std::min(left.order, node.order); ++i)
    for (int j = 0; j <= std::min(right.order, node.order - i); ++j) {
      double* __restrict row = out + (i + j) * width;
      const double* __restrict rb = db + j * width, * __restrict ra = da + i * width;
      const double ai = a[i], bj = b[j];
      for (int c = 0; c < width; ++c) row[c] += ai * rb[c] + bj * ra[c];
    }
}

void TaylorGraph::evaluate_tangents(Workspace& work) const {
  for (const Data& node : nodes_) {
    double* out = work.tangents.data() + node.tangent;
    const int width = node.stride;
    std::fill_n(out, (node.order + 1) * width, 0.0);
    switch (node.operation) {
      case Operation::input: {
        const RowMajor& tangents = inputs_[node.input].tangents;
        for (int k = 0; k <= node.order; ++k) std::copy_n(tangents.row(k).data(), tangents.cols(), out + k * width);
        break;
      }
      case Operation::linear:
        for (int t = node.first_term; t < node.end_term; ++t) {
          const Data& term = nodes_[terms_[t].node];
          const double* in = work.tangents.data() + term.tangent;
          const int rows = std::min(term.order, node.order) + 1;
          if (term.support == node.support) {
            add_row(out, in, terms_[t].factor, rows * width);
          } else {
            const std::vector<int>& places = placement(term.support, node.support);
            for (int k = 0; k < rows; ++k) add_placed(out + k * width, in + k * term.stride, terms_[t].factor, places);
          }
        }
        break;
      case Operation::product:
        evaluate_product_tangents(work, node);
        break;
      case Operation::sine:
      case Operation::cosine: {
        // dS_k = sum_m C_{k-m} dtheta_m,  dC_k = -sum_m S_{k-m} dtheta_m
        const Data& angle = nodes_[node.a];
        const double* in = work.tangents.data() + angle.tangent;
        const double* other = work.values.data() + nodes_[node.b].value;
        const double sign = node.operation == Operation::sine ? 1.0 : -1.0;
        for (int k = 0; k <= node.order; ++k)
          for (int m = 0; m <= std::min(angle.order, k); ++m)
            add_row(out + k * width, in + m * width, sign * other[k - m], width);
        break;
      }
      case Operation::derivative: {
        const Data& operand = nodes_[node.a];
        const double* in = work.tangents.data() + operand.tangent;
        for (int k = 0; k <= node.order && k + node.times <= operand.order; ++k)
          add_row(out + k * width, in + (k + node.times) * width, falling(k + node.times, node.times), width);
        break;
      }
      case Operation::integral: {
        const double* in = work.tangents.data() + nodes_[node.a].tangent;
        for (int k = 1; k <= node.order; ++k) add_row(out + k * width, in + (k - 1) * width, 1.0 / k, width);
        break;
      }
    }
  }
}

void TaylorGraph::clear_adjoints(Workspace& work) const { work.adjoints.assign(value_size_, 0.0); }

void TaylorGraph::reverse(Workspace& work) const {
  double* adjoints = work.adjoints.data();
  const double* values = work.values.data();
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) {
    const double* out = adjoints + node->value;
    double* a = node->a < 0 ? nullptr : adjoints + nodes_[node->a].value;
    const int order_a = node->a < 0 ? 0 : nodes_[node->a].order;
    switch (node->operation) {
      case Operation::input:
        break;
      case Operation::linear:
        for (int t = node->first_term; t < node->end_term; ++t) {
          const Data& term = nodes_[terms_[t].node];
          add_row(adjoints + term.value, out, terms_[t].factor, std::min(term.order, node->order) + 1);
        }
        break;
      case Operation::product: {
        const Data &left = nodes_[node->a], &right = nodes_[node->b];
        double* b = adjoints + right.value;
        for (int i = 0; i <= std::min(left.order, node->order); ++i)
          for (int j = 0; j <= std::min(right.order, node->order - i); ++j) {
            a[i] += out[i + j] * values[right.value + j];
            b[j] += out[i + j] * values[left.value + i];
          }
        break;
      }
      case Operation::sine:
      case Operation::cosine: {
        const double* other = values + nodes_[node->b].value;
        const double sign = node->operation == Operation::sine ? 1.0 : -1.0;
        for (int k = 0; k <= node->order; ++k)
          for (int m = 0; m <= std::min(order_a, k); ++m) a[m] += sign * out[k] * other[k - m];
        break;
      }
      case Operation::derivative:
        for (int k = 0; k <= node->order && k + node->times <= order_a; ++k)
          a[k + node->times] += falling(k + node->times, node->times) * out[k];
        break;
      case Operation::integral:
        for (int k = 1; k <= node->order; ++k) a[k - 1] += out[k] / k;
        break;
    }
  }
}

void TaylorGraph::hessian(Workspace& work, Eigen::Ref<Eigen::MatrixXd> H) const {
  reverse(work);
  const double* values = work.values.data();
  const double* adjoints = work.adjoints.data();
  work.left.setZero(left_rows_, parameters_);
  work.right.setZero(left_rows_, parameters_);
  for (const Data& node : nodes_) {
    if (node.left < 0) continue;
    const std::vector<int>& columns = supports_[node.support];
    const double* in = work.tangents.data() + node.tangent;
    for (int k = 0; k <= node.order; ++k)
      add_placed(work.left.row(node.left + k).data(), in + k * node.stride, 1.0, columns);
  }
  for (const Data& node : nodes_) {
    const double* w = adjoints + node.value;
    if (node.operation == Operation::product) {
      // sum_k w_k sum_{i+j=k} da_i db_j^T, and its transpose
      const Data &left = nodes_[node.a], &right = nodes_[node.b];
      const std::vector<int>& columns = supports_[right.support];
      const double* in = work.tangents.data() + right.tangent;
      for (int i = 0; i <= std::min(left.order, node.order); ++i) {
        double* row = work.scratch.data();
        std::fill_n(row, right.stride, 0.0);
        for (int j = 0; j <= std::min(right.order, node.order - i); ++j)
          add_row(row, in + j * right.stride, w[i + j], right.stride);
        add_placed(work.right.row(left.left + i).data(), row, 1.0, columns);
      }
    } else if (node.operation == Operation::sine) {
      // d2S_k / dtheta_i dtheta_j = -S_{k-i-j},  of C likewise
      const Data &angle = nodes_[node.a], &cosine = nodes_[node.b];
      const double *S = values + node.value, *C = values + cosine.value, *v = adjoints + cosine.value;
      const std::vector<int>& columns = supports_[angle.support];
      const double* in = work.tangents.data() + angle.tangent;
      for (int i = 0; i <= angle.order; ++i)
        for (int j = 0; j <= angle.order; ++j) {
          double weight = 0.0;
          for (int k = i + j; k <= node.order; ++k) weight -= w[k] * S[k - i - j] + v[k] * C[k - i - j];
          add_placed(work.right.row(angle.left + i).data(), in + j * angle.stride, 0.5 * weight, columns);
        }
    }
  }
  H.noalias() = work.left.transpose() * work.right;
  H = (H + H.transpose()).eval();
  for (const Data& node : nodes_) {
    if (node.operation != Operation::input) continue;
    const Input& input = inputs_[node.input];
    const std::vector<int>& columns = supports_[node.support];
    for (std::size_t k = 0; k < input.curvature.size(); ++k)
      for (std::size_t i = 0; i < columns.size(); ++i)
        for (std::size_t j = 0; j < columns.size(); ++j)
          H(columns[i], columns[j]) += adjoints[node.value + k] * input.curvature[k](i, j);
  }
}

}  // namespace mcplan::sip
