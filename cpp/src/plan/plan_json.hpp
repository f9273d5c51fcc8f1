#pragma once

#include <string>

#include "model/value.hpp"

namespace mcplan::model {

/// What the JSON files of one kind of plan say of themselves.
struct PlanKind {
  const char* kind;
  const char* meaning;  ///< for messages
  int format;
  const char* units;
};

constexpr PlanKind plan_kind{"plan", "a plan of contacts and CoM", 4,  // after the three formats of .npz
                             "SI: m, kg, s, N, rad; stiffness in 1/s^2; _W: world frame, z up"};
constexpr PlanKind planar_plan_kind{
    "planar_plan", "a plan of a planar robot", 2,  // after the one format of .npz
    "SI: m, kg, s, N, rad; _W: world frame, x forward, y up; _B: frame of a body; _P: frame of its parent"};

/// A plan as JSON. Throws InvalidPlan where it is too large to be read again.
std::string plan_json(Value fields, const PlanKind& kind);

/// The content of a plan file, of which `is_of` tells the kind. Throws InvalidPlan: too large, no JSON.
Value parse_plan_json(const std::string& content);
bool is_of(const Value& data, const PlanKind& kind);

/// The fields of a plan without the lines about the file itself. Throws InvalidPlan where those are not right.
Value plan_fields(Value data, const PlanKind& kind);

/// The content of a JSON file with a plan. Throws InvalidPlan.
std::string read_plan_json(const std::string& path);

/// Writes it. Throws InvalidInput where the name has another ending, std::filesystem::filesystem_error.
void write_plan_json(const std::string& content, const std::string& path);

}  // namespace mcplan::model
