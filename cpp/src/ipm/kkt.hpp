#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "ipm/fronts.hpp"
#include "ipm/linear_system.hpp"
#include "ipm/unknowns.hpp"
#include "mcplan/nlp/problem.hpp"

namespace mcplan::ipm {

/// The linear system of a step of an nlp::Problem, factorised stage by stage.
class Kkt : public LinearSystem {
 public:
  Kkt(const nlp::Problem& problem, const Unknowns& unknowns);

  /// Jacobian in the order of problem.jacobian_structure(), Hessian in that of hessian_structure(). Not copied.
  void set_jacobian(const Eigen::VectorXd& values) override;
  void set_hessian(const Eigen::VectorXd& values) override { hessian_ = values.data(); }
  void set_weights(const Eigen::Ref<const Eigen::VectorXd>& slacks,
                   const Eigen::Ref<const Eigen::VectorXd>& bounds) override;
  Factor factor(double delta, double delta_c) override;
  double delta_c() const override { return delta_c_; }
  void solve(const Eigen::VectorXd& a, const Eigen::VectorXd& b, Eigen::VectorXd& dx, Eigen::VectorXd& lambda) override;
  void solve_roughly(const Solution& first_right, const Solution& second_right, Solution& first,
                     Solution& second) override;
  void refine(const Eigen::VectorXd& a, const Eigen::VectorXd& b, Eigen::VectorXd& dx,
              Eigen::VectorXd& lambda) override;
  void multiply_inequalities(const Eigen::VectorXd& x, Eigen::VectorXd& out) const override;
  void add_inequalities_transposed(const Eigen::VectorXd& y, Eigen::VectorXd& out) const override;
  void add_equalities_transposed(const Eigen::VectorXd& y, Eigen::VectorXd& out) const override;
  void multiply_equalities(const Eigen::VectorXd& x, Eigen::VectorXd& out) const;  ///< out = J_E x

  int largest_front() const { return fronts_->largest_front(); }
  double residual() const { return residual_; }  ///< of the last solve, over the right side's largest entry

 private:
  /// An entry of the Jacobian or the Hessian between unknowns.
  struct Term {
    int from = 0;             ///< place among the values
    int row = 0, column = 0;  ///< slack or equality, or the other variable; free variable
  };
  struct Place {
    int from = 0;  ///< among the values
    int to = 0;    ///< in the factorisation
  };
  /// The inequalities or the equalities of a piece: a dense matrix of the variables that they see, in dense_values_,
  /// row by row of `width` numbers, of which those beyond `columns` are zero.
  struct Dense {
    int rows = 0, columns = 0, width = 0;
    bool constant = false;
    std::vector<int> targets, variables;  ///< slacks or equalities, free variables
    struct Entry {
      int from = 0, to = 0;  ///< place in the Jacobian, and among the rows
    };
    std::vector<Entry> entries;
    int first_value = 0;  ///< in dense_values_
    int first_place = 0;  ///< of the lower triangle, column by column
  };

  std::vector<Fronts::Pair> structure();
  void set_order(bool sums_ahead);
  void assemble(double delta, double delta_c);
  void find_least_pivots();
  void find_most_negative(const std::vector<std::vector<int>>& order);
  static Dense dense_block(const nlp::Problem::Block& block, const std::vector<int>& target_of,
                           const Unknowns& unknowns, std::vector<int>& local);
  void add_condensed(const Dense& dense);
  void gather(const Dense& dense, const Eigen::VectorXd& x) const;  ///< what a piece sees, in gathered_
  void multiply(const Dense& dense, const Eigen::VectorXd& x, Eigen::VectorXd& out) const;
  void add_transposed(const Dense& dense, const Eigen::VectorXd& y, Eigen::VectorXd& out) const;
  void residual(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Eigen::VectorXd& dx,
                const Eigen::VectorXd& lambda);

  const nlp::Problem& problem_;
  const Unknowns& unknowns_;
  int n_, m_;
  std::vector<Term> hessian_terms_;
  std::vector<Place> hessian_places_, equality_places_;
  std::vector<Dense> dense_, dense_equalities_;
  std::vector<Term> sparse_equalities_;  ///< those in none of these
  std::vector<Fronts::Pair> pairs_;      ///< entries of the matrix
  std::optional<Fronts> fronts_;
  bool sums_ahead_ = false;         ///< until some of them say the same twice
  std::vector<int> most_negative_;  ///< pivots up to each front, if the inertia of all is to be right
  const double *jacobian_ = nullptr, *hessian_ = nullptr;
  Eigen::VectorXd slack_weights_, bound_weights_;
  Eigen::VectorXd dense_values_;
  bool jacobian_set_ = false;  ///< so that constant entries of dense_values_ are there
  double delta_ = 0.0, delta_c_ = 0.0, residual_ = 0.0;
  Eigen::MatrixXd block_, product_;
  Eigen::VectorXd weighted_;          ///< rows of a piece
  mutable Eigen::VectorXd gathered_;  ///< of the variables that a piece sees
  Eigen::VectorXd right_, other_right_, left_a_, left_b_, slacks_;
};

}  // namespace mcplan::ipm
