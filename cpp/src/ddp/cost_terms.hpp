#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "ddp/contact_sequence.hpp"
#include "ddp/instants.hpp"
#include "ddp/pendulum.hpp"
#include "ddp/problem.hpp"
#include "ddp/rows.hpp"
#include "ddp/schedule.hpp"

namespace mcplan::ddp {

/// What a term writes its rows about: a step of a trajectory and, for terms of one end-effector, that one and its
/// contact.
struct StepView {
  const Problem& problem;
  const Pendulum& pendulum;
  const Schedule& schedule;
  int k;
  const Eigen::VectorXd& x;
  const Eigen::VectorXd* u;                        ///< null at the last knot
  const Instants& instants;                        ///< of the phase; meaningful where u is given
  int l = -1;                                      ///< end-effector
  int surface = kFree;                             ///< that it touches
  double sole_yaw = 0.0;                           ///< [rad] heading of its sole
  const SwingArc* arc = nullptr;                   ///< of its swing, where that is known
  const std::vector<double>* sole_yaws = nullptr;  ///< [rad] headings of all soles at the knot

  /// Take from a trajectory what is given of the end-effector.
  void look_at(int end_effector, int contact, const Trajectory& t) {
    l = end_effector;
    surface = contact;
    sole_yaw = t.sole_yaw[k][l];
    sole_yaws = &t.knot_yaw[k];
    arc = t.swing_arcs.empty() ? nullptr : &t.swing_arcs[k][l];
  }

  /// Whether there are rows inside the phase.
  bool between_knots() const { return u && schedule.interior_weight > 0.0; }
};

/// What a term depends on besides the motion, and so when it is asked.
enum class Scope {
  step,     ///< rows at every knot, whatever is touched
  free,     ///< rows for every end-effector that is free
  contact,  ///< rows for every end-effector in contact
  flight,   ///< rows for every phase without any contact
  state,    ///< a constant of a contact state
  change,   ///< a constant of two contact states that follow each other; at the full weights, not in discovery
};

/// One term of the cost: its name in the report, when it applies, its rows with their derivatives. Each is one file of
/// cpp/src/ddp/costs/, of the term's name, with a function of that name which returns it; the build lists them. Theory:
/// docs/theory/ddp.md, "Costs".
class CostTerm {
 public:
  /// A weight that belongs to one term alone: a field of Python's `Weights`, an entry of Weights::own here.
  struct OwnWeight {
    double usual = 0.0;
    const char* meaning = nullptr;  ///< null: the term has none
  };

  /// Terms of a scope are asked by their `order`, those of one order by name. Sums depend on it to the last bit.
  CostTerm(const char* name, Scope scope, int order) : CostTerm(name, scope, order, {}) {}
  CostTerm(const char* name, Scope scope, int order, OwnWeight weight)
      : name_(name), scope_(scope), order_(order), own_weight_(weight) {}
  virtual ~CostTerm() = default;

  const char* name() const { return name_; }
  Scope scope() const { return scope_; }
  int order() const { return order_; }
  const OwnWeight& own_weight() const { return own_weight_; }
  bool has_own_weight() const { return own_weight_.meaning != nullptr; }
  double weight(const Weights& weights) const;  ///< its own one

  virtual bool applies(const StepView&) const { return true; }
  virtual void write(const StepView&, Rows&) const {}                  ///< of all scopes that have rows
  virtual double of_state(const Problem&, const ContactState&) const;  ///< of Scope::state
  virtual double of_change(const Problem&, const ContactState& from, const ContactState& to) const;  ///< Scope::change

 private:
  const char* name_;
  Scope scope_;
  int order_;
  OwnWeight own_weight_;
};

/// All terms; the index of one here is its index in Rows::terms() and Evaluation::terms.
const std::vector<const CostTerm*>& cost_terms();

/// The index of a term by its name, -1 when there is none.
int cost_term_index(const std::string& name);

/// Rows of all terms of a scope that apply.
void write_terms(Scope scope, const StepView& step, Rows& rows);

/// Sum of the constants of a contact state.
double state_cost(const Problem& problem, const ContactState& state);

/// Sum of the constants of two contact states that follow each other, and the same over a whole sequence.
double change_cost(const Problem& problem, const ContactState& from, const ContactState& to);
double change_cost(const Problem& problem, const ContactSequence& sequence);

/// The constants of a sequence, each under its own name: those of a step's state, and all those of changes.
void write_state_cost(const Problem& problem, const ContactState& state, Rows& rows);
void write_change_cost(const Problem& problem, const ContactSequence& sequence, Rows& rows);

}  // namespace mcplan::ddp
