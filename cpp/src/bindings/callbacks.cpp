#include "callbacks.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "signals.hpp"

namespace mcplan::bindings {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using nlp::ConstVector;
using nlp::Matrix;
using nlp::Vector;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string shape_of(const py::array& array) {
  std::string out;
  for (py::ssize_t i = 0; i < array.ndim(); ++i) out += (i > 0 ? " x " : "") + std::to_string(array.shape(i));
  return array.ndim() == 0 ? "one number" : "shape " + out;
}

/// Whether an array is rows x columns, where a side of one may be left out.
bool fits(const py::array& array, int rows, int columns) {
  switch (array.ndim()) {
    case 0:
      return rows == 1 && columns == 1;
    case 1:
      return (rows == 1 || columns == 1) && array.shape(0) == static_cast<py::ssize_t>(rows) * columns;
    case 2:
      return array.shape(0) == rows && array.shape(1) == columns;
    default:
      return false;
  }
}

/// What a function returned, as rows x columns numbers; InvalidInput otherwise.
void copy_numbers(const std::string& field, const py::object& returned, int rows, int columns, Matrix out) {
  const std::string rule = columns == 1 && rows == 1 ? "must return a number"
                           : columns == 1
                               ? "must return " + text(rows) + " numbers"
                               : "must return an array of " + text(rows) + " x " + text(columns) + " numbers";
  const auto array = py::array::ensure(returned);
  if (!array || std::string("fiub").find(array.dtype().kind()) == std::string::npos)
    throw InvalidInput(field, rule, returned.is_none() ? "None" : py::str(py::type::of(returned).attr("__name__")));
  if (!fits(array, rows, columns)) throw InvalidInput(field, rule, shape_of(array));
  const auto numbers = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(array);
  out = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(numbers.data(), rows,
                                                                                                 columns);
}

/// An array of its own, so that whoever keeps or changes it changes nothing of ours.
py::array_t<double> array_of(const double* begin, int size) { return py::array_t<double>(size, begin); }

/// One array for each entry of a block's variables, and what is added behind them.
py::tuple arguments(const std::vector<int>& sizes, const ConstVector& v, const ConstVector* weights) {
  py::tuple out(sizes.size() + (weights ? 1 : 0));
  int at = 0;
  for (std::size_t i = 0; i < sizes.size(); at += sizes[i++]) out[i] = array_of(v.data() + at, sizes[i]);
  if (weights) out[sizes.size()] = array_of(weights->data(), static_cast<int>(weights->size()));
  return out;
}

/// Calls a function of a block and copies what it returns.
void ask(const Callbacks& all, const char* name, const py::object& function, const ConstVector& v,
         const ConstVector* weights, int columns, Matrix out) {
  const py::gil_scoped_acquire acquire;
  try {
    const py::object returned = function(*arguments(all.sizes, v, weights));
    copy_numbers(all.where + ": " + name, returned, static_cast<int>(out.rows()), columns, out);
  } catch (py::error_already_set& error) {
    if (error.matches(PyExc_KeyboardInterrupt) && SignalWatch::keep(error)) {
      out.setConstant(kNan);  // ends the solve, which returns its best point
      return;
    }
    if (py::hasattr(error.value(), "add_note"))  // from Python 3.11 on
      error.value().attr("add_note")("raised by '" + std::string(name) + "' of " + all.where);
    throw;
  }
}

}  // namespace

int Callbacks::size() const { return std::accumulate(sizes.begin(), sizes.end(), 0); }

void Callbacks::values(const ConstVector& v, Vector f) const { ask(*this, "value", value, v, nullptr, 1, f); }

void Callbacks::jacobians(const ConstVector& v, Matrix J) const {
  ask(*this, "jacobian", jacobian, v, nullptr, size(), J);
}

void Callbacks::hessians(const ConstVector& v, const ConstVector& weights, Matrix H) const {
  ask(*this, "hessian", hessian, v, &weights, size(), H);
}

CallbackPiece::CallbackPiece(std::string name, std::vector<int> variables, std::shared_ptr<const Callbacks> callbacks,
                             std::shared_ptr<const bool> ready)
    : Piece(std::move(name), std::move(variables), callbacks->rows),
      callbacks_(std::move(callbacks)),
      ready_(std::move(ready)) {}

void CallbackPiece::values(const ConstVector& v, Vector f) const { callbacks_->values(v, f); }

void CallbackPiece::jacobian(const ConstVector& v, Matrix J) const {
  if (*ready_) callbacks_->jacobians(v, J);
}

void CallbackPiece::hessian(const ConstVector& v, const ConstVector& weights, Matrix H) const {
  if (*ready_ && !callbacks_->hessian.is_none()) callbacks_->hessians(v, weights, H);
}

LeastSquaresPiece::LeastSquaresPiece(std::string name, std::vector<int> variables,
                                     std::shared_ptr<const Callbacks> residuals, VectorXd weights,
                                     std::shared_ptr<const bool> ready)
    : Piece(std::move(name), std::move(variables), 1),
      residuals_(std::move(residuals)),
      weights_(std::move(weights)),
      ready_(std::move(ready)) {}

VectorXd LeastSquaresPiece::residuals(const ConstVector& v) const {
  VectorXd r(weights_.size());
  residuals_->values(v, r);
  return r;
}

MatrixXd LeastSquaresPiece::residual_jacobian(const ConstVector& v) const {
  MatrixXd J(weights_.size(), v.size());
  residuals_->jacobians(v, J);
  return J;
}

void LeastSquaresPiece::values(const ConstVector& v, Vector f) const {
  f[0] = 0.5 * weights_.dot(residuals(v).cwiseAbs2());
}

void LeastSquaresPiece::jacobian(const ConstVector& v, Matrix J) const {
  if (*ready_) J = (weights_.cwiseProduct(residuals(v))).transpose() * residual_jacobian(v);
}

void LeastSquaresPiece::hessian(const ConstVector& v, const ConstVector& weights, Matrix H) const {
  if (!*ready_) return;
  MatrixXd curvature = MatrixXd::Zero(size(), size());
  if (!residuals_->hessian.is_none())
    residuals_->hessians(v, weights[0] * weights_.cwiseProduct(residuals(v)), curvature);
  gauss_newton_hessian(v, weights, H);
  H += curvature;
}

void LeastSquaresPiece::gauss_newton_hessian(const ConstVector& v, const ConstVector& weights, Matrix H) const {
  if (!*ready_) return;
  const MatrixXd J = residual_jacobian(v);
  H = weights[0] * (J.transpose() * weights_.asDiagonal() * J);
}

QuadraticPiece::QuadraticPiece(std::string name, std::vector<int> variables, MatrixXd H, VectorXd g, double c)
    : Piece(std::move(name), std::move(variables), 1), H_(std::move(H)), g_(std::move(g)), c_(c) {}

void QuadraticPiece::values(const ConstVector& v, Vector f) const { f[0] = v.dot(0.5 * (H_ * v) + g_) + c_; }

void QuadraticPiece::jacobian(const ConstVector& v, Matrix J) const { J = (H_ * v + g_).transpose(); }

void QuadraticPiece::hessian(const ConstVector&, const ConstVector& weights, Matrix H) const { H = weights[0] * H_; }

}  // namespace mcplan::bindings
