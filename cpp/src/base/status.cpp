#include "mcplan/base/status.hpp"

#include <array>
#include <utility>

namespace mcplan {
namespace {

constexpr std::array<std::pair<Status, std::string_view>, 8> kNames{{
    {Status::solved, "solved"},
    {Status::acceptable, "acceptable"},
    {Status::infeasible, "infeasible"},
    {Status::no_sequence, "no_sequence"},
    {Status::iteration_limit, "iteration_limit"},
    {Status::time_limit, "time_limit"},
    {Status::interrupted, "interrupted"},
    {Status::numerical_failure, "numerical_failure"},
}};

}  // namespace

std::string_view to_string(Status status) {
  for (const auto& [value, name] : kNames)
    if (value == status) return name;
  return "unknown";
}

std::optional<Status> status_from_string(std::string_view name) {
  for (const auto& [value, text] : kNames)
    if (text == name) return value;
  return std::nullopt;
}

}  // namespace mcplan
