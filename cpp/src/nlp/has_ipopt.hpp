#pragma once

namespace mcplan::nlp {

/// Whether Ipopt is linked. Where it is not (CMake's MCPLAN_IPOPT=OFF), its solve() throws InvalidOptions.
bool has_ipopt();

}  // namespace mcplan::nlp
