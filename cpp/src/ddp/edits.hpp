#pragma once

#include <vector>

#include "ddp/contact_sequence.hpp"

namespace mcplan::ddp {

/// Valid sequences that differ from `sequence` by moving whole swings (stretches in which an end-effector is free): a
/// swing shifted by one or two steps, left out, handed to another end-effector, or exchanged with another one's. Single
/// switches (Tazaki's neighbourhood) cannot reach these without passing through worse sequences. Start and goal states
/// stay. No duplicates, fixed order.
std::vector<ContactSequence> swing_edits(const ContactRules& rules, const ContactSequence& sequence);

}  // namespace mcplan::ddp
