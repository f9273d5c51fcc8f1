#pragma once

#include <string>

#include "bindings.hpp"
#include "model/value.hpp"

namespace mcplan::bindings {

/// Plain data of Python (dicts, lists, numbers, texts) as a value. Throws InvalidInput where they are nested too deep.
model::Value value_from(py::handle data);

/// A value as plain data of Python.
py::object plain(const model::Value& value);

/// The bytes of a path, whatever the system takes for a name, and back.
std::string path_from(py::handle path);
py::object path_text(const std::string& path);

}  // namespace mcplan::bindings
