#include <pybind11/functional.h>

#include "ddp/cost_terms.hpp"
#include "ddp/options_fields.hpp"
#include "fields.hpp"
#include "mcplan/ddp/plan.hpp"
#include "mcplan/ddp/switched_ddp.hpp"
#include "signals.hpp"

namespace mcplan::bindings {
namespace {

using ddp::Method;
using ddp::Model;
using ddp::Polish;
using ddp::StiffnessInput;
using ddp::SwitchedDdp;
using ddp::Weights;

void bind_weights(py::module_& m) {
  py::class_<Weights> c = bind_fields<Weights>(m);
  for (const ddp::CostTerm* term : ddp::cost_terms())
    if (term->has_own_weight())
      c.def_property(
          term->name(), [term](const Weights& self) { return term->weight(self); },
          [term](Weights& self, double weight) { self.own[term->name()] = weight; }, term->own_weight().meaning);
}

void bind_ddp_options(py::module_& m) {
  bind_enum<Method>(m);
  bind_enum<Model>(m);
  bind_enum<StiffnessInput>(m);
  bind_enum<Polish>(m);
  bind_weights(m);
  bind_fields<ddp::Options>(m).def("validate", &ddp::Options::validate,
                                   "Raise InvalidOptions naming all that is out of its range.");
}

}  // namespace

void bind_ddp(py::module_& parent) {
  py::module_ m = parent.def_submodule("ddp", "Contact-sequence search by switched differential dynamic programming.");
  bind_ddp_options(m);
  m.attr("Result") = parent.attr("PlanResult");
  m.def(
      "on_joined_ground", &ddp::on_joined_ground, py::arg("plan"),
      "The same plan on ground that is whole, as plan() searches it: surfaces in one plane that touch, and make a "
      "convex one together, are one, with the name of the first. Replans keep soles within surfaces; on this they may "
      "cross seams. Raises InvalidPlan, InvalidScene.");
  py::class_<SwitchedDdp> c(
      m, "SwitchedDdp",
      "Contact-sequence search for one scene and robot. Solves release the GIL; Ctrl-C ends them, and "
      "Interrupted carries the best plan so far.");
  c.def(py::init([](const Scene& scene, const Robot& robot, const ddp::Options& options) {
          return SwitchedDdp(scene, robot, watched(options));
        }),
        py::arg("scene"), py::arg("robot"), py::arg_v("options", ddp::Options(), "Options()"));
  c.def(
      "solve", [](SwitchedDdp& self) { return interruptible([&] { return self.solve(); }); },
      "Plan from the scene's start to its goal.");
  c.def(
      "solve", [](SwitchedDdp& self, Plan plan) { return interruptible([&] { return self.solve(plan); }); },
      py::arg("warm_start"), "The same, starting from an earlier plan's contact sequence, motion and timing.");
  c.def(
      "replan",
      [](SwitchedDdp& self, Plan previous, double t, Knot measured) {
        return interruptible([&] { return self.replan(previous, t, measured); });
      },
      py::arg("previous"), py::arg("t"), py::arg("measured"),
      "Plan on from a measured state at time t [s] of an earlier plan.");
  bind_ddp_replan(m);
}

}  // namespace mcplan::bindings
