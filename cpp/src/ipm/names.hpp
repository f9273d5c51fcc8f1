#pragma once

#include "mcplan/nlp/solver.hpp"
#include "model/fields.hpp"

namespace mcplan::model {

template <>
struct Names<nlp::Solver> {
  static constexpr const char* name = "Solver";
  static constexpr const char* meaning = "Which solver a planner hands its nonlinear programs to.";
  static constexpr Choice<nlp::Solver> all[] = {
      {"ipopt", nlp::Solver::ipopt, "Ipopt with MUMPS: the reference."},
      {"ipm", nlp::Solver::ipm, "The interior-point kernel, which goes stage by stage."},
      {"auto", nlp::Solver::automatic, "The kernel; where it does not converge, Ipopt with what is left of the time."}};
};

}  // namespace mcplan::model
