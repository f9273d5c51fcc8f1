#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace mcplan::model {

struct Entry;

/// What stands in a file: a tree of plain values. Tables keep the order of their keys.
class Value {
 public:
  using Array = std::vector<Value>;
  using Table = std::vector<Entry>;
  struct Null {};
  /// What no field takes, as text for messages: a date, a whole number of more than 64 bits.
  struct Other {
    std::string text;
  };

  Value() = default;
  Value(bool value) : data_(value) {}
  Value(int value) : data_(std::int64_t{value}) {}
  Value(std::int64_t value) : data_(value) {}
  Value(double value) : data_(value) {}
  Value(const char* value) : data_(std::string(value)) {}
  Value(std::string value) : data_(std::move(value)) {}
  Value(Other value) : data_(std::move(value)) {}
  Value(Array value);
  Value(Table value);

  template <class T>
  const T* get() const {
    return std::get_if<T>(&data_);
  }
  template <class T>
  T* get() {
    return std::get_if<T>(&data_);
  }

  /// Entry of a table, or nullptr where there is none or this is no table.
  const Value* find(const std::string& key) const;

  /// Appends to a table, which this becomes if it is null.
  void set(std::string key, Value value);

 private:
  std::variant<Null, bool, std::int64_t, double, std::string, Other, Array, Table> data_;
};

struct Entry {
  std::string key;
  Value value;
};

inline Value::Value(Array value) : data_(std::move(value)) {}
inline Value::Value(Table value) : data_(std::move(value)) {}

}  // namespace mcplan::model
