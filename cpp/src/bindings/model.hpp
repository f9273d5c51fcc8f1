#pragma once

#include <string>

#include "bindings.hpp"
#include "mcplan/base/suspicion.hpp"
#include "model/value.hpp"

namespace mcplan::bindings {

/// Plain data of Python (dicts, lists, numbers, texts) as a value. Throws InvalidInput where they are nested too deep.
model::Value value_from(py::handle data);

/// A value as plain data of Python.
py::object plain(const model::Value& value);

/// The bytes of a path, whatever the system takes for a name, and back.
std::string path_from(py::handle path);
py::object path_text(const std::string& path);

/// suspicious_geometry() of a scene, robot or planar robot.
template <class Model>
void def_suspicious_geometry(py::module_& m, const char* argument) {
  m.def(
      "suspicious_geometry",
      [](const Model& model) {
        std::vector<std::tuple<std::string, std::string, std::string>> out;
        for (Suspicion& found : suspicious_geometry(model))
          out.emplace_back(std::move(found.field), std::move(found.rule), std::move(found.value));
        return out;
      },
      py::arg(argument), "What is legal and can hardly be meant: field, rule and value of each finding.");
}

}  // namespace mcplan::bindings
