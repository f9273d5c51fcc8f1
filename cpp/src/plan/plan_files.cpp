#include "mcplan/plan/plan_files.hpp"

#include <stdexcept>

#include "mcplan/base/error.hpp"
#include "mcplan/version.hpp"
#include "model/json.hpp"
#include "model/read.hpp"
#include "model/reading.hpp"
#include "model/write.hpp"
#include "model/writing.hpp"
#include "plan_fields.hpp"

namespace mcplan {
namespace {

using model::Value;

constexpr const char* file_kind = "plan";
constexpr int json_format = 4;  // after the three formats of .npz
constexpr const char* units = "SI: m, kg, s, N, rad; stiffness in 1/s^2; _W: world frame, z up";

/// The fields of a plan without the lines about the file itself, which must be right.
Value plan_data(Value data) {
  auto* const table = data.get<Value::Table>();
  if (!table) throw InvalidPlan("", "must be a JSON object", model::shown(data));
  const auto said = [&](const char* key) { return data.find(key) ? model::shown(*data.find(key)) : "nothing"; };
  const auto* const kind = data.find("kind") ? data.find("kind")->get<std::string>() : nullptr;
  if (!kind || *kind != file_kind)
    throw InvalidPlan("kind", "must be 'plan': a plan of contacts and CoM", said("kind"));
  const auto* const format = data.find("format") ? data.find("format")->get<std::int64_t>() : nullptr;
  if (!format || *format != json_format)
    throw InvalidPlan("format", "must be " + text(json_format) + " for this version of mcplan", said("format"));
  Value::Table fields;
  for (model::Entry& entry : *table)
    if (entry.key != "kind" && entry.key != "format" && entry.key != "units" && entry.key != "mcplan")
      fields.push_back(std::move(entry));
  return fields;
}

}  // namespace

std::string plan_to_json(const Plan& plan) {
  plan.validate();
  model::Findings found;
  model::check_struct(plan, model::Place(), found);
  found.raise<InvalidPlan>();
  Value out;
  out.set("kind", file_kind);
  out.set("format", json_format);
  out.set("units", units);
  out.set("mcplan", MCPLAN_VERSION);
  Value fields = model::written(plan);
  for (model::Entry& entry : *fields.get<Value::Table>()) out.set(std::move(entry.key), std::move(entry.value));
  std::string content = model::json_text(out, 1, 2) + "\n";
  if (content.size() > model::max_json_plan_bytes)
    throw InvalidPlan("", "may have " + model::size_text(model::max_json_plan_bytes) + " at most as JSON",
                      std::to_string(content.size()) + " bytes");
  return content;
}

Plan plan_from_json(const std::string& content) {
  if (content.size() > model::max_json_plan_bytes)
    throw InvalidPlan("", "may have " + model::size_text(model::max_json_plan_bytes) + " at most as JSON",
                      std::to_string(content.size()) + " bytes");
  Value parsed;
  try {
    parsed = model::parse_json(content);
  } catch (const std::invalid_argument& bad) {
    throw InvalidPlan("", "must be JSON", model::printable(bad.what()));
  } catch (const std::length_error& bad) {
    throw InvalidPlan("", bad.what(), "more");
  }
  const Value data = plan_data(std::move(parsed));
  model::Reading reading;
  Plan plan;
  if (model::require_few_keys(data, reading.found)) model::read_struct(data, plan, model::Place(), reading);
  reading.found.raise<InvalidPlan>();
  try {
    plan.scene.validate();
  } catch (const InvalidScene& bad) {
    throw moved<InvalidPlan>(bad, "", "scene");
  }
  try {
    plan.robot.validate();
  } catch (const InvalidRobot& bad) {
    throw moved<InvalidPlan>(bad, "", "robot");
  }
  plan.validate();
  return plan;
}

Plan load_plan(const std::string& path) {
  try {
    const std::string content = model::read_file(path, model::max_plan_bytes, "", path);
    if (content.rfind("PK", 0) == 0)
      throw InvalidPlan("", "must be JSON: mcplan.Plan.load and save of Python turn .npz into it", "a zip archive");
    return plan_from_json(content);
  } catch (const InvalidInput& found) {
    model::throw_as<InvalidPlan>(found, path);
  }
}

void Plan::save(const std::string& path) const {
  if (path.size() < 5 || path.compare(path.size() - 5, 5, ".json") != 0)
    throw InvalidInput("path", "must end in .json", model::printable(path));
  model::write_whole(plan_to_json(*this), path);
}

bool operator==(const Plan& a, const Plan& b) { return model::equal(a, b); }

}  // namespace mcplan
