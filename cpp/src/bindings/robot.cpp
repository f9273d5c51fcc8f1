#include "mcplan/robot/robot.hpp"

#include "bindings.hpp"

namespace mcplan::bindings {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

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
}

void bind_end_effector(py::module_& m) {
  py::class_<EndEffector> c(m, "EndEffector",
                            "A contact link of the robot. Frame B sits at the CoM and turns with the base.");
  const EndEffector d;
  c.def(
      py::init([](std::string name, std::string kind, std::string frame, const Vector3d& frame_offset,
                  const Vector2d& half_size, const Vector3d& nominal_B, const Vector3d& reach_min_B,
                  const Vector3d& reach_max_B, double max_force, const Vector3d& max_moment, const Vector2d& yaw_range,
                  const Polytope& com_reach, std::map<std::string, Polytope> partner_reach) {
        return EndEffector{std::move(name),
                           std::move(kind),
                           std::move(frame),
                           frame_offset,
                           half_size,
                           nominal_B,
                           reach_min_B,
                           reach_max_B,
                           max_force,
                           max_moment,
                           yaw_range,
                           com_reach,
                           std::move(partner_reach)};
      }),
      py::kw_only(), py::arg("name") = d.name, py::arg("kind") = d.kind, py::arg("frame") = d.frame,
      py::arg("frame_offset") = d.frame_offset, py::arg("half_size") = d.half_size, py::arg("nominal_B") = d.nominal_B,
      py::arg("reach_min_B") = d.reach_min_B, py::arg("reach_max_B") = d.reach_max_B,
      py::arg("max_force") = d.max_force, py::arg("max_moment") = d.max_moment, py::arg("yaw_range") = d.yaw_range,
      py::arg("com_reach") = Polytope(), py::arg("partner_reach") = std::map<std::string, Polytope>());
  c.def_readwrite("name", &EndEffector::name);
  c.def_readwrite("kind", &EndEffector::kind, "Group that scenes may address as a whole, e.g. 'foot', 'hand'.");
  c.def_readwrite("frame", &EndEffector::frame, "URDF frame, empty for robots without a URDF.");
  def_vector(c, "frame_offset", &EndEffector::frame_offset, "Contact point in the axes of the URDF frame [m].");
  def_vector(c, "half_size", &EndEffector::half_size, "Half length and half width of the sole [m]; 0: point contact.");
  def_vector(c, "nominal_B", &EndEffector::nominal_B, "Nominal position relative to the CoM [m].");
  def_vector(c, "reach_min_B", &EndEffector::reach_min_B, "Box of reachable positions relative to the CoM [m].");
  def_vector(c, "reach_max_B", &EndEffector::reach_max_B, "Box of reachable positions relative to the CoM [m].");
  c.def_readwrite("max_force", &EndEffector::max_force, "Largest norm of the contact force [N].");
  def_vector(c, "max_moment", &EndEffector::max_moment,
             "Largest contact moment about each world axis [N m]; under ForceLaw.wrench the third about the surface's "
             "normal.");
  def_vector(c, "yaw_range", &EndEffector::yaw_range,
             "How far the sole may be turned against the base about the vertical while in contact [rad].");
  def_member(
      c, "com_reach", &EndEffector::com_reach,
      "Where the CoM may be relative to this end-effector while it is in contact; axes level, x along the heading.");
  def_names(c, "partner_reach", &EndEffector::partner_reach,
            "Where other end-effectors may stand relative to it, by name; same axes. Assign a dict to change it.");
  def_value(c, "EndEffector",
            {"name", "kind", "frame", "frame_offset", "half_size", "nominal_B", "reach_min_B", "reach_max_B",
             "max_force", "max_moment", "yaw_range", "com_reach", "partner_reach"});
}

void bind_resolved_stance(py::module_& m) {
  py::class_<ResolvedStance> c(m, "ResolvedStance", "A stance of a scene worked out for one robot.");
  c.def_readonly("com_W", &ResolvedStance::com_W, "[m]");
  c.def_readonly("yaw", &ResolvedStance::yaw, "[rad]");
  c.def_readonly("contacts", &ResolvedStance::contacts, "Surface index per end-effector, -1: free.");
  def_points(c, "end_effectors_W", &ResolvedStance::end_effectors_W,
             "Nominal positions, those in contact on their surface [m].");
  def_value(c, "ResolvedStance", {"com_W", "yaw", "contacts", "end_effectors_W"});
  m.def("resolve_stance", &resolve_stance, py::arg("scene"), py::arg("robot"), py::arg("stance"),
        py::arg("field") = "stance",
        "Work out a stance for a robot. Raises InvalidScene when contacts name an end-effector that the robot does not "
        "have, "
        "or one that may not touch the surface.");
}

}  // namespace

