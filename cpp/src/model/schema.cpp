#include "schema.hpp"

namespace mcplan::model {

Value number_schema(const Rules& rules) {
  Value out;
  out.set("type", "number");
  if (rules.low > -unbounded) out.set(rules.above_low ? "exclusiveMinimum" : "minimum", rules.low);
  if (rules.high < unbounded) out.set(rules.below_high ? "exclusiveMaximum" : "maximum", rules.high);
  return out;
}

Value whole_schema(const Rules& rules) {
  Value out;
  out.set("type", "integer");
  if (rules.low > -unbounded) out.set("minimum", static_cast<std::int64_t>(rules.low));
  if (rules.high < unbounded) out.set("maximum", static_cast<std::int64_t>(rules.high));
  return out;
}

Rules named_rules() {
  Rules rules;
  rules.not_empty = true;
  return rules;
}

Value text_schema(const Rules& rules) {
  Value out;
  out.set("type", "string");
  if (rules.not_empty) out.set("minLength", 1);
  return out;
}

Value list_schema(Value items, std::size_t min_entries, std::size_t max_entries) {
  Value out;
  out.set("type", "array");
  out.set("items", std::move(items));
  if (min_entries > 0) out.set("minItems", static_cast<std::int64_t>(min_entries));
  if (max_entries < any_number) out.set("maxItems", static_cast<std::int64_t>(max_entries));
  return out;
}

}  // namespace mcplan::model
