#include "mcplan/scene/scene.hpp"

#include "bindings.hpp"
#include "mcplan/scene/polygon.hpp"

namespace mcplan::bindings {
namespace {

void bind_polygon(py::module_& m) {
  py::class_<Polygon>(m, "Polygon", "Convex planar polygon in the world, prepared for distance queries [m].")
      .def(py::init([](const py::object& vertices_W) { return Polygon(points_from(vertices_W, "vertices_W")); }),
           py::arg("vertices_W"))
      .def_property_readonly("vertices_W",
                             [](const Polygon& self) {
                               Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> out(self.edge_count(), 3);
                               for (int i = 0; i < self.edge_count(); ++i) out.row(i) = self.vertices_W()[i];
                               return out;
                             })
      .def_property_readonly(
          "normal_W", [](const Polygon& self) { return self.normal_W(); }, "Unit outward normal.")
      .def_property_readonly("centroid_W", &Polygon::centroid_W)
      .def("height", &Polygon::height, py::arg("point_W"), "Height of a point above the plane [m].")
      .def("outside", &Polygon::outside, py::arg("point_W"),
           "Largest overshoot over the edges [m]: negative inside, the distance to the boundary near an edge.")
      .def("nearest", &Polygon::nearest, py::arg("point_W"), "Nearest point of the polygon [m].")
      .def(
          "tangent_W",
          [](const Polygon& self, int i) {
            if (i != 0 && i != 1) throw InvalidInput("i", "must be 0 or 1", text(i));
            return Eigen::Vector3d(self.tangent_W(i));
          },
          py::arg("i"), "Unit tangents, i = 0, 1: tangent 0 x tangent 1 = normal.")
      .def("__repr__", [](py::handle self) { return paste(self, "Polygon", {"vertices_W"}); });
}

void bind_surface(py::module_& m) {
  py::class_<Surface> c(m, "Surface", "A flat patch of the world that end-effectors may touch.");
  const Surface d;
  c.def(py::init([](std::string name, const py::object& vertices_W, double friction, bool grasp,
                    std::vector<std::string> end_effectors, double thickness) {
          return Surface{
              std::move(name), points_from(vertices_W, "vertices_W"), friction, grasp, std::move(end_effectors),
              thickness};
        }),
        py::kw_only(), py::arg("name") = d.name, py::arg("vertices_W") = py::tuple(), py::arg("friction") = d.friction,
        py::arg("grasp") = d.grasp, py::arg("end_effectors") = d.end_effectors, py::arg("thickness") = d.thickness);
  c.def_readwrite("name", &Surface::name);
  def_points(c, "vertices_W", &Surface::vertices_W,
             "N x 3 [m], convex, coplanar, counter-clockwise about the outward normal.");
  c.def_readwrite("friction", &Surface::friction, "Coulomb coefficient [-].");
  c.def_readwrite("grasp", &Surface::grasp, "May be held: no friction cone, the force cap of the end-effector only.");
  def_names(c, "end_effectors", &Surface::end_effectors, "Names or kinds that may touch it; empty: all.");
  c.def_readwrite("thickness", &Surface::thickness,
                  "Solid below the surface that swinging end-effectors must clear [m].");
  def_value(c, "Surface", {"name", "vertices_W", "friction", "grasp", "end_effectors", "thickness"});
}

void bind_stance(py::module_& m) {
  py::class_<Stance> c(m, "Stance", "Where the robot is at the start or the goal; heights come from the robot.");
  c.def(py::init([](const Eigen::Vector3d& position_W, double yaw, std::map<std::string, std::string> contacts) {
          return Stance{position_W, yaw, std::move(contacts)};
        }),
        py::kw_only(), py::arg("position_W") = Eigen::Vector3d(Eigen::Vector3d::Zero()), py::arg("yaw") = 0.0,
        py::arg("contacts") = std::map<std::string, std::string>());
  def_vector(c, "position_W", &Stance::position_W, "Point of the ground below the CoM [m].");
  c.def_readwrite("yaw", &Stance::yaw, "Heading [rad].");
  def_names(c, "contacts", &Stance::contacts,
            "End-effector or kind -> surface; a name beats its kind. Assign a dict to change it.");
  def_value(c, "Stance", {"position_W", "yaw", "contacts"});
}

void bind_rule(py::module_& m) {
  using Names = std::vector<std::string>;
  py::class_<ContactRule> c(m, "ContactRule", "If none of `when_free` is in contact, all of `require` must be.");
  c.def(py::init([](Names when_free, Names require) {
          return ContactRule{std::move(when_free), std::move(require)};
        }),
        py::kw_only(), py::arg("when_free") = Names(), py::arg("require") = Names());
  def_names(c, "when_free", &ContactRule::when_free, "Names or kinds of end-effectors.");
  def_names(c, "require", &ContactRule::require, "Names or kinds of end-effectors.");
  def_value(c, "ContactRule", {"when_free", "require"});
}

void bind_step(py::module_& m) {
  py::class_<Step> c(m, "Step", "One step of a walk: the foot that swings and the surface on which it lands.");
  c.def(py::init([](std::string end_effector, std::string surface) {
          return Step{std::move(end_effector), std::move(surface)};
        }),
        py::kw_only(), py::arg("end_effector") = "", py::arg("surface") = "");
  c.def_readwrite("end_effector", &Step::end_effector, "Name of the end-effector that swings.");
  c.def_readwrite("surface", &Step::surface, "Name of the surface on which it lands.");
  def_value(c, "Step", {"end_effector", "surface"});
}

}  // namespace

void bind_scene(py::module_& m) {
  bind_polygon(m);
  bind_surface(m);
  bind_stance(m);
  bind_rule(m);
  bind_step(m);

  py::class_<Scene> c(m, "Scene", "The world: surfaces, start and goal. World frame W with z up.");
  c.def(py::init([](std::string name, std::string description, double gravity, std::vector<Surface> surfaces,
                    const Stance& start, const Stance& goal, std::vector<ContactRule> rules, std::vector<Step> steps) {
          return Scene{std::move(name),  std::move(description), gravity, std::move(surfaces), start, goal,
                       std::move(rules), std::move(steps)};
        }),
        py::kw_only(), py::arg("name") = "", py::arg("description") = "", py::arg("gravity") = Scene().gravity,
        py::arg("surfaces") = std::vector<Surface>(), py::arg("start") = Stance(), py::arg("goal") = Stance(),
        py::arg("rules") = std::vector<ContactRule>(), py::arg("steps") = std::vector<Step>());
  c.def_readwrite("name", &Scene::name);
  c.def_readwrite("description", &Scene::description);
  c.def_readwrite("gravity", &Scene::gravity, "[m/s^2]");
  def_items(c, "surfaces", &Scene::surfaces, "Tuple of Surface; assign a list to add or remove.");
  def_member(c, "start", &Scene::start, "Stance at the start.");
  def_member(c, "goal", &Scene::goal, "Stance at the goal.");
  def_items(c, "rules", &Scene::rules, "Tuple of ContactRule; assign a list to add or remove.");
  def_items(c, "steps", &Scene::steps,
            "Contact sequence of a walk, for planners that want it given: tuple of Step; assign a list to change it.");
  c.def("surface_index", &Scene::surface_index, py::arg("surface_name"), "Index into surfaces, or -1.");
  c.def("validate", &Scene::validate, "Raise InvalidScene naming the first field out of its range.");
  def_value(c, "Scene", {"name", "description", "gravity", "surfaces", "start", "goal", "rules", "steps"});
  def_pickle(c, "mcplan.files.scenes", "scene_to_dict", "rebuild_scene");
}

}  // namespace mcplan::bindings