void bind_robot(py::module_& m) {
  bind_polytope(m);
  bind_end_effector(m);

  using Posture = std::map<std::string, double>;
  py::class_<Robot> c(m, "Robot", "What a planner needs to know of a robot: lumped inertia and where its limbs reach.");
  const Robot d;
  c.def(py::init([](std::string name, std::string description, double mass, const Vector3d& inertia, double com_height,
                    double swing_height, const Vector2d& phase_duration, double sole_support, double pressure_share,
                    bool tracked, std::vector<EndEffector> end_effectors, std::string urdf, Posture posture) {
          return Robot{std::move(name),
                       std::move(description),
                       mass,
                       inertia,
                       com_height,
                       swing_height,
                       phase_duration,
                       sole_support,
                       pressure_share,
                       tracked,
                       std::move(end_effectors),
                       std::move(urdf),
                       std::move(posture)};
        }),
        py::kw_only(), py::arg("name") = "", py::arg("description") = "", py::arg("mass") = d.mass,
        py::arg("inertia") = d.inertia, py::arg("com_height") = d.com_height, py::arg("swing_height") = d.swing_height,
        py::arg("phase_duration") = d.phase_duration, py::arg("sole_support") = d.sole_support,
        py::arg("pressure_share") = d.pressure_share, py::arg("tracked") = d.tracked,
        py::arg("end_effectors") = std::vector<EndEffector>(), py::arg("urdf") = "", py::arg("posture") = Posture());
  c.def_readwrite("name", &Robot::name);
  c.def_readwrite("description", &Robot::description);
  c.def_readwrite("mass", &Robot::mass, "[kg]");
  def_vector(c, "inertia", &Robot::inertia, "Diagonal, about the CoM, nominal posture [kg m^2].");
  c.def_readwrite("com_height", &Robot::com_height, "Of the CoM above the ground in the nominal stance [m].");
  c.def_readwrite("swing_height", &Robot::swing_height,
                  "Clearance of a swinging end-effector [m]. The default, 0.10, goes with the size of the robot.");
  def_vector(c, "phase_duration", &Robot::phase_duration,
             "Shortest and longest phase of a contact sequence [s]. The default goes with the size of the robot.");
  c.def_readwrite("sole_support", &Robot::sole_support,
                  "Share of a sole that a contact sequence keeps on its surface; 0: its centre.");
  c.def_readwrite("pressure_share", &Robot::pressure_share,
                  "Share of a sole's half size within which a plan keeps the centre of pressure.");
  c.def_readwrite("tracked", &Robot::tracked,
                  "Whether a controller follows the plans with limbs whose momentum they do not know of: contact "
                  "sequences then keep the base upright and the centre of pressure near the middle of the sole.");
  def_items(c, "end_effectors", &Robot::end_effectors, "Tuple of EndEffector; assign a list to add or remove.");
  c.def_readwrite("urdf", &Robot::urdf, "Path, or 'example-robot-data:NAME'; empty: none.");
  def_names(c, "posture", &Robot::posture,
            "Nominal joint positions [rad] by URDF joint name. Assign a dict to change it.");
  c.def("end_effector_index", &Robot::end_effector_index, py::arg("end_effector_name"), "Index, or -1.");
  c.def("validate", &Robot::validate, "Raise InvalidRobot naming the first field out of its range.");
  def_value(c, "Robot",
            {"name", "description", "mass", "inertia", "com_height", "swing_height", "phase_duration", "sole_support",
             "pressure_share", "tracked", "end_effectors", "urdf", "posture"});
  def_pickle(c, "mcplan.files.robots", "robot_to_dict", "rebuild_robot");

  m.def("addresses", &addresses, py::arg("who"), py::arg("end_effector"),
        "Whether a name or kind addresses this end-effector.");
  m.def("may_touch", &may_touch, py::arg("surface"), py::arg("end_effector"),
        "Whether the surface lists the end-effector, by name or kind, or lists nobody.");
  bind_resolved_stance(m);
}

}  // namespace mcplan::bindings
