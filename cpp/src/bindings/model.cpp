#include "model.hpp"

#include "mcplan/model/data.hpp"
#include "mcplan/robot/robot_files.hpp"
#include "mcplan/scene/scene_files.hpp"
#include "model/file_kind.hpp"
#include "model/json.hpp"
#include "model/read.hpp"
#include "model/reading.hpp"
#include "model/schema.hpp"
#include "model/text.hpp"
#include "model/toml.hpp"
#include "model/write.hpp"
#include "planar/task_fields.hpp"
#include "robot/robot_fields.hpp"
#include "scene/scene_fields.hpp"

namespace mcplan::bindings {
namespace {

using model::Value;

constexpr int max_nested = 100;

std::string text_of(py::handle text) {
  const auto bytes = py::reinterpret_steal<py::bytes>(PyUnicode_AsEncodedString(text.ptr(), "utf-8", "surrogatepass"));
  if (!bytes) throw py::error_already_set();
  return bytes;
}

Value nested_value(py::handle data, int depth) {
  if (depth > max_nested) throw InvalidInput("", "nested too deep", "");
  PyObject* const object = data.ptr();
  if (data.is_none()) return {};
  if (PyBool_Check(object)) return data.ptr() == Py_True;
  if (PyLong_Check(object)) {
    int overflow = 0;
    const long long whole = PyLong_AsLongLongAndOverflow(object, &overflow);
    if (overflow == 0) return static_cast<std::int64_t>(whole);
    return Value::Other{text_of(py::module_::import("mcplan.errors").attr("digits")(data))};
  }
  if (PyFloat_Check(object)) return PyFloat_AsDouble(object);
  if (PyUnicode_Check(object)) return text_of(data);
  if (PyList_Check(object) || PyTuple_Check(object)) {
    Value::Array out;
    for (py::handle item : data) out.push_back(nested_value(item, depth + 1));
    return out;
  }
  if (PyMapping_Check(object) && py::hasattr(data, "items")) {
    Value::Table out;
    for (py::handle item : data.attr("items")()) {
      const auto [key, entry] = item.cast<std::pair<py::object, py::object>>();
      out.push_back({text_of(py::str(key)), nested_value(entry, depth + 1)});
    }
    return out;
  }
  if (PyNumber_Check(object) && py::hasattr(data, "__float__") && !py::hasattr(data, "shape"))
    return data.attr("__float__")().cast<double>();
  if (py::hasattr(data, "tolist")) return nested_value(data.attr("tolist")(), depth + 1);
  return Value::Other{text_of(py::module_::import("mcplan.errors").attr("shown")(data))};
}

py::object text_to(const std::string& text) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "surrogateescape"));
}

}  // namespace

Value value_from(py::handle data) { return nested_value(data, 0); }

py::object plain(const Value& value) {
  if (const auto* const flag = value.get<bool>()) return py::bool_(*flag);
  if (const auto* const whole = value.get<std::int64_t>()) return py::int_(*whole);
  if (const auto* const number = value.get<double>()) return py::float_(*number);
  if (const auto* const text = value.get<std::string>()) return text_to(*text);
  if (const auto* const other = value.get<Value::Other>()) return text_to(other->text);
  if (const auto* const array = value.get<Value::Array>()) {
    py::list out;
    for (const Value& item : *array) out.append(plain(item));
    return std::move(out);
  }
  if (const auto* const table = value.get<Value::Table>()) {
    py::dict out;
    for (const model::Entry& entry : *table) out[text_to(entry.key)] = plain(entry.value);
    return std::move(out);
  }
  return py::none();
}

std::string path_from(py::handle path) { return py::bytes(py::module_::import("os").attr("fsencode")(path)); }

py::object path_text(const std::string& path) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeFSDefaultAndSize(path.data(), static_cast<py::ssize_t>(path.size())));
}

