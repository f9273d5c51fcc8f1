#include "bindings.hpp"
#include "fields.hpp"
#include "ipm/names.hpp"
#include "mcplan/nlp/solver.hpp"

namespace mcplan::bindings {

void bind_nlp(py::module_& parent) {
  py::module_ m = parent.def_submodule("nlp", "Sparse nonlinear programs; their pieces are written in C++.");
  bind_enum<nlp::Solver>(m);
  m.def("ipopt_version", &nlp::ipopt_version, "Version of Ipopt that the module is compiled for, such as '3.11.9'.");
}

}  // namespace mcplan::bindings
