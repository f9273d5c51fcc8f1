#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mcplan/base/error.hpp"
#include "value.hpp"

namespace mcplan::model {

/// Where something stands, e.g. "surfaces[2].vertices"; its text is made when there is something to say.
class Place {
 public:
  Place() = default;
  Place(const Place& above, std::string_view key) : above_(&above), key_(key) {}
  Place(const Place& above, std::size_t index) : above_(&above), index_(static_cast<long>(index)) {}

  std::string text() const;

 private:
  const Place* above_ = nullptr;
  std::string_view key_;
  long index_ = -1;
};

/// What is wrong with data.
class Findings {
 public:
  void add(const std::string& field, const std::string& rule, const std::string& value);
  void add(const Place& at, const std::string& rule, const std::string& value) { add(at.text(), rule, value); }
  void add(const InvalidInput& found);

  /// A field without a usable value, of which another finding tells.
  void lacks(const std::string& field) { broken_.push_back(field); }

  bool empty() const { return all_.empty(); }

  /// Whether there are so many that nobody needs to know of more: a hundred.
  bool are_many() const;

  /// Whether nothing is wrong with a field, what it lies in, or what lies in it. With a hundred findings nothing is
  /// sound: relations between fields need not be looked at then.
  bool sound(const std::string& field) const;

  /// Makes a check that throws InvalidInput, if all these fields are sound.
  template <class Check>
  void check(const std::vector<std::string>& fields, const Check& check) {
    for (const std::string& field : fields)
      if (!sound(field)) return;
    try {
      check();
    } catch (const InvalidInput& found) {
      add(found);
    }
  }

  /// Throws the first finding with the others, if there are any.
  template <class Error>
  void raise(const std::string& source = "") const {
    if (all_.empty()) return;
    const auto made = [&](const InvalidInput& each) {
      return Error(each.field(), each.rule(), each.value(), each.source().empty() ? source : each.source());
    };
    Error out = made(all_.front());
    for (std::size_t i = 1; i < all_.size(); ++i) out.add(made(all_[i]));
    throw out;
  }

 private:
  std::vector<InvalidInput> all_;
  std::vector<std::string> broken_;
};

/// Throws an error as one of another kind; `source`: the file of those that name none.
template <class Error>
[[noreturn]] void throw_as(const InvalidInput& error, const std::string& source) {
  Findings found;
  found.add(error);
  found.raise<Error>(source);
  throw error;
}

}  // namespace mcplan::model
