#include <variant>

#include "mcplan/planar/plan_files.hpp"
#include "mcplan/planar/robot_files.hpp"
#include "mcplan/planar/task_files.hpp"
#include "model.hpp"
#include "model/write.hpp"
#include "plan/plan_fields.hpp"
#include "plan/plan_json.hpp"
#include "planar/plan_fields.hpp"

namespace mcplan::bindings {
namespace {

using model::Value;

void bind_planar_robot_files(py::module_& m) {
  m.def(
      "load_planar_robot", [](const py::object& source) { return load_planar_robot(path_from(source)); },
      py::arg("source"),
      "A built-in planar robot by its name, or one from a TOML file. Raises UnknownRobot, InvalidRobot.");
  m.def(
      "read_planar_robot", [](const py::object& path) { return read_planar_robot(path_from(path)); }, py::arg("path"),
      "A planar robot from a TOML file. Raises InvalidRobot.");
  m.def(
      "planar_robot_from_dict",
      [](const py::object& data, const py::object& source) {
        try {
          return model::planar_robot_from(value_from(data), path_from(source));
        } catch (const InvalidInput& found) {
          throw moved<InvalidRobot>(found);
        }
      },
      py::arg("data"), py::arg("source") = "", "The planar robot of plain data with the keys of its file.");
  m.def(
      "planar_robot_to_dict",
      [](const PlanarRobot& robot) {
        robot.validate();
        return py::dict(plain(model::planar_robot_data(robot)));
      },
      py::arg("robot"), "Plain data with the keys of a planar robot's file; what is at its default is left out.");
}

void bind_planar_task_files(py::module_& m) {
  m.def(
      "load_planar_task", [](const py::object& source) { return load_planar_task(path_from(source)); },
      py::arg("source"),
      "A built-in planar task by its name, or one from a TOML file. Raises UnknownPlanarTask, UnknownRobot, "
      "InvalidPlanarTask, "
      "InvalidRobot.");
  m.def(
      "read_planar_task", [](const py::object& path) { return read_planar_task(path_from(path)); }, py::arg("path"),
      "A planar task from a TOML file. Raises InvalidPlanarTask, InvalidRobot, UnknownRobot.");
  m.def(
      "planar_task_from_dict",
      [](const py::object& data, const py::object& source, const py::object& folder) {
        const std::filesystem::path place = folder.is_none() ? "" : path_from(folder);
        try {
          return model::planar_task_from(value_from(data), path_from(source), folder.is_none() ? nullptr : &place);
        } catch (const InvalidRobot&) {
          throw;
        } catch (const InvalidInput& found) {
          throw moved<InvalidPlanarTask>(found);
        }
      },
      py::arg("data"), py::arg("source") = "", py::arg("folder") = py::none(),
      "The planar task of plain data with the keys of its file. The robot that it names is looked for in `folder`; "
      "None: in the working directory.");
  m.def(
      "planar_task_to_dict",
      [](const PlanarTask& task) {
        task.validate();
        return py::dict(plain(model::planar_task_data(task)));
      },
      py::arg("task"),
      "Plain data with the keys of a planar task's file: the robot inline, all contacts of each phase; what is at its "
      "default "
      "is left out.");
  m.def(
      "planar_task_to_plain",
      [](const PlanarTask& task) {
        model::Writing exactly;
        exactly.exact = true;
        return py::dict(plain(model::written(task, exactly)));
      },
      py::arg("task"), "All that a planar task holds under the names of its members; infinite numbers as texts.");
  m.def(
      "planar_task_from_plain", [](const py::object& data) { return model::planar_task_from_exact(value_from(data)); },
      py::arg("data"),
      "Inverse of planar_task_to_plain. Raises InvalidPlanarTask; says nothing of what relates fields.");
}

void bind_planar_plan_files(py::module_& m) {
  m.def(
      "planar_plan_to_json", [](const PlanarPlan& self) { return py::bytes(planar_plan_to_json(self)); },
      py::arg("plan"), "A planar plan as JSON; numbers read back as the same. Raises InvalidPlan.");
  m.def(
      "planar_plan_from_json", [](const py::bytes& content) { return planar_plan_from_json(content); },
      py::arg("content"), "The planar plan of a JSON text. Raises InvalidPlan.");
  m.def(
      "any_plan_from_json",
      [](const py::bytes& content) -> std::variant<Plan, PlanarPlan> {
        Value data = model::parse_plan_json(content);
        if (model::is_of(data, model::planar_plan_kind))
          return model::planar_plan_from(model::plan_fields(std::move(data), model::planar_plan_kind));
        return model::plan_from(model::plan_fields(std::move(data), model::plan_kind));
      },
      py::arg("content"), "The plan of either kind of a JSON text. Raises InvalidPlan.");
}

}  // namespace

void bind_planar_files(py::module_& m) {
  def_suspicious_geometry<PlanarRobot>(m, "robot");
  bind_planar_robot_files(m);
  bind_planar_task_files(m);
  bind_planar_plan_files(m);
}

}  // namespace mcplan::bindings
