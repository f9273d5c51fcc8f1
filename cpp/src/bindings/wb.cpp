#include <pybind11/functional.h>

#include <limits>
#include <optional>

#include "bindings.hpp"
#include "mcplan/nlp/solver.hpp"
#include "mcplan/wb/solver.hpp"
#include "signals.hpp"

namespace mcplan::bindings {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using wb::Dynamics;

/// A view of rows that a solver keeps; (rows / block, block, columns) where a block of several belongs together.
py::array view(Dynamics::Rows& rows, int block, const py::object& owner) {
  const auto columns = static_cast<py::ssize_t>(rows.cols()), count = static_cast<py::ssize_t>(rows.rows());
  const py::ssize_t number = sizeof(double);
  if (block == 0) return py::array_t<double>({count, columns}, {columns * number, number}, rows.data(), owner);
  return py::array_t<double>({count / block, py::ssize_t{block}, columns},
                             {block * columns * number, columns * number, number}, rows.data(), owner);
}

/// Dynamics written in Python. A Ctrl-C in there is kept for the solve around it, which ends at its next question.
Dynamics::Callback calling(const py::function& function) {
  return [function](bool derivatives) {
    const py::gil_scoped_acquire acquire;
    try {
      function(derivatives);
    } catch (py::error_already_set& error) {
      if (error.matches(PyExc_KeyboardInterrupt) && SignalWatch::keep(error)) return;
      throw;
    }
  };
}

wb::Node& last_node(wb::Problem& problem) {
  if (problem.nodes.empty()) throw InvalidInput("nodes", "must begin with add_node()", "none");
  return problem.nodes.back();
}

Eigen::Matrix3Xd columns(const py::object& points) {
  const std::vector<Vector3d> given = points_from(points, "points_S");
  Eigen::Matrix3Xd out(3, given.size());
  for (std::size_t i = 0; i < given.size(); ++i) out.col(static_cast<Eigen::Index>(i)) = given[i];
  return out;
}

void bind_weights(py::module_& m) {
  py::class_<wb::Weights> weights(m, "Weights", "Of the cost of a motion; docs/theory/wb.md says what each is.");
  weights.def(py::init<>())
      .def_readwrite("rate", &wb::Weights::rate)
      .def_readwrite("com", &wb::Weights::com)
      .def_readwrite("base", &wb::Weights::base)
      .def_readwrite("swing", &wb::Weights::swing)
      .def_readwrite("swing_rotation", &wb::Weights::swing_rotation)
      .def_readwrite("posture", &wb::Weights::posture)
      .def_readwrite("velocity", &wb::Weights::velocity)
      .def_readwrite("acceleration", &wb::Weights::acceleration)
      .def_readwrite("torque", &wb::Weights::torque)
      .def_readwrite("wrench", &wb::Weights::wrench)
      .def_readwrite("force", &wb::Weights::force)
      .def_readwrite("elastic", &wb::Weights::elastic);
}

void bind_rows(py::class_<wb::Problem>& c) {
  c.def(
      "add_node",
      [](wb::Problem& self, double time_s, const Vector3d& com_W, const Vector3d& base_zyx, double acceleration,
         double torque) {
        self.nodes.push_back({time_s, com_W, base_zyx, {}, {}, acceleration, torque});
      },
      py::arg("time_s"), py::arg("com_W"), py::arg("base_zyx"), py::arg("acceleration") = 1.0, py::arg("torque") = 1.0,
      "acceleration, torque: of their weights.");
  c.def(
      "add_contact",
      [](wb::Problem& self, int end_effector, bool carries, bool rests, double friction, const Vector3d& position_W,
         const Matrix3d& rotation_W, const Eigen::Matrix<double, 6, 1>& wrench_S, const py::object& points,
         double load_max) {
        last_node(self).contacts.push_back(
            {end_effector, carries, rests, friction, position_W, rotation_W, wrench_S, columns(points), load_max});
      },
      py::arg("end_effector"), py::arg("carries"), py::arg("rests"), py::arg("friction"), py::arg("position_W"),
      py::arg("rotation_W"), py::arg("wrench_S"), py::arg("points_S"),
      py::arg("load_max") = std::numeric_limits<double>::infinity(), "To the node that was added last.");
  c.def(
      "add_swing",
      [](wb::Problem& self, int end_effector, const Vector3d& position_W, const Matrix3d& rotation_W, double weight,
         bool in_tube, const Vector3d& tube_min_W, const Vector3d& tube_max_W) {
        last_node(self).swings.push_back(
            {end_effector, position_W, rotation_W, weight, in_tube, tube_min_W, tube_max_W});
      },
      py::arg("end_effector"), py::arg("position_W"), py::arg("rotation_W"), py::arg("weight"), py::arg("in_tube"),
      py::arg("tube_min_W"), py::arg("tube_max_W"), "To the node that was added last.");
  c.def(
      "add_capsule",
      [](wb::Problem& self, int link, const Vector3d& start, const Vector3d& end, double radius) {
        self.capsules.push_back({link, start, end, radius});
        return self.capsules.size() - 1;
      },
      py::arg("link"), py::arg("start"), py::arg("end"), py::arg("radius"));
  c.def(
      "add_pair",
      [](wb::Problem& self, int first, int second, double distance_min) {
        self.pairs.push_back({first, second, distance_min});
      },
      py::arg("first"), py::arg("second"), py::arg("distance_min"));
}

void bind_problem(py::module_& m) {
  py::class_<wb::Problem> c(m, "Problem", "What mcplan.wb hands to the solver: links, nodes, limits, weights.");
  c.def(py::init<>())
      .def_readwrite("posture", &wb::Problem::posture)
      .def_readwrite("weight_N", &wb::Problem::weight_N)
      .def_readwrite("limit_ratio", &wb::Problem::limit_ratio)
      .def_readwrite("position_margin", &wb::Problem::position_margin)
      .def_readwrite("point_load_min", &wb::Problem::point_load_min)
      .def_readwrite("weights", &wb::Problem::weights);
  c.def(
      "add_link",
      [](wb::Problem& self, std::string joint, int parent, bool prismatic, const Vector3d& axis,
         const Matrix3d& rotation, const Vector3d& position, double mass, const Vector3d& center_of_mass,
         const Eigen::Vector4d& limits) {
        self.links.push_back({std::move(joint), parent, prismatic, axis, rotation, position, mass, center_of_mass,
                              limits[0], limits[1], limits[2], limits[3]});
      },
      py::arg("joint"), py::arg("parent"), py::arg("prismatic"), py::arg("axis"), py::arg("rotation"),
      py::arg("position"), py::arg("mass"), py::arg("center_of_mass"), py::arg("limits"),
      "limits: position_min, position_max, velocity_max, torque_max.");
  c.def(
      "add_end_effector",
      [](wb::Problem& self, std::string name, int link, const Matrix3d& rotation, const Vector3d& position,
         const py::object& points) {
        self.end_effectors.push_back({std::move(name), link, rotation, position, columns(points)});
      },
      py::arg("name"), py::arg("link"), py::arg("rotation"), py::arg("position"), py::arg("points_S"));
  bind_rows(c);
}

wb::Solution solve(wb::Solver& self, const VectorXd& start, int max_iterations, double time_limit_s,
                   double constraint_tolerance, double cost_tolerance, double tolerance, double initial_barrier,
                   const std::optional<std::function<void(std::string)>>& log) {
  wb::Options options;
  options.max_iterations = max_iterations;
  options.time_limit_s = time_limit_s;
  options.constraint_tolerance = constraint_tolerance;
  options.cost_tolerance = cost_tolerance;
  options.tolerance = tolerance;
  options.initial_barrier = initial_barrier;
  if (log) options.logger = [&log](LogLevel, const std::string& line) { (*log)(line); };
  const Alone alone(&self, "solve");
  return interruptible([&] { return self.solve(start, watched(options)); });
}

void bind_solver(py::module_& m) {
  py::class_<wb::Solution>(m, "Solution", "How a motion was solved for.")
      .def_property_readonly("status", [](const wb::Solution& s) { return nlp::status_of(s.outcome); })
      .def_property_readonly("message", [](const wb::Solution& s) { return s.message; })
      .def_property_readonly("x", [](const wb::Solution& s) { return s.x; })
      .def_property_readonly("cost", [](const wb::Solution& s) { return s.cost; })
      .def_property_readonly("penalty", [](const wb::Solution& s) { return s.penalty; })
      .def_property_readonly("violation", [](const wb::Solution& s) { return s.violation; })
      .def_property_readonly("iterations", [](const wb::Solution& s) { return s.iterations; })
      .def_property_readonly("time_s", [](const wb::Solution& s) { return s.time_s; })
      .def_property_readonly("evaluation_s", [](const wb::Solution& s) { return s.evaluation_s; })
      .def_property_readonly("linear_solver_s", [](const wb::Solution& s) { return s.linear_solver_s; });
  py::class_<wb::Solver> c(m, "Solver", "A motion problem with dynamics from Python.");
  c.def(py::init([](const wb::Problem& problem, const py::function& dynamics) {
          return std::make_unique<wb::Solver>(problem, calling(dynamics));
        }),
        py::arg("problem"), py::arg("dynamics"),
        "dynamics(derivatives) reads q, v, a, wrenches_S and fills tau, and dq, dv, da where derivatives is true.");
  const auto array = [&c](const char* name, Dynamics::Rows Dynamics::*member, bool blocks) {
    c.def_property_readonly(name, [member, blocks](const py::object& self) {
      auto& solver = self.cast<wb::Solver&>();
      return view(solver.dynamics().*member, blocks ? solver.problem().velocity_count() : 0, self);
    });
  };
  array("q", &Dynamics::q, false);
  array("v", &Dynamics::v, false);
  array("a", &Dynamics::a, false);
  array("wrenches_S", &Dynamics::wrenches_S, false);
  array("tau", &Dynamics::tau, false);
  array("dq", &Dynamics::dq, true);
  array("dv", &Dynamics::dv, true);
  array("da", &Dynamics::da, true);
  c.def_property_readonly("variables", &wb::Solver::variables)
      .def_property_readonly("equalities", &wb::Solver::equalities)
      .def_property_readonly("rows", &wb::Solver::rows);
  c.def("unknowns", &wb::Solver::unknowns, py::arg("coefficients"), py::arg("forces_S"));
  c.def("coefficients", &wb::Solver::coefficients, py::arg("x"));
  c.def("forces", &wb::Solver::forces, py::arg("x"), "(n, 3 p) at the points of all end-effectors [N].");
  c.def("usage", &wb::Solver::usage, py::arg("x"),
        "(n, rows) positions beyond their limits, velocities and torques over theirs, distances beyond theirs [m].");
  c.def(
      "values",
      [](wb::Solver& self, const VectorXd& x) {
        const wb::Solver::Values out = self.values(x);
        return py::make_tuple(out.cost, out.equalities, out.inequalities);
      },
      py::arg("x"), "Cost, equalities, inequalities.");
  c.def(
      "slopes",
      [](wb::Solver& self, const VectorXd& x, const VectorXd& step) {
        const wb::Solver::Slopes out = self.slopes(x, step);
        return py::make_tuple(out.cost, out.equalities, out.inequalities);
      },
      py::arg("x"), py::arg("step"), "Derivatives of the same along a step.");
  c.def("solve", &solve, py::kw_only(), py::arg("start"), py::arg("max_iterations"), py::arg("time_limit_s"),
        py::arg("constraint_tolerance"), py::arg("cost_tolerance"), py::arg("tolerance"), py::arg("initial_barrier"),
        py::arg("log"), "Releases the GIL. `log` gets each line of the iteration table; None: nobody.");
}

}  // namespace

void bind_wb(py::module_& parent) {
  py::module_ m = parent.def_submodule("wb", "Whole-body motions in space: the solver behind mcplan.motion.");
  bind_weights(m);
  bind_problem(m);
  bind_solver(m);
}

}  // namespace mcplan::bindings
