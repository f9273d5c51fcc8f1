#include <pybind11/operators.h>

#include "bindings.hpp"
#include "mcplan/sip/polynomial.hpp"
#include "mcplan/sip/taylor_model.hpp"

namespace mcplan::bindings {
namespace {

using sip::TaylorModel;
using sip::UncertainPolynomial;

/// Coefficients as a polynomial; InvalidInput where there are none or more than a model can have.
UncertainPolynomial polynomial_from(py::handle value, double error) {
  const Eigen::VectorXd a = vector_from(value, "coefficients");
  if (a.size() < 1 || a.size() > sip::max_order + 1)
    throw InvalidInput("coefficients", "must be 1.." + text(sip::max_order + 1) + " numbers",
                       text(static_cast<int>(a.size())));
  return {a, error};
}

std::pair<double, double> pair(const sip::Range& range) { return {range.min, range.max}; }

void bind_taylor_model(py::module_& m) {
  py::class_<TaylorModel> c(m, "TaylorModel",
                            "A function of s in [-1, 1] as a polynomial and a bound of what is left over:\n"
                            "|f(s) - sum_k coefficients[k] s^k| <= remainder. Arithmetic keeps the bound true, also "
                            "for floating-point rounding.");
  c.def(py::init([](py::handle coefficients, int order, double error) {
          return TaylorModel::of(order, polynomial_from(coefficients, error));
        }),
        py::arg("coefficients"), py::arg("order") = 8, py::arg("error") = 0.0,
        "From a polynomial (of s^0, s^1, ...). Powers beyond `order` (0 to 12) go into the remainder, and `error`, an "
        "amount that the function may differ by. Raises InvalidInput, InvalidOptions.");
  c.def_property_readonly("order", &TaylorModel::order);
  c.def_property_readonly("coefficients", [](const TaylorModel& f) { return Eigen::VectorXd(f.coefficients()); });
  c.def_property_readonly("truncation", &TaylorModel::truncation, "Part of the remainder: powers beyond the order.");
  c.def_property_readonly("rounding", &TaylorModel::rounding, "Part of the remainder: floating-point arithmetic.");
  c.def_property_readonly("remainder", &TaylorModel::remainder);
  c.def(py::self + py::self);
  c.def(py::self - py::self);
  c.def(py::self * py::self);
  c.def(-py::self);
  c.def("scaled", &TaylorModel::scaled, py::arg("factor"), py::arg("factor_error") = 0.0,
        "Times a constant that is within factor_error of factor.");
  c.def("integral", &TaylorModel::integral, "From 0 to s.");
  c.def("sine", [](const TaylorModel& f) { return f.sine_cosine().sine; });
  c.def("cosine", [](const TaylorModel& f) { return f.sine_cosine().cosine; });
  c.def(
      "range", [](const TaylorModel& f) { return pair(f.range()); }, "Bounds over [-1, 1].");
  c.def(
      "at", [](const TaylorModel& f, double s) { return pair(f.at(s)); }, py::arg("s"), "Bounds at one place.");
  c.def("__repr__", [](py::handle self) { return paste(self, "TaylorModel", {"coefficients", "order", "remainder"}); });
}

}  // namespace

void bind_sip(py::module_& parent) {
  py::module_ m = parent.def_submodule("sip", "Whole-body semi-infinite planning of planar robots.");
  bind_taylor_model(m);
}

}  // namespace mcplan::bindings
