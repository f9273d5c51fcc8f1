#include "ddp/cost_terms.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>

#include "support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;

}  // namespace

TEST_CASE("every term has a name of its own, by which it is found") {
  std::set<std::string> names;
  for (std::size_t i = 0; i < cost_terms().size(); ++i) {
    const std::string name = cost_terms()[i]->name();
    CHECK(names.insert(name).second);
    CHECK(cost_term_index(name) == static_cast<int>(i));
  }
  CHECK(names.size() >= 16);
  CHECK(cost_term_index("no such term") == -1);
}

TEST_CASE("a term's own weight is its usual one until another is given by its name") {
  Weights weights;
  for (const CostTerm* term : cost_terms()) {
    if (!term->has_own_weight()) continue;
    CHECK(term->weight(weights) == term->own_weight().usual);
    weights.own[term->name()] = 7.0;
    CHECK(term->weight(weights) == 7.0);
  }
  CHECK(weights.own.size() >= 2);
}

TEST_CASE("terms that depend on the contact state are asked about the states that they are for") {
  const Problem problem(scenes::gap_with_rail(), scenes::humanoid44(), phases(6));
  const Layout& at = problem.layout;
  const Pendulum pendulum(at, problem.inertia, problem.options.stiffness_input, problem.model);
  Random random(71);
  const VectorXd x = problem.reference.x[2] + noise(random, at.nx(), 0.5), u = noise(random, at.nu(), 5.0);
  Instants instants;
  instants.of(problem, pendulum, x, u);
  const auto written = [&](Scope scope, const VectorXd* input, double interior) {
    Schedule weights = schedule(3.0, interior, 0.0);
    StepView step{problem, pendulum, weights, 2, x, input, instants};
    step.l = 1;
    step.surface = scope == Scope::contact ? 0 : kFree;
    Rows rows(at.nz(), false);
    write_terms(scope, step, rows);
    std::set<std::string> names;
    for (std::size_t i = 0; i < rows.terms().size(); ++i)
      if (rows.terms()[i] > 0.0) names.insert(cost_terms()[i]->name());
    return names;
  };
  const std::set<std::string> free = written(Scope::free, &u, 100.0), contact = written(Scope::contact, &u, 100.0);
  CHECK(free.count("free"));
  CHECK(contact.count("contact"));
  CHECK(contact.count("friction"));
  for (const std::string& name : free) CHECK_FALSE(contact.count(name));
  // In discovery there is nothing between the knots, at the last knot there are no inputs.
  CHECK_FALSE(written(Scope::contact, &u, 0.0).count("friction"));
  CHECK(written(Scope::contact, nullptr, 100.0) == std::set<std::string>{"contact"});
  CHECK_FALSE(written(Scope::free, nullptr, 100.0).count("free"));
}

TEST_CASE("the constants of a sequence are reported by term and add up") {
  const Problem problem(scenes::flat(), scenes::humanoid44(), phases(6));
  const ContactSequence sequence{{0, 0}, {0, kFree}, {kFree, kFree}, {kFree, 0}, {0, 0}};
  Rows rows(problem.layout.nz(), false);
  double expected = 0.0;
  for (const ContactState& state : sequence) {
    write_state_cost(problem, state, rows);
    expected += state_cost(problem, state);
  }
  CHECK(rows.terms()[cost_term_index("flight")] == 0.5);
  write_change_cost(problem, sequence, rows);
  CHECK(rows.terms()[cost_term_index("contact_change")] == doctest::Approx(4 * 0.5 * 0.1 * 0.1));
  CHECK(change_cost(problem, sequence) == rows.terms()[cost_term_index("contact_change")]);
  CHECK(rows.cost() == doctest::Approx(expected + change_cost(problem, sequence)));
}
