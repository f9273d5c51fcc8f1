#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mcplan/base/status.hpp"
#include "mcplan/plan/plan.hpp"

namespace mcplan {

/// A constraint and the place where a plan breaks it most (or comes closest to breaking it).
struct Violation {
  std::string name;          ///< e.g. "friction"; the list stands in checker.hpp
  int phase = -1;            ///< -1: not tied to a phase
  std::string end_effector;  ///< empty: not tied to one
  double time_s = 0.0;
  double value = 0.0;      ///< amount beyond the limit, in `unit`; negative: margin left
  double tolerance = 0.0;  ///< largest value that is still accepted
  std::string unit;
  std::string surface = {};  ///< whose solid a warning is about; empty: not tied to one

  /// "friction at left_foot in phase 7 (t = 2.61 s): 0.08 over the limit (tolerance 0.001)"
  std::string to_string() const;
};

/// One row of the iteration table.
struct Iteration {
  int index = 0;
  double cost = 0.0;            ///< total, at the weight of this iteration
  double merit = 0.0;           ///< cost + rho |defect|, what the line search lowers
  double defect = 0.0;          ///< largest dynamics defect (non-dimensional)
  double contact_weight = 0.0;  ///< w_compl
  double proximal_weight = 0.0;
  double step = 0.0;                       ///< accepted step length
  int switches = 0;                        ///< contact switches accepted in this iteration
  int neighbours = 0;                      ///< candidates priced
  std::vector<std::vector<int>> sequence;  ///< after this iteration (steps x end-effectors), if history is recorded
};

/// Where the plan of a replan comes from.
enum class PlanFrom {
  search,          ///< no replan
  same_sequence,   ///< the contacts of the plan under way, as measured, with what was added at its end
  other_sequence,  ///< another step was put in
  recovery,        ///< steps that catch a push, and a stand wherever that is
  stop,            ///< a stand as soon as may be, not the goal: nothing that leads on can be followed
  previous_plan,   ///< what is left of the plan under way, as it was planned: nothing better was found in time
};

/// How a solve went.
struct Report {
  Status status = Status::numerical_failure;
  std::string message;
  int iterations = 0;
  int switches = 0;
  double time_s = 0.0;                     ///< wall clock of the whole solve
  std::map<std::string, double> timing_s;  ///< wall clock by part
  double cost = 0.0;
  std::map<std::string, double> cost_terms;
  Violation worst_violation;        ///< largest value / tolerance over all constraints
  std::vector<Violation> warnings;  ///< of the checker about the plan: CheckResult::warnings
  std::map<std::string, double>
      friction_use;  ///< largest tangential over normal force by end-effector, grasps included
  std::uint64_t seed = 0;
  int threads = 1;
  int parallel_loops = 0;                   ///< loops over neighbours that were shared out over threads
  PlanFrom plan_from = PlanFrom::search;    ///< of a replan: where its plan comes from
  double kept_until_s = 0.0;                ///< of a replan: time until which its plan keeps all limits
  double checked_until_s = 0.0;             ///< of a replan: how far the checker looked; later is as accepted before
  std::vector<Violation> start_violations;  ///< of a replan: what the measured state violates by itself, worst first
  std::string paper_verdict;  ///< Method::paper: how the published algorithm ended by its own measures; else empty
  double paper_cost = 0.0;    ///< Method::paper: its objective at its last iterate, before contacts are made exact
  std::string version;
  std::vector<Iteration> history;  ///< one row an iteration
};

struct PlanResult {
  Plan plan;
  Report report;
};

}  // namespace mcplan
