#include "value.hpp"

namespace mcplan::model {

const Value* Value::find(const std::string& key) const {
  if (const Table* const table = get<Table>())
    for (const Entry& entry : *table)
      if (entry.key == key) return &entry.value;
  return nullptr;
}

void Value::set(std::string key, Value value) {
  if (get<Null>()) data_ = Table();
  get<Table>()->push_back({std::move(key), std::move(value)});
}

}  // namespace mcplan::model
