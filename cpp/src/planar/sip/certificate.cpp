#include "mcplan/planar/sip/certificate.hpp"

#include <cstdio>

namespace mcplan::sip {
namespace {

const char* word(Proof proof) {
  switch (proof) {
    case Proof::proved:
      return "proved";
    case Proof::violated:
      return "violated";
    case Proof::not_proved:
      break;
  }
  return "not proved";
}

std::string line(const ProvedConstraint& c) {
  char text[256];
  const std::string unit = c.unit.empty() || c.unit == "-" ? "" : " " + c.unit;
  if (c.phase < 0) {
    std::snprintf(text, sizeof(text), "  %-10s  %-14s  nothing to prove\n", word(c.proof), c.name.c_str());
    return text;
  }
  const bool violated = c.proof == Proof::violated;
  std::snprintf(text, sizeof(text), "  %-10s  %-14s  at %s %.4g%s, tolerance %.4g; %s%sphase %d, t = %.4f s\n",
                word(c.proof), c.name.c_str(), violated ? "least" : "most", violated ? c.reached : c.bound,
                unit.c_str(), c.tolerance, c.where.c_str(), c.where.empty() ? "" : ", ", c.phase, c.time_s);
  return text;
}

}  // namespace

bool Certificate::proved() const {
  for (const ProvedConstraint& c : constraints)
    if (c.proof != Proof::proved) return false;
  return !constraints.empty();
}

std::string Certificate::to_string() const {
  int open = 0, violated = 0;
  for (const ProvedConstraint& c : constraints) {
    open += c.proof == Proof::not_proved;
    violated += c.proof == Proof::violated;
  }
  std::string out;
  if (proved())
    out = "certified: every constraint holds at every instant";
  else
    out = "not certified: " + std::to_string(violated) + " violated, " + std::to_string(open) + " not proved";
  char text[160];
  std::snprintf(text, sizeof(text), " (%d pieces of time, %.3f s; floating-point allowance %.1e of a tolerance)\n",
                subdivisions, time_s, rounding);
  out += text;
  for (const ProvedConstraint& c : constraints) out += line(c);
  return out;
}

}  // namespace mcplan::sip
