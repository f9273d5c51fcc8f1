#pragma once

#include <vector>

#include "ddp/contact_sequence.hpp"

namespace mcplan::ddp {

/// Valid sequences in which all that follows some phase is another: a phase later where one before it is divided in
/// two, earlier where one is left out (a phase elsewhere makes up for it), or with two end-effectors exchanged.
/// swing_edits() keeps all other swings as they are. Start and goal states stay. No duplicates, fixed order.
std::vector<ContactSequence> tail_edits(const ContactRules& rules, const ContactSequence& sequence);

}  // namespace mcplan::ddp
