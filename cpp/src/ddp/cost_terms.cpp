#include "ddp/cost_terms.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

namespace mcplan::ddp {

// The build writes a line MCPLAN_COST_TERM(name) for each file of costs/.
namespace cost {
#define MCPLAN_COST_TERM(name) const CostTerm& name();
#include "mcplan_cost_terms.inc"
#undef MCPLAN_COST_TERM
}  // namespace cost

namespace {

constexpr int kScopes = 6;

/// A term with its index in cost_terms().
struct Entry {
  int index;
  const CostTerm* term;
};
using Entries = std::vector<Entry>;

std::vector<const CostTerm*> sorted_terms() {
  std::vector<const CostTerm*> terms{
#define MCPLAN_COST_TERM(name) &cost::name(),
#include "mcplan_cost_terms.inc"
#undef MCPLAN_COST_TERM
  };
  std::sort(terms.begin(), terms.end(), [](const CostTerm* a, const CostTerm* b) {
    if (a->scope() != b->scope()) return a->scope() < b->scope();
    return a->order() != b->order() ? a->order() < b->order() : std::strcmp(a->name(), b->name()) < 0;
  });
  if (terms.size() > kCostTermsMax) throw std::logic_error("more cost terms than kCostTermsMax");
  return terms;
}

/// The terms of a scope, in their order.
const Entries& terms_of(Scope scope) {
  static const std::array<Entries, kScopes> by_scope = [] {
    std::array<Entries, kScopes> out;
    for (std::size_t i = 0; i < cost_terms().size(); ++i)
      out[static_cast<std::size_t>(cost_terms()[i]->scope())].push_back({static_cast<int>(i), cost_terms()[i]});
    return out;
  }();
  return by_scope[static_cast<std::size_t>(scope)];
}

}  // namespace

double CostTerm::weight(const Weights& weights) const {
  const auto given = weights.own.find(name_);
  return given == weights.own.end() ? own_weight_.usual : given->second;
}

double CostTerm::of_state(const Problem&, const ContactState&) const { return 0.0; }

double CostTerm::of_change(const Problem&, const ContactState&, const ContactState&) const { return 0.0; }

const std::vector<const CostTerm*>& cost_terms() {
  static const std::vector<const CostTerm*> terms = sorted_terms();
  return terms;
}

int cost_term_index(const std::string& name) {
  for (std::size_t i = 0; i < cost_terms().size(); ++i)
    if (name == cost_terms()[i]->name()) return static_cast<int>(i);
  return -1;
}

void write_terms(Scope scope, const StepView& step, Rows& rows) {
  for (const auto& [index, term] : terms_of(scope)) {
    if (!term->applies(step)) continue;
    rows.begin(index);
    term->write(step, rows);
  }
}

double state_cost(const Problem& problem, const ContactState& state) {
  double cost = 0.0;
  for (const Entry& entry : terms_of(Scope::state)) cost += entry.term->of_state(problem, state);
  return cost;
}

double change_cost(const Problem& problem, const ContactState& from, const ContactState& to) {
  double cost = 0.0;
  for (const Entry& entry : terms_of(Scope::change)) cost += entry.term->of_change(problem, from, to);
  return cost;
}

double change_cost(const Problem& problem, const ContactSequence& sequence) {
  double cost = 0.0;
  for (std::size_t k = 1; k < sequence.size(); ++k) cost += change_cost(problem, sequence[k - 1], sequence[k]);
  return cost;
}

void write_state_cost(const Problem& problem, const ContactState& state, Rows& rows) {
  for (const auto& [index, term] : terms_of(Scope::state)) {
    rows.begin(index);
    rows.add_constant(term->of_state(problem, state));
  }
}

void write_change_cost(const Problem& problem, const ContactSequence& sequence, Rows& rows) {
  for (const auto& [index, term] : terms_of(Scope::change)) {
    double cost = 0.0;
    for (std::size_t k = 1; k < sequence.size(); ++k) cost += term->of_change(problem, sequence[k - 1], sequence[k]);
    rows.begin(index);
    rows.add_constant(cost);
  }
}

}  // namespace mcplan::ddp
