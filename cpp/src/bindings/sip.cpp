#include <pybind11/operators.h>

#include "bindings.hpp"
#include "mcplan/planar/sip/certificate.hpp"
#include "pickles.hpp"
#include "planar/sip/taylor_model.hpp"
#include "signals.hpp"

namespace mcplan::bindings {
namespace {

using sip::Certificate;
using sip::CertifyOptions;
using sip::Proof;
using sip::ProvedConstraint;
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
  c.def("range", &TaylorModel::range, "Bounds over [-1, 1].");
  c.def("at", &TaylorModel::at, py::arg("s"), "Bounds at one place.");
  c.def("__repr__", [](py::handle self) { return paste(self, "TaylorModel", {"coefficients", "order", "remainder"}); });
}

void bind_certificate(py::module_& m) {
  py::enum_<Proof>(m, "Proof", "What is known of a constraint.")
      .value("proved", Proof::proved, "Holds at every instant.")
      .value("not_proved", Proof::not_proved, "Neither proved nor violated at any point looked at.")
      .value("violated", Proof::violated, "Does not hold at the instant named.");
  py::class_<ProvedConstraint> c(m, "ProvedConstraint", "What certify() found out about one kind of constraint.");
  c.def_readonly("name", &ProvedConstraint::name, "As in the checker of planar plans.");
  c.def_readonly("proof", &ProvedConstraint::proof);
  c.def_readonly("bound", &ProvedConstraint::bound,
                 "Proved upper bound of the amount beyond the limit, over the whole motion, in `unit`.");
  c.def_readonly("reached", &ProvedConstraint::reached,
                 "Proved lower bound of its maximum; above the tolerance: violated.");
  c.def_readonly("tolerance", &ProvedConstraint::tolerance, "What was to be proved: bound <= tolerance.");
  c.def_readonly("unit", &ProvedConstraint::unit);
  c.def_readonly("phase", &ProvedConstraint::phase, "-1: nothing to prove.");
  c.def_readonly("where", &ProvedConstraint::where, "Joint, end-effector or point.");
  c.def_readonly("time_s", &ProvedConstraint::time_s,
                 "Where the bound is largest; of a violated constraint, where `reached` is.");
  c.def("__repr__", [](py::handle self) {
    return paste(self, "ProvedConstraint", {"name", "proof", "bound", "tolerance", "phase", "where", "time_s"});
  });
  def_pickle(c, &ProvedConstraint::name, &ProvedConstraint::proof, &ProvedConstraint::bound, &ProvedConstraint::reached,
             &ProvedConstraint::tolerance, &ProvedConstraint::unit, &ProvedConstraint::phase, &ProvedConstraint::where,
             &ProvedConstraint::time_s);

  py::class_<Certificate> certificate(m, "Certificate", "What is proved of a planar plan at every instant.");
  certificate.def_property_readonly("constraints", [](const Certificate& self) { return self.constraints; });
  certificate.def_readonly("subdivisions", &Certificate::subdivisions, "Pieces of time looked at.");
  certificate.def_readonly("rounding", &Certificate::rounding,
                           "Largest allowance for floating-point arithmetic in a bound, in shares of its tolerance.");
  certificate.def_readonly("time_s", &Certificate::time_s, "Wall clock [s].");
  certificate.def("proved", &Certificate::proved, "Whether every constraint is.");
  certificate.def("__str__", [](const Certificate& self) { return shown(self.to_string()); });
  certificate.def("__repr__", [](py::handle self) {
    return paste(self, "Certificate", {"constraints", "subdivisions", "rounding", "time_s"});
  });
  def_pickle(certificate, &Certificate::constraints, &Certificate::subdivisions, &Certificate::rounding,
             &Certificate::time_s);

  m.def(
      "certify",
      [](PlanarPlan plan, const PlanarTolerances& tolerances, int order, int max_depth, bool self_collision) {
        CertifyOptions options;
        options.tolerances = tolerances;
        options.order = order;
        options.max_depth = max_depth;
        options.self_collision = self_collision;
        options.stop = SignalWatch::stop;
        return interruptible([&] { return sip::certify(plan, options); });
      },
      py::arg("plan"), py::arg("tolerances") = PlanarTolerances(), py::arg("order") = CertifyOptions().order,
      py::arg("max_depth") = CertifyOptions().max_depth, py::arg("self_collision") = false,
      "Prove every inequality of a planar plan at every instant, with Taylor models of `order` (2 to 12) on "
      "intervals that are halved up to `max_depth` (0 to 40) times. Raises InvalidPlan, InvalidPlanarTask, "
      "InvalidRobot, "
      "InvalidOptions.");
}

}  // namespace

void bind_sip(py::module_& parent) {
  py::module_ m = parent.def_submodule("sip", "Whole-body semi-infinite planning of planar robots.");
  m.attr("Solver") = parent.attr("nlp").attr("Solver");  // beside the options that have it
  bind_taylor_model(m);
  bind_certificate(m);
  bind_sip_planner(m);
}

}  // namespace mcplan::bindings
