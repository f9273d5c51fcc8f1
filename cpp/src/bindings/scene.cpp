#include "mcplan/scene/scene.hpp"

#include "fields.hpp"
#include "mcplan/scene/polygon.hpp"
#include "scene/joined_surfaces.hpp"
#include "scene/scene_fields.hpp"

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

}  // namespace

void bind_scene(py::module_& m) {
  bind_polygon(m);
  bind_fields<Surface>(m);
  bind_fields<Stance>(m);
  bind_fields<ContactRule>(m);
  bind_fields<Step>(m);
  py::class_<Scene> c = bind_fields<Scene>(m);
  c.def("surface_index", &Scene::surface_index, py::arg("surface_name"), "Index into surfaces, or -1.");
  m.def(
      "join_surfaces",
      [](const Scene& scene) {
        scene.validate();
        return join_surfaces(scene).scene;
      },
      py::arg("scene"),
      "The scene with surfaces as one that lie in one plane, touch, and make a convex one together; with the name of "
      "the first, which start, goal and steps name then. Raises InvalidScene.");
  m.def(
      "whole_outlines",
      [](const Scene& scene) {
        const JoinedSurfaces joined = join_surfaces(scene);
        std::vector<Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>> out;
        for (int whole : joined.index) {
          const std::vector<Eigen::Vector3d>& vertices_W = joined.scene.surfaces[whole].vertices_W;
          auto& rows = out.emplace_back(static_cast<Eigen::Index>(vertices_W.size()), 3);
          for (Eigen::Index i = 0; i < rows.rows(); ++i) rows.row(i) = vertices_W[i];
        }
        return out;
      },
      py::arg("scene"), "(n, 3) for each surface [m]: the corners of the one that join_surfaces() makes it a part of.");
  c.def("validate", &Scene::validate, "Raise InvalidScene naming all that is out of its range.");
}

}  // namespace mcplan::bindings
