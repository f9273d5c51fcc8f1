#pragma once

#include <Eigen/Core>
#include <string>

#include "ipm/oracle.hpp"
#include "ipm/unknowns.hpp"
#include "mcplan/wb/solver.hpp"
#include "wb/products.hpp"

namespace mcplan::wb {

/// Bounds of unknowns and rows.
ipm::Unknowns unknowns_of(const Problem& problem, const Layout& layout);

/// Rows and costs of a whole-body motion as the barrier method asks for them; the Jacobian stays in the assembly.
class Oracle : public ipm::Oracle {
 public:
  Oracle(const Problem& problem, const Layout& layout, Assembly& assembly, Products& products,
         const ipm::Unknowns& unknowns, const Options& options, const Deadline& deadline);

  void evaluate(ipm::Point& point) override;
  void derivatives(const ipm::Point& point, Eigen::VectorXd& gradient, ipm::LinearSystem& system) override;
  const Eigen::VectorXd& hessian(const ipm::Point&, double, const Eigen::VectorXd&, const Eigen::VectorXd&) override {
    return no_hessian_;
  }
  void gauss_newton_hessian(const ipm::Point&, Eigen::VectorXd&) override {}
  double violation(const ipm::Point& point) const override;
  void begin_iteration() override;
  int iterations() const override { return iterations_; }
  const Deadline& deadline() const override { return deadline_; }

  double evaluation_s() const { return evaluation_s_; }

  /// The point that violates least, and of those within the tolerance the cheapest.
  const Eigen::VectorXd& best_x() const { return best_x_; }

 private:
  void assemble(const Eigen::VectorXd& t, bool derivatives);

  const Problem& problem_;
  const Layout& layout_;
  Assembly& assembly_;
  Products& products_;
  const ipm::Unknowns& unknowns_;
  const Options& options_;
  const Deadline& deadline_;
  std::vector<NodeVector> vectors_;
  Eigen::VectorXd x_, best_x_, no_hessian_;
  double best_violation_, best_cost_, evaluation_s_ = 0.0;
  int iterations_ = 0;
};

}  // namespace mcplan::wb
