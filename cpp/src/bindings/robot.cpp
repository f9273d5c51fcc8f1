#include "mcplan/robot/robot.hpp"

#include "fields.hpp"
#include "mcplan/robot/standing.hpp"
#include "robot/robot_fields.hpp"

namespace mcplan::bindings {
namespace {

/// Values are set once, so that nobody changes a copy: A and b read as arrays that cannot be written.
void bind_polytope(py::module_& m) {
  const auto fixed = [](const auto& matrix) {
    py::array out = py::cast(matrix);
    out.attr("setflags")(py::arg("write") = false);
    return out;
  };
  py::class_<Polytope> c(m, "Polytope",
                         "Convex set {x : A x <= b} [m], rows of A of unit length. Without rows: not given.");
  c.def(py::init([](const py::object& a, const py::object& b) {
          const auto rows = points_from(a, "A");
          Polytope out;
          out.A.resize(static_cast<Eigen::Index>(rows.size()), 3);
          for (std::size_t i = 0; i < rows.size(); ++i) out.A.row(static_cast<Eigen::Index>(i)) = rows[i];
          out.b = vector_from(b, "b");
          return out;
        }),
        py::kw_only(), py::arg("A") = py::tuple(), py::arg("b") = py::tuple());
  c.def_property_readonly(
      "A", [fixed](const Polytope& self) { return fixed(self.A); }, "N x 3, rows of unit length.");
  c.def_property_readonly(
      "b", [fixed](const Polytope& self) { return fixed(self.b); }, "N [m].");
  c.def_property_readonly("given", &Polytope::given, "Whether it has rows.");
  def_value(c, "Polytope", {"A", "b"});
  def_state(c, std::make_index_sequence<2>());
}

void bind_resolved_stance(py::module_& m) {
  py::class_<ResolvedStance> c(m, "ResolvedStance", "A stance of a scene worked out for one robot.");
  c.def_readonly("com_W", &ResolvedStance::com_W, "[m]");
  c.def_readonly("yaw", &ResolvedStance::yaw, "[rad]");
  c.def_readonly("base_rpy", &ResolvedStance::base_rpy,
                 "Roll, pitch and yaw [rad]: upright, on three feet and more parallel to the ground below them.");
  c.def_readonly("contacts", &ResolvedStance::contacts, "Surface index per end-effector, -1: free.");
  def_points(c, "end_effectors_W", &ResolvedStance::end_effectors_W,
             "Nominal positions, those in contact on their surface [m].");
  def_value(c, "ResolvedStance", {"com_W", "yaw", "base_rpy", "contacts", "end_effectors_W"});
  m.def("resolve_stance", &resolve_stance, py::arg("scene"), py::arg("robot"), py::arg("stance"),
        py::arg("field") = "stance",
        "Work out a stance for a robot. Raises InvalidScene when contacts name an end-effector that the robot does not "
        "have, "
        "or one that may not touch the surface.");
}

}  // namespace

void bind_robot(py::module_& m) {
  bind_polytope(m);
  py::class_<LimbLimits> limb = bind_fields<LimbLimits>(m);
  limb.def_property_readonly("given", &LimbLimits::given, "Whether limits are given.");
  py::class_<EndEffector> end = bind_fields<EndEffector>(m);
  end.def(
      "usual_box",
      [](const EndEffector& self) {
        const Eigen::AlignedBox3d box = self.usual_box();
        return std::make_pair(Eigen::Vector3d(box.min()), Eigen::Vector3d(box.max()));
      },
      "The reach box within usual_reach: its lower and upper corner [m].");
  bind_fields<TrunkPart>(m);
  py::class_<Robot> c = bind_fields<Robot>(m);
  c.def("end_effector_index", &Robot::end_effector_index, py::arg("end_effector_name"), "Index, or -1.");
  c.def("validate", &Robot::validate, "Raise InvalidRobot naming all that is out of its range.");

  m.def("addresses", &addresses, py::arg("who"), py::arg("end_effector"),
        "Whether a name or kind addresses this end-effector.");
  m.def("may_touch", &may_touch, py::arg("surface"), py::arg("end_effector"),
        "Whether the surface lists the end-effector, by name or kind, or lists nobody.");
  bind_resolved_stance(m);
  m.def("require_standing", &require_standing, py::arg("scene"), py::arg("robot"),
        "Refuse a start or goal where a robot cannot stand. Raises InvalidScene where an end-effector would have to "
        "reach far beyond its box for its surface, or where all surfaces that a stance names face so far down that no "
        "force on them holds anything up; also for a scene that is not valid, as InvalidRobot for a robot.");
}

}  // namespace mcplan::bindings
