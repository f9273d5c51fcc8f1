#pragma once

#include <string>

#include "rhp/walker.hpp"

namespace mcplan::rhp {

/// Foothold margins that leave a way: where a step from one surface to another is in reach with less than
/// options.foothold_margin_m around the soles alone, the margins on both surfaces become a half, a quarter or nothing
/// of it. `state`: where the feet are before the first step.
struct FootholdMargins {
  FootholdMargins(const Walker& walker, const State& state, const Footsteps& footsteps);

  Walker::MarginRatios ratios;  ///< those below 1
  std::string yielded;          ///< which they are, in a sentence; empty: none
  std::string out_of_reach;     ///< the first step that is in reach with no margin either; empty: none
};

}  // namespace mcplan::rhp
