#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "value.hpp"

namespace mcplan::model {

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr std::size_t any_number = 1'000'000;

/// What the numbers, names and lists of a field may be. Numbers are finite unless `may_be_infinite`.
struct Rules {
  double low = -unbounded, high = unbounded;
  bool above_low = false, below_high = false;  ///< low itself is out, high itself is out
  bool both_ends = false;                      ///< messages name low and high together
  bool grows = false;                          ///< of a Range: max is greater than min, not the same
  bool may_be_infinite = false;
  bool not_empty = false;  ///< texts have a character at least
  std::size_t min_entries = 0, max_entries = any_number;
  const char* list = nullptr;  ///< whole numbers are indices into it; files have the names that stand there
  const char* what = nullptr;  ///< what messages call its entries: "a body"
};

/// A member of a struct: all that reading, writing, checking, binding and documenting it takes.
template <class T, class M>
struct Field {
  using Owner = T;
  using Member = M;

  const char* name;  ///< of the member, in C++ and Python
  M T::*member;
  const char* unit;               ///< "" where it has none
  const char* meaning;            ///< one line
  const char* key;                ///< in files
  const char* earlier = nullptr;  ///< key of files that an earlier version wrote
  Rules rules{};
  bool is_required = false;   ///< files must have it
  bool is_always = false;     ///< written also where it is at its default
  bool is_elsewhere = false;  ///< files say it by FileKeys

  constexpr Field required() const {
    return with([](Field& f) { f.is_required = true; });
  }
  constexpr Field always_written() const {
    return with([](Field& f) { f.is_always = true; });
  }
  constexpr Field positive() const { return above(0.0); }
  constexpr Field not_negative() const { return at_least(0.0); }
  constexpr Field above(double low) const {
    return with([&](Field& f) { f.rules.low = low, f.rules.above_low = true; });
  }
  constexpr Field at_least(double low) const {
    return with([&](Field& f) { f.rules.low = low; });
  }
  constexpr Field at_most(double high) const {
    return with([&](Field& f) { f.rules.high = high; });
  }
  constexpr Field below(double high) const {
    return with([&](Field& f) { f.rules.high = high, f.rules.below_high = true; });
  }
  /// "must lie in [low, high]"; an end that is out is said by above() or below() after it.
  constexpr Field within(double low, double high) const {
    return with([&](Field& f) { f.rules.low = low, f.rules.high = high, f.rules.both_ends = true; });
  }
  constexpr Field growing() const {
    return with([](Field& f) { f.rules.grows = true; });
  }
  constexpr Field or_infinite() const {
    return with([](Field& f) { f.rules.may_be_infinite = true; });
  }
  constexpr Field not_empty() const {
    return with([](Field& f) { f.rules.not_empty = true; });
  }
  constexpr Field entries(std::size_t min, std::size_t max) const {
    return with([&](Field& f) { f.rules.min_entries = min, f.rules.max_entries = max; });
  }
  constexpr Field in_files(const char* other) const {
    return with([&](Field& f) { f.key = other; });
  }
  constexpr Field formerly(const char* other) const {
    return with([&](Field& f) { f.earlier = other; });
  }
  constexpr Field by_file_keys() const {
    return with([](Field& f) { f.is_elsewhere = true; });
  }
  constexpr Field index_of(const char* list, const char* what) const {
    return with([&](Field& f) { f.rules.list = list, f.rules.what = what; });
  }

 private:
  template <class Change>
  constexpr Field with(Change change) const {
    Field out = *this;
    change(out);
    return out;
  }
};

template <class T, class M>
constexpr Field<T, M> field(const char* name, M T::*member, const char* unit, const char* meaning) {
  return {name, member, unit, meaning, name};
}

/// The table of a struct, specialised beside it:
///     static constexpr const char* name, * meaning;   of the struct
///     static constexpr auto all = std::make_tuple(field(...), ...);
template <class T>
struct Fields;

/// Keys that files have for the members of a struct that are `by_file_keys`:
///     using Type = ...;     a struct with a table of its own
/// They stand where the first of these members would.
template <class T>
struct FileKeys;

/// A struct as it stands in a file, where that is more than its members: what the keys mean is code.
template <class T>
struct InFile {
  T value;
  typename FileKeys<T>::Type keys;
};

template <class T>
struct Fields<InFile<T>> {
  static constexpr const char* name = Fields<T>::name;
  static constexpr const char* meaning = Fields<T>::meaning;
};

/// A thing by its built-in name or path, or as the table itself, whose content `T` is read by those who use it.
template <class T>
struct NameOr {
  std::string name;
  Value table;
};

/// Names of the values of an enum: static constexpr std::pair<const char*, E> all[], or Choice<E> all[] with a line of
/// meaning each and, for the Python class, `name` and `meaning` of the enum itself.
template <class E>
struct Names;
template <class E>
using Choice = std::tuple<const char*, E, const char*>;

template <class T, class = void>
struct HasFields : std::false_type {};
template <class T>
struct HasFields<T, std::void_t<decltype(Fields<T>::all)>> : std::true_type {};

template <class T>
struct IsInFile : std::false_type {};
template <class T>
struct IsInFile<InFile<T>> : std::true_type {};

template <class T>
struct IsNameOr : std::false_type {};
template <class T>
struct IsNameOr<NameOr<T>> : std::true_type {
  using Type = T;
};

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};