namespace {

Value schema_of(const std::string& name) {
  if (name == "scene") return model::schema<Scene>();
  if (name == "robot") return model::schema<Robot>();
  if (name == "planar_robot") return model::schema<model::InFile<PlanarRobot>>();
  if (name == "planar_task") return model::schema<model::InFile<PlanarTask>>();
  throw InvalidInput("name", "must be scene, robot, planar_robot or planar_task", text(name));
}

void bind_scene_files(py::module_& m) {
  def_suspicious_geometry<Scene>(m, "scene");
  m.def(
      "load_scene", [](const py::object& source) { return load_scene(path_from(source)); }, py::arg("source"),
      "A built-in scene by its name, or one from a TOML file. Raises UnknownScene, InvalidScene.");
  m.def(
      "read_scene", [](const py::object& path) { return read_scene(path_from(path)); }, py::arg("path"),
      "A scene from a TOML file. Raises InvalidScene.");
  m.def("require_ground", &require_ground, py::arg("scene"),
        "Raise InvalidScene where start or goal hangs in the air, or lies under or far beside the surfaces it names.");
  m.def(
      "scene_from_dict",
      [](const py::object& data, const py::object& source) {
        try {
          return model::scene_from(value_from(data), path_from(source));
        } catch (const InvalidInput& found) {
          throw moved<InvalidScene>(found);
        }
      },
      py::arg("data"), py::arg("source") = "", "The scene of plain data with the keys of a scene file.");
  m.def(
      "scene_to_dict", [](const Scene& scene) { return py::dict(plain(model::written(scene))); }, py::arg("scene"),
      "Plain data with the keys of a scene file; what is at its default is left out.");
}

void bind_robot_files(py::module_& m) {
  def_suspicious_geometry<Robot>(m, "robot");
  m.def(
      "load_robot", [](const py::object& source) { return load_robot(path_from(source)); }, py::arg("source"),
      "A built-in robot by its name, or one from a TOML file. Raises UnknownRobot, InvalidRobot.");
  m.def(
      "read_robot", [](const py::object& path) { return read_robot(path_from(path)); }, py::arg("path"),
      "A robot from a TOML file. Raises InvalidRobot.");
  m.def(
      "robot_from_dict",
      [](const py::object& data, const py::object& source, const py::object& folder) {
        const std::filesystem::path place = folder.is_none() ? "" : path_from(folder);
        try {
          return model::robot_from(value_from(data), path_from(source), folder.is_none() ? nullptr : &place);
        } catch (const InvalidInput& found) {
          throw moved<InvalidRobot>(found);
        }
      },
      py::arg("data"), py::arg("source") = "", py::arg("folder") = py::none(),
      "The robot of plain data with the keys of a robot file. Files that it names are looked for in `folder`; None: it "
      "may name none.");
  m.def(
      "robot_to_dict", [](const Robot& robot) { return py::dict(plain(model::written(robot))); }, py::arg("robot"),
      "Plain data with the keys of a robot file; what is at its default is left out, reach polytopes are inline.");
}

}  // namespace

void bind_model(py::module_& m) {
  bind_scene_files(m);
  bind_robot_files(m);
  m.def("built_in", &built_in, py::arg("kind"),
        "Sorted names of the built-in 'scenes', 'robots', 'planar_robots' or 'planar_tasks'.");
  m.def(
      "data_folder", [] { return path_text(data_folder().string()); },
      "The folder of the built-in scenes, robots and planar tasks.");
  m.def(
      "schema_text", [](const std::string& name) { return model::json_text(schema_of(name), 2) + "\n"; },
      py::arg("name"), "The JSON schema of the files of a kind: 'scene', 'robot', 'planar_robot' or 'planar_task'.");
  m.def(
      "toml_text",
      [](const py::object& data, const py::object& header) {
        return text_to(model::toml_text(value_from(data), text_of(header)));
      },
      py::arg("data"), py::arg("header") = "",
      "A mapping as TOML: plain values first, then tables and lists of tables. `header`: a comment to put on top.");
  m.def(
      "file_kind", [](const py::bytes& content) { return model::file_kind_or_toml(static_cast<std::string>(content)); },
      py::arg("content"),
      "What a file is by its content, with its article, such as \"a PNG picture\"; \"\" where nothing tells.");
  m.def(
      "toml_from",
      [](const py::bytes& content) { return py::dict(plain(model::parse_toml(static_cast<std::string>(content)))); },
      py::arg("content"), "The tables of a TOML file, dates as texts. Raises InvalidInput.");
}

}  // namespace mcplan::bindings
