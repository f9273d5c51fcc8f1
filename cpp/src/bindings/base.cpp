#include "base/entire_functions.hpp"
#include "bindings.hpp"
#include "mcplan/base/logging.hpp"
#include "mcplan/base/rotation.hpp"
#include "mcplan/base/status.hpp"

namespace mcplan::bindings {
namespace {

void bind_status(py::module_& m) {
  py::enum_<Status> status(m, "Status",
                           "How a solve ended. `solved` is set after the independent checker has accepted the plan.");
  for (Status value : {Status::solved, Status::acceptable, Status::infeasible, Status::no_sequence,
                       Status::iteration_limit, Status::time_limit, Status::interrupted, Status::numerical_failure})
    status.value(std::string(to_string(value)).c_str(), value);
  status.def(
      "__str__", [](Status value) { return std::string(to_string(value)); }, py::prepend());

  py::enum_<LogLevel>(m, "LogLevel", "Importance of a line given to a logger.")
      .value("debug", LogLevel::debug)
      .value("info", LogLevel::info)
      .value("warning", LogLevel::warning);
}

void require_order(int n, int last) {
  if (n < 0 || n > last) throw InvalidInput("n", "must lie in [0, " + text(last) + "]", text(n));
}

void bind_entire_functions(py::module_& m) {
  py::class_<EntireFunctions>(m, "EntireFunctions",
                              "F_n(z) = sum_i z^i / (2i + n)!, z = stiffness [1/s^2] x duration^2 [s^2]: a linear "
                              "pendulum from flight (z = 0) to stiff contact in one formula.")
      .def(py::init<double>(), py::arg("z"))
      .def(
          "__call__", [](const EntireFunctions& f, int n) { return require_order(n, 4), f(n); }, py::arg("n"),
          "F_n(z) [-], n = 0..4.")
      .def(
          "derivative", [](const EntireFunctions& f, int n) { return require_order(n, 2), f.derivative(n); },
          py::arg("n"), "dF_n/dz, n = 0..2.");
}

}  // namespace

void bind_base(py::module_& m) {
  bind_status(m);
  bind_entire_functions(m);
  m.def("rotation_from_rpy", &rotation_from_rpy, py::arg("rpy"),
        "R_WB = Rz(yaw) Ry(pitch) Rx(roll), angles in [rad]; 3 x 3.");
  m.def(
      "rotation_derivative",
      [](const Eigen::Vector3d& rpy, int i) { return require_order(i, 2), rotation_derivative(rpy, i); },
      py::arg("rpy"), py::arg("i"), "dR_WB/d(rpy[i]), i = 0 (roll), 1 (pitch), 2 (yaw); 3 x 3.");
  m.def("quat_wxyz_from_rpy", &quat_wxyz_from_rpy, py::arg("rpy"), "Unit quaternion (w, x, y, z) of R_WB, w >= 0.");
}

}  // namespace mcplan::bindings
