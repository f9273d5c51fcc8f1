#include "ddp/edits.hpp"

#include <algorithm>
#include <set>

#include "ddp/constants.hpp"

namespace mcplan::ddp {
namespace {

/// Steps first..last in which an end-effector is free between contacts `before` and `after`.
struct SwingSpan {
  int end, first, last;
  int before, after;
};

std::vector<SwingSpan> swing_spans(const ContactSequence& sequence) {
  std::vector<SwingSpan> out;
  const int n = static_cast<int>(sequence.size()) - 1;
  for (std::size_t l = 0; l < sequence[0].size(); ++l)
    for (int k = 1; k < n; ++k) {
      if (sequence[k][l] != kFree || sequence[k - 1][l] == kFree) continue;
      int last = k;
      while (last < n && sequence[last + 1][l] == kFree) ++last;
      // A stretch that runs to the end is not a swing.
      if (last < n) out.push_back({static_cast<int>(l), k, last, sequence[k - 1][l], sequence[last + 1][l]});
      k = last;
    }
  return out;
}

class Editor {
 public:
  Editor(const ContactRules& rules, const ContactSequence& sequence) : rules_(rules), sequence_(sequence) {
    seen_.insert(sequence);
  }

  void keep(ContactSequence edited) {
    if (edited.front() != sequence_.front() || edited.back() != sequence_.back() || !rules_.valid(edited)) return;
    if (seen_.insert(edited).second) found_.push_back(std::move(edited));
  }

  /// The sequence with a swing moved to other steps; its contacts grow or shrink to meet it.
  ContactSequence moved(const SwingSpan& s, int first, int last) const {
    ContactSequence out = sequence_;
    for (int k = std::min(first, s.first); k <= std::max(last, s.last); ++k)
      out[k][s.end] = k < first ? s.before : (k > last ? s.after : kFree);
    return out;
  }

  std::vector<ContactSequence> take() { return std::move(found_); }

 private:
  const ContactRules& rules_;
  const ContactSequence& sequence_;
  std::set<ContactSequence> seen_;
  std::vector<ContactSequence> found_;
};

}  // namespace

std::vector<ContactSequence> swing_edits(const ContactRules& rules, const ContactSequence& sequence) {
  const int n = static_cast<int>(sequence.size()) - 1;
  const std::vector<SwingSpan> swings = swing_spans(sequence);
  Editor editor(rules, sequence);
  for (const SwingSpan& s : swings) {
    for (int by : kSwingShifts)
      if (s.first + by > 0 && s.last + by < n) editor.keep(editor.moved(s, s.first + by, s.last + by));
    if (s.before == s.after) {
      ContactSequence without = sequence;
      for (int k = s.first; k <= s.last; ++k) without[k][s.end] = s.before;
      editor.keep(without);
      // The same steps, another end-effector that stands all the while.
      for (int other = 0; other < rules.end_effector_count(); ++other) {
        if (other == s.end) continue;
        const int stands = sequence[s.first - 1][other];
        bool throughout = stands != kFree;
        for (int k = s.first; k <= s.last + 1; ++k) throughout = throughout && sequence[k][other] == stands;
        if (!throughout) continue;
        ContactSequence handed = without;
        for (int k = s.first; k <= s.last; ++k) handed[k][other] = kFree;
        editor.keep(handed);
      }
    }
    for (const SwingSpan& t : swings) {
      if (t.end <= s.end || s.before != s.after || t.before != t.after || s.before != t.before) continue;
      if (t.last < s.first - kExchangeSteps || t.first > s.last + kExchangeSteps) continue;
      ContactSequence exchanged = sequence;
      for (int k = s.first; k <= s.last; ++k) exchanged[k][s.end] = s.before;
      for (int k = t.first; k <= t.last; ++k) exchanged[k][t.end] = t.before;
      for (int k = t.first; k <= t.last; ++k) exchanged[k][s.end] = kFree;
      for (int k = s.first; k <= s.last; ++k) exchanged[k][t.end] = kFree;
      editor.keep(exchanged);
    }
  }
  return editor.take();
}

}  // namespace mcplan::ddp
