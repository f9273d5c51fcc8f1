#pragma once

#include <vector>

#include "ddp/contact_sequence.hpp"
#include "ddp/problem.hpp"

namespace mcplan::ddp::polish {

/// An end-effector in contact during a phase. Its columns are those of Phase::moving.
struct Standing {
  int l = 0, surface = 0;
  int end = 0;                           ///< of the three of p_l
  int stiffness = 0;                     ///< of its stiffness input
  int pressure = 0, pressure_count = 0;  ///< of the first number of c_l, and how many
  int line = 0, line_count = 0;          ///< the same of r_l
  int moment = 0;                        ///< of the first of its moments
  std::vector<int> moments;              ///< of the layout: those that this contact can have
};

/// What varies in a phase once the contacts are known: z = [x, v] with v the inputs that its contacts leave. Nothing
/// that stands has a stride, nothing that is free a force.
struct Phase {
  std::vector<int> inputs;         ///< of the input u, ascending: v
  std::vector<int> moving;         ///< columns of z that CoM, velocity, base and momentum depend on later in the phase
  std::vector<int> full;           ///< the same as columns of [x, u]
  std::vector<Standing> standing;  ///< by end-effector
  struct Swinging {
    int l, stride;  ///< stride: its first column in z
  };
  std::vector<Swinging> swinging;
  int duration = 0;  ///< column of h in `moving`; in z it is the last
};

/// An end-effector that touches down at a knot, where its place is chosen for as long as it stands.
struct Touchdown {
  int knot, l, surface;
};

/// The problem with its contact sequence given: contacts hold exactly instead of by a weight.
class FixedSequence {
 public:
  FixedSequence(const Problem& problem, const ContactSequence& sequence);

  const Problem& problem() const { return *problem_; }
  const ContactSequence& contacts() const { return sequence_; }
  int steps() const { return problem_->steps; }
  int nx() const { return problem_->layout.nx(); }
  const Phase& phase(int k) const { return phases_[k]; }
  const std::vector<Touchdown>& touchdowns() const { return touchdowns_; }

  /// Whether the end-effector stands there up to the goal.
  bool last(const Touchdown& touchdown) const;

  /// Number of variables of knot k: of [x, v], at the last one of x.
  int size(int k) const { return nx() + (k < steps() ? static_cast<int>(phases_[k].inputs.size()) : 0); }

  /// Numbers of the state that nothing but CoM, velocity, base and momentum make up: they come first.
  int body_size() const { return 6 + 2 * problem_->layout.axis_count(); }

  /// Numbers of the first state that may vary: none, or with Model::lipm the CoM's.
  int free_start() const { return problem_->model == Model::wrench ? 0 : 3; }

  /// Give every contact one foothold, take the inputs that the contacts rule out to zero, and the start to what is
  /// demanded.
  void impose(Trajectory& trajectory) const;

 private:
  Phase make_phase(const ContactState& state) const;

  const Problem* problem_;
  ContactSequence sequence_;
  std::vector<Phase> phases_;
  std::vector<Touchdown> touchdowns_;
};

}  // namespace mcplan::ddp::polish
