#include "findings.hpp"

#include <algorithm>

#include "text.hpp"

namespace mcplan::model {
namespace {

constexpr std::size_t max_besides = 100;

/// Whether a field is another one or lies in it.
bool is_within(const std::string& inner, const std::string& outer) {
  if (outer.empty()) return true;
  if (inner.compare(0, outer.size(), outer) != 0) return false;
  return inner.size() == outer.size() || inner[outer.size()] == '.' || inner[outer.size()] == '[';
}

}  // namespace

std::string Place::text() const {
  if (!above_) return "";
  std::string out = above_->text();
  if (index_ >= 0) return out + "[" + std::to_string(index_) + "]";
  return out + (out.empty() ? "" : ".") + printable(key_);
}

void Findings::add(const std::string& field, const std::string& rule, const std::string& value) {
  all_.emplace_back(field, rule, value);
}

void Findings::add(const InvalidInput& found) {
  all_.emplace_back(found.field(), found.rule(), found.value(), found.source());
  for (const InvalidInput& other : found.others()) all_.push_back(other);
}

bool Findings::are_many() const { return all_.size() > max_besides; }

bool Findings::sound(const std::string& field) const {
  if (are_many()) return false;
  const auto meets = [&](const std::string& other) { return is_within(field, other) || is_within(other, field); };
  return std::none_of(all_.begin(), all_.end(), [&](const InvalidInput& found) { return meets(found.field()); }) &&
         std::none_of(broken_.begin(), broken_.end(), meets);
}

}  // namespace mcplan::model
