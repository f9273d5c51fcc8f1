#pragma once

#include <map>
#include <string>
#include <vector>

namespace mcplan::model {

/// Names of the entries of a list, by which a file names them.
struct NameList {
  std::vector<std::string> names;
  bool is_complete = true;  ///< no: some of them are not known, and what is not among them may be right
};
using NameLists = std::map<std::string, NameList>;

/// The names of the entries of a list in memory.
template <class Items>
NameList names_of(const Items& items) {
  NameList out;
  for (const auto& item : items) out.names.push_back(item.name);
  return out;
}

}  // namespace mcplan::model
