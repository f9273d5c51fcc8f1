#include <cstdio>
#include <string>

#include "bindings.hpp"
#include "mcplan/planar/task.hpp"
#include "mcplan/version.hpp"
#include "model.hpp"

namespace mcplan::bindings {
namespace {

/// Raises the class of that name from mcplan.errors with the parts of the C++ error, and what else it has found.
void raise(const char* name, const InvalidInput& error) {
  const py::object type = py::module_::import("mcplan.errors").attr(name);
  const auto text_to = [](const std::string& text) {
    return py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "surrogateescape"));
  };
  const auto made = [&](const InvalidInput& each) {
    return type(text_to(each.field()), text_to(each.rule()), text_to(each.value()), path_text(each.source()));
  };
  const py::object value = made(error);
  py::list others;
  for (const InvalidInput& other : error.others()) others.append(made(other));
  value.attr("others") = py::tuple(others);
  PyErr_SetObject(type.ptr(), value.ptr());
}

/// Raises the class of that name with the name that is not known, and those that are.
void raise_unknown(const char* name, const UnknownName& error) {
  const py::object type = py::module_::import("mcplan.errors").attr(name);
  const py::object value = type(path_text(error.name()), error.legal());
  PyErr_SetObject(type.ptr(), value.ptr());
}

void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const UnknownScene& error) {
    raise_unknown("UnknownScene", error);
  } catch (const UnknownRobot& error) {
    raise_unknown("UnknownRobot", error);
  } catch (const UnknownPlanarTask& error) {
    raise_unknown("UnknownPlanarTask", error);
  } catch (const InvalidScene& error) {
    raise("InvalidScene", error);
  } catch (const InvalidRobot& error) {
    raise("InvalidRobot", error);
  } catch (const InvalidPlanarTask& error) {
    raise("InvalidPlanarTask", error);
  } catch (const InvalidOptions& error) {
    raise("InvalidOptions", error);
  } catch (const InvalidPlan& error) {
    raise("InvalidPlan", error);
  } catch (const InvalidInput& error) {
    raise("InvalidInput", error);
  }
}

}  // namespace

std::string shown(const std::string& text) {
  std::string out;
  char code[8];
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0;
    const bool upper = byte == 0xC2 && next >= 0x80 && next < 0xA0;  // U+0080 to U+009F in UTF-8
    if (upper || byte == 0x7F || (byte < 0x20 && byte != '\n')) {
      std::snprintf(code, sizeof code, "\\x%02x", upper ? next : byte);
      out += code;
      i += upper;
    } else {
      out += text[i];
    }
  }
  return out;
}

std::string paste(py::handle value) {
  if (py::isinstance<py::float_>(value)) {
    const std::string text = py::repr(value);
    return text.find_first_of("0123456789") == std::string::npos ? "float('" + text + "')" : text;
  }
  if (py::hasattr(value, "tolist")) return paste(value.attr("tolist")());
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    std::string out;
    for (py::handle item : value) out += (out.empty() ? "" : ", ") + paste(item);
    return "[" + out + "]";
  }
  if (py::hasattr(value, "items")) {
    std::string out;
    for (py::handle item : value.attr("items")()) {
      const auto [key, entry] = item.cast<std::pair<py::object, py::object>>();
      out += (out.empty() ? "" : ", ") + paste(key) + ": " + paste(entry);
    }
    return "{" + out + "}";
  }
  return py::repr(value);
}

std::string paste(py::handle self, const std::string& name, const std::vector<std::string>& attributes) {
  std::string out;
  for (const std::string& attribute : attributes)
    out += (out.empty() ? "" : ", ") + attribute + "=" + paste(self.attr(attribute.c_str()));
  return name + "(" + out + ")";
}

std::vector<Eigen::Vector3d> points_from(py::handle value, const std::string& field) {
  const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(value);
  if (!array) {
    PyErr_Clear();
    throw InvalidInput(field, "must be an N x 3 array of numbers",
                       py::str(py::type::handle_of(value).attr("__name__")));
  }
  if (array.size() == 0) return {};
  if (array.ndim() != 2 || array.shape(1) != 3)
    throw InvalidInput(field, "must be an N x 3 array of numbers",
                       "shape " + std::string(py::str(py::tuple(array.attr("shape")))));
  std::vector<Eigen::Vector3d> points(array.shape(0));
  for (py::ssize_t i = 0; i < array.shape(0); ++i) points[i] = {array.at(i, 0), array.at(i, 1), array.at(i, 2)};
  return points;
}

Eigen::VectorXd vector_from(py::handle value, const std::string& field) {
  const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(value);
  if (!array) {
    PyErr_Clear();
    throw InvalidInput(field, "must be a list of numbers", py::str(py::type::handle_of(value).attr("__name__")));
  }
  if (array.ndim() != 1)
    throw InvalidInput(field, "must be a list of numbers",
                       "shape " + std::string(py::str(py::tuple(array.attr("shape")))));
  return Eigen::Map<const Eigen::VectorXd>(array.data(), array.size());
}

py::array points_view(std::vector<Eigen::Vector3d>& points, py::handle owner) {
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double), "rows must be contiguous");
  const py::ssize_t rows = static_cast<py::ssize_t>(points.size());
  if (rows == 0) return py::array_t<double>(std::vector<py::ssize_t>{0, 3});
  return py::array_t<double>({rows, py::ssize_t{3}}, {3 * sizeof(double), sizeof(double)}, points.front().data(),
                             owner);
}

namespace {

/// What the module is compiled with, by name; what is loaded beside it is known at run time alone.
py::dict compiled_with() {
  py::dict out;
#if defined(__clang__)
  out["compiler"] = "Clang " __clang_version__;
#else
  out["compiler"] = "GCC " __VERSION__;
#endif
  out["Eigen"] = std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                 std::to_string(EIGEN_MINOR_VERSION);
#if defined(__AVX2__)
  out["instructions"] = "AVX2";
#elif defined(__AVX__)
  out["instructions"] = "AVX";
#else
  out["instructions"] = "baseline";
#endif
  return out;
}

}  // namespace

}  // namespace mcplan::bindings

PYBIND11_MODULE(_core, m) {
  namespace py = pybind11;
  using namespace mcplan::bindings;

  m.doc() = "The compiled part of mcplan: the C++ classes under the same names. SI units, world frame W with z up.";
  m.attr("__version__") = MCPLAN_VERSION;
  m.def("compiled_with", &compiled_with, "Compiler, version of Eigen and instruction set of the module, by name.");
  py::register_exception_translator(translate);
  bind_base(m);
  bind_scene(m);
  bind_robot(m);
  bind_model(m);
  bind_plan(m);
  bind_plan_samples(m);
  bind_planar(m);
  bind_planar_plan(m);
  bind_planar_files(m);
  bind_ddp(m);
  bind_nlp(m);
  bind_ipm(m);
  bind_rhp(m);
  bind_sip(m);
  bind_wb(m);
  bind_online(m);
  // The planners' rooms go here, one line each: they may use everything above.
  for (const auto& [old, name] :
       {std::pair("PlanarMotion", "PlanarTask"), std::pair("WholeBodyPlan", "PlanarPlan"),
        std::pair("WholeBodyState", "PlanarState"), std::pair("WholeBodyTolerances", "PlanarTolerances")})
    m.attr(old) = m.attr(name);  // as they were called until 0.1
  refuse_uninitialised(m);
  refuse_in_a_line(m);
}
