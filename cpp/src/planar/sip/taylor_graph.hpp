#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace mcplan::sip {

/// Taylor polynomials of one time interval about its middle, and their derivatives with respect to the interval's local
/// parameters, as a graph of operations that is built once and evaluated many times.
///
/// A node is a polynomial a_0 + a_1 s + ... + a_n s^n, s = -1..1. Operations keep coefficients up to the order asked
/// for; those that they keep are exact (a coefficient of a product, a sine or a derivative depends on lower ones
/// alone).
///
/// Derivatives: forward mode gives the tangents da_k/dx of every coefficient (evaluate, `tangents`). Second derivatives
/// of a weighted sum of coefficients follow from one reverse sweep for the adjoints and from the tangents: for nodes
/// v_i = phi_i(v_j, ...) with adjoints w_i,
///
///     d2/dx2 = sum_i w_i d2 phi_i / dv_j dv_k  (dv_j/dx) (dv_k/dx)^T,
///
/// a rank-one term for each coefficient of each product; linear operations give nothing.
class TaylorGraph {
 public:
  using Node = int;
  struct Term {
    double factor;
    Node node;
  };

  /// Largest order of a node: 12, and 2 for the derivatives in s.
  static constexpr int kMaxOrder = 14;

  explicit TaylorGraph(int parameters) : parameters_(parameters) {}

  /// A polynomial given from outside as a function of the parameters `columns` (input_of).
  Node input(int order, std::vector<int> columns);
  Node constant(double value) { return linear({}, value); }
  /// constant + sum_i factor_i node_i, truncated at `order` (-1: the largest of its terms)
  Node linear(const std::vector<Term>& terms, double constant = 0.0, int order = -1);
  Node product(Node a, Node b, int order);  ///< truncated at order, or exact where the degrees add to less
  std::pair<Node, Node> sin_cos(Node angle, int order);
  Node derivative(Node a, int times = 1);  ///< with respect to s
  Node integral(Node a, int order);        ///< with respect to s, zero at s = 0; truncated at order

  int order(Node node) const { return nodes_[node].order; }
  const std::vector<int>& columns(Node node) const { return supports_[nodes_[node].support]; }
  int parameters() const { return parameters_; }
  int size() const { return static_cast<int>(nodes_.size()); }

  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// Buffers of an evaluation; graphs that are evaluated one after the other may share one.
  struct Workspace {
    std::vector<double> values, adjoints, tangents, scratch;
    RowMajor left, right;  ///< factors of the Hessian: H = left' right + right' left
  };

  /// What an input is at the moment: its coefficients, their derivatives (in the order of columns(node), ascending)
  /// and, for Hessians, second derivatives: a matrix for each coefficient, or none where they are zero.
  struct Input {
    Eigen::VectorXd coefficients;
    RowMajor tangents;
    std::vector<Eigen::MatrixXd> curvature;
  };
  Input& input_of(Node node) { return inputs_[nodes_[node].input]; }

  /// All coefficients; with `tangents` their derivatives too.
  void evaluate(Workspace& work, bool tangents) const;

  /// Coefficients of a node, after evaluate().
  Eigen::Map<const Eigen::VectorXd> coefficients(const Workspace& work, Node node) const {
    return {work.values.data() + nodes_[node].value, nodes_[node].order + 1};
  }
  /// Their derivatives: (order + 1) x columns(node), after evaluate(work, true).
  Eigen::Map<const RowMajor, 0, Eigen::OuterStride<>> tangents(const Workspace& work, Node node) const {
    const Data& n = nodes_[node];
    return {work.tangents.data() + n.tangent, n.order + 1, static_cast<int>(supports_[n.support].size()),
            Eigen::OuterStride<>(n.stride)};
  }

  /// Adjoints to be filled before hessian(): of a weighted sum over coefficients of any nodes.
  void clear_adjoints(Workspace& work) const;
  Eigen::Map<Eigen::VectorXd> adjoints(Workspace& work, Node node) const {
    return {work.adjoints.data() + nodes_[node].value, nodes_[node].order + 1};
  }

  /// H (parameters x parameters, both triangles) of the weighted sum, after evaluate(work, true). Destroys adjoints.
  void hessian(Workspace& work, Eigen::Ref<Eigen::MatrixXd> H) const;

 private:
  enum class Operation { input, linear, product, sine, cosine, derivative, integral };
  struct Data {
    Operation operation = Operation::input;
    int order = 0, support = 0;
    int value = 0;                ///< place of its coefficients
    int tangent = 0, stride = 0;  ///< place of its tangents, row by row, padded to whole vectors
    Node a = -1, b = -1;          ///< operands; of a sine its cosine is b and the other way round
    int times = 0;                ///< of a derivative
    double constant = 0.0;        ///< of a linear combination
    int first_term = 0, end_term = 0;
    int left = -1;  ///< first row of its tangents in the Hessian's left factor, where it is a product's a
    int input = -1;
  };
  Node add(Data node, std::vector<int> columns);
  int support_of(std::vector<int> columns);
  const std::vector<int>& placement(int from, int to) const;  ///< empty: the same
  void evaluate_values(Workspace& work) const;
  void evaluate_tangents(Workspace& work) const;
  void evaluate_product_tangents(Workspace& work, const Data& node) const;
  void reverse(Workspace& work) const;
  const double* expanded(const Workspace& work, const Data& operand, int support, int stride, double* scratch) const;

  int parameters_;
  std::vector<Data> nodes_;
  std::vector<Term> terms_;
  std::vector<Input> inputs_;
  std::vector<std::vector<int>> supports_;
  mutable std::vector<std::vector<std::vector<int>>> placements_;
  int value_size_ = 0, tangent_size_ = 0, left_rows_ = 0;
};

}  // namespace mcplan::sip
