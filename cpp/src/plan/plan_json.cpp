#include "plan_json.hpp"

#include <stdexcept>

#include "mcplan/base/error.hpp"
#include "mcplan/version.hpp"
#include "model/json.hpp"
#include "model/reading.hpp"
#include "model/text.hpp"
#include "model/writing.hpp"

namespace mcplan::model {
namespace {

void require_small(const std::string& content) {
  if (content.size() > max_json_plan_bytes)
    throw InvalidPlan("", "may have " + size_text(max_json_plan_bytes) + " at most as JSON",
                      std::to_string(content.size()) + " bytes");
}

}  // namespace

std::string plan_json(Value fields, const PlanKind& kind) {
  Value out;
  out.set("kind", kind.kind);
  out.set("format", kind.format);
  out.set("units", kind.units);
  out.set("mcplan", MCPLAN_VERSION);
  for (Entry& entry : *fields.get<Value::Table>()) out.set(std::move(entry.key), std::move(entry.value));
  std::string content = json_text(out, 1, 2) + "\n";
  require_small(content);
  return content;
}

Value parse_plan_json(const std::string& content) {
  require_small(content);
  try {
    return parse_json(content);
  } catch (const std::invalid_argument& bad) {
    throw InvalidPlan("", "must be JSON", printable(bad.what()));
  } catch (const std::length_error& bad) {
    throw InvalidPlan("", bad.what(), "more");
  }
}

bool is_of(const Value& data, const PlanKind& kind) {
  const auto* const said = data.find("kind") ? data.find("kind")->get<std::string>() : nullptr;
  return said && *said == kind.kind;
}

Value plan_fields(Value data, const PlanKind& kind) {
  auto* const table = data.get<Value::Table>();
  if (!table) throw InvalidPlan("", "must be a JSON object", shown(data));
  const auto said = [&](const char* key) { return data.find(key) ? shown(*data.find(key)) : "nothing"; };
  if (!is_of(data, kind))
    throw InvalidPlan("kind", "must be " + shown(std::string(kind.kind)) + ": " + kind.meaning, said("kind"));
  const auto* const format = data.find("format") ? data.find("format")->get<std::int64_t>() : nullptr;
  if (!format || *format != kind.format)
    throw InvalidPlan("format", "must be " + text(kind.format) + " for this version of mcplan", said("format"));
  Value::Table fields;
  for (Entry& entry : *table)
    if (entry.key != "kind" && entry.key != "format" && entry.key != "units" && entry.key != "mcplan")
      fields.push_back(std::move(entry));
  return fields;
}

std::string read_plan_json(const std::string& path) {
  std::string content = read_file(path, max_plan_bytes, "", path);
  if (content.rfind("PK", 0) == 0)
    throw InvalidPlan("", "must be JSON: mcplan.Plan.load and save of Python turn .npz into it", "a zip archive");
  return content;
}

void write_plan_json(const std::string& content, const std::string& path) {
  if (path.size() < 5 || path.compare(path.size() - 5, 5, ".json") != 0)
    throw InvalidInput("path", "must end in .json", printable(path));
  write_whole(content, path);
}

}  // namespace mcplan::model
