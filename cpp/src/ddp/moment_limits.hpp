#pragma once

#include "ddp/layout.hpp"
#include "ddp/problem.hpp"

namespace mcplan::ddp {

/// What friction under a sole makes of its force: largest moment about the normal per normal force [length], with the
/// sole's half width for a lever. Infinite for moments that nothing bears down on (grasp, points).
double torsion_arm(const Problem& problem, int l, int surface);

/// Whether a moment input is one that a contact with this surface can have: with Model::wrench about its normal alone.
bool about_normal(const Problem& problem, const Layout::Moment& moment, int surface);

}  // namespace mcplan::ddp
