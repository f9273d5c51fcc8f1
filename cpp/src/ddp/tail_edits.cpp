#include "ddp/tail_edits.hpp"

#include <set>
#include <utility>

namespace mcplan::ddp {

std::vector<ContactSequence> tail_edits(const ContactRules& rules, const ContactSequence& sequence) {
  const int n = static_cast<int>(sequence.size()) - 1;
  std::vector<ContactSequence> out;
  std::set<ContactSequence> seen{sequence};
  const auto keep = [&](ContactSequence edited) {
    if (rules.valid(edited) && seen.insert(edited).second) out.push_back(std::move(edited));
  };
  for (int left_out = 1; left_out < n; ++left_out)
    for (int divided = 0; divided < n; ++divided) {
      if (divided == left_out) continue;
      ContactSequence edited = sequence;
      edited.erase(edited.begin() + left_out);
      const auto at = edited.begin() + (divided < left_out ? divided : divided - 1);
      edited.insert(at, ContactState(*at));
      keep(std::move(edited));
    }
  for (int l = 0; l < rules.end_effector_count(); ++l)
    for (int m = l + 1; m < rules.end_effector_count(); ++m)
      for (int from = 1; from < n; ++from) {
        ContactSequence edited = sequence;
        for (int k = from; k < n; ++k) std::swap(edited[k][l], edited[k][m]);
        keep(std::move(edited));
      }
  return out;
}

}  // namespace mcplan::ddp