template <class T>
struct IsStructs : std::false_type {};
template <class T>
struct IsStructs<std::vector<T>> : std::bool_constant<HasFields<T>::value || IsInFile<T>::value> {};

template <class T>
struct IsList : std::false_type {};
template <class T>
struct IsList<std::vector<T>> : std::bool_constant<!std::is_same_v<T, bool>> {};

template <class T>
struct IsMap : std::false_type {};
template <class T, class Less>
struct IsMap<std::map<std::string, T, Less>> : std::true_type {};

/// What is called back, such as a logger: no part of the value of the struct that holds it.
template <class T>
struct IsCallback : std::false_type {};
template <class R, class... A>
struct IsCallback<std::function<R(A...)>> : std::true_type {};

/// Calls visit(field) for each field of a struct, in the order of the table.
template <class T, class Visit>
void for_each_field(Visit&& visit) {
  std::apply([&](const auto&... fields) { (visit(fields), ...); }, Fields<T>::all);
}

/// Calls visit(field, member, member) for all that stands in a file for two objects of a struct.
template <class T, class Visit>
void for_each_key(T& object, const std::remove_const_t<T>& other, Visit&& visit) {
  using Plain = std::remove_const_t<T>;
  if constexpr (IsInFile<Plain>::value) {
    using Struct = decltype(Plain::value);
    bool are_keys_done = false;
    for_each_field<Struct>([&](const auto& f) {
      if (!f.is_elsewhere)
        visit(f, object.value.*f.member, other.value.*f.member);
      else if (!std::exchange(are_keys_done, true))
        for_each_key(object.keys, other.keys, visit);
    });
  } else {
    for_each_field<Plain>([&](const auto& f) { visit(f, object.*f.member, other.*f.member); });
  }
}

/// The same for one object.
template <class T, class Visit>
void for_each_key(T& object, Visit&& visit) {
  for_each_key(object, object, [&](const auto& f, auto& member, const auto&) { visit(f, member); });
}

/// Names of the members of a struct.
template <class T>
std::vector<std::string> member_names() {
  std::vector<std::string> out;
  for_each_field<T>([&](const auto& f) { out.push_back(f.name); });
  return out;
}

/// Whether two values are the same, number by number, whoever listens to them.
template <class V>
bool equal(const V& a, const V& b) {
  if constexpr (IsInFile<V>::value) {
    return equal(a.value, b.value) && equal(a.keys, b.keys);
  } else if constexpr (IsNameOr<V>::value) {
    return false;
  } else if constexpr (HasFields<V>::value) {
    bool same = true;
    for_each_field<V>([&](const auto& f) { same = same && equal(a.*f.member, b.*f.member); });
    return same;
  } else if constexpr (IsMap<V>::value) {
    bool same = a.size() == b.size();
    for (auto i = a.begin(), j = b.begin(); same && i != a.end(); ++i, ++j)
      same = i->first == j->first && equal(i->second, j->second);
    return same;
  } else if constexpr (std::is_base_of_v<Eigen::MatrixBase<V>, V>) {
    return a.rows() == b.rows() && a.cols() == b.cols() && a == b;
  } else if constexpr (IsList<V>::value) {
    bool same = a.size() == b.size();
    for (std::size_t i = 0; same && i < a.size(); ++i) same = equal(a[i], b[i]);
    return same;
  } else if constexpr (IsCallback<V>::value) {
    return true;
  } else {
    return a == b;
  }
}

}  // namespace mcplan::model
