#include "ddp/guessed_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "ddp/foothold_lattice.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// Nodes that are looked at: some tenths of a second.
constexpr std::size_t kMostNodes = 200'000;
/// Between two questions whether to stop, a few milliseconds.
constexpr int kLooksPerRequest = 32;
/// What a step costs, with its length L over that of the reach box, its height dz over what a foot below the CoM can be
/// higher than the lowest one, what it is wider or narrower than standing, dw, over the box's width, and its turn in
/// radians:
///
///     1 + 2 (L^2 + (1.5 dz)^2 + dw^2 + (1.5 turn)^2)^2 + (lift / usual lift - 1)^2 / 4 where that is higher
///     + edge / 2 + beside^2.
///
/// So steps on open ground are 0.64 of the box long, as those of plans are. None is higher than so much. Chosen.
constexpr double kFar = 2.0, kHigh = 1.5, kTurned = 1.5, kLifted = 0.25, kEdge = 0.5, kBeside = 1.0, kMostRise = 1.3;
/// Least of (1 + 2 L^4) / L.
constexpr double kCheapestRate = 2.08;
/// What is left counts for so much more than its least cost: paths may cost so much more than the cheapest. Measured on
/// rubbles of 19 m: 12,000 nodes instead of more than 200,000.
constexpr double kGreed = 1.5;

/// What a step of one foot beside the other may be.
struct Strides {
  double ahead = 0.0, back = 0.0;              ///< from the other foot
  double usual = 0.0;                          ///< likewise ahead, in the usual reach
  double least_width = 0.0, most_width = 0.0;  ///< between them
  double nominal_width = 0.0, side = 1.0;      ///< +1: the mover is the left one
  double rise = 0.0;                           ///< of a foot below the CoM over one that is as low as may be
  double height = 0.0, box_width = 0.0;        ///< of the reach box
};

Strides strides_of(const EndLimits& here, const EndLimits& there) {
  Strides out;
  out.side = here.nominal.y() > there.nominal.y() ? 1.0 : -1.0;
  out.ahead = here.reach_max.x() - here.reach_min.x();
  out.back = 0.5 * out.ahead;
  out.usual = here.usual_stride;
  const auto width = [&](double a, double b) { return out.side * (a - b); };
  const bool left = out.side > 0.0;
  out.nominal_width = width(here.nominal.y(), there.nominal.y());
  out.least_width = left ? here.reach_min.y() - there.reach_max.y() : there.reach_min.y() - here.reach_max.y();
  out.most_width = left ? here.reach_max.y() - there.reach_min.y() : there.reach_max.y() - here.reach_min.y();
  out.least_width = std::max(out.least_width, 2.0 * std::min(std::abs(here.nominal.y()), here.half_width));
  out.box_width = here.reach_max.y() - here.reach_min.y();
  double highest = here.reach_max.z();  // below the CoM
  for (int i = 0; i < here.cuts; ++i)
    if (here.cut_A(i, 2) > 0.0) highest = std::min(highest, here.cut_b[i] / here.cut_A(i, 2));
  out.rise = std::max(highest, here.nominal.z()) - there.reach_min.z();
  out.height = here.reach_max.z() - here.reach_min.z();
  return out;
}

class Path {
 public:
  Path(const Problem& problem, const FootholdLattice& lattice, double stride_ratio, const StopRequest& stop)
      : problem_(&problem),
        lattice_(&lattice),
        stride_ratio_(stride_ratio),
        stop_(&stop),
        strides_{strides_of(lattice.limits(0), lattice.limits(1)), strides_of(lattice.limits(1), lattice.limits(0))} {}

  GuessedSteps find() {
    for (int foot : {0, 1}) rows_[foot].resize(lattice_->size(foot));
    for (int l : {0, 1}) reach(begin_[l], 0.0, nullptr);
    int looks = 0;
    while (!open_.empty()) {
      Node& node = *open_.top().node;
      open_.pop();
      if (node.closed) continue;
      node.closed = true;
      if (node.at.landed == FootholdLattice::kGoal && node.at.other == FootholdLattice::kGoal) return steps_to(node);
      if (reached_ > kMostNodes || (++looks % kLooksPerRequest == 0 && *stop_ && (*stop_)())) return {};
      for (Node& next : steps_from(node.at)) step(node, next);
    }
    return {};
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  /// The first or the second foot has landed last; the footholds of both.
  struct At {
    int foot = 0, landed = 0, other = 0;
  };
  struct Node {
    At at;
    double level = 0.0;    ///< of the step to there, as if nothing had to be stepped over
    double cost = kNever;  ///< from the start
    const Node* from = nullptr;
    bool closed = false;
  };
  /// The least foreseen comes first, of several the one that lies first.
  struct Open {
    double foreseen = 0.0;
    Node* node = nullptr;
    bool operator>(const Open& other) const { return order() > other.order(); }
    std::tuple<double, int, int, int> order() const {
      return {foreseen, node->at.landed, node->at.other, node->at.foot};
    }
  };

  void reach(Node& node, double cost, const Node* from) {
    if (node.closed || !(cost < node.cost)) return;
    reached_ += node.cost == kNever;
    node.cost = cost;
    node.from = from;
    const double left = lattice_->length() - lattice_->at(node.at.foot, node.at.landed).station;
    const double least = kCheapestRate * left / strides_[node.at.foot].usual - 1.0;
    open_.push({cost + kGreed * std::max(least, 0.0), &node});
  }

  /// What can be stepped to while a foot stands at a foothold, wherever the other one comes from.
  std::vector<Node>& steps_from(const At& at) {
    Row& row = rows_[at.foot][at.landed];
    if (std::exchange(row.known, true)) return row.steps;
    const int mover = 1 - at.foot;
    const LatticePoint& stance = lattice_->at(at.foot, at.landed);
    const double ahead = strides_[mover].ahead;
    const auto add = [&](int to) {
      const double level = price_of(mover, stance, lattice_->at(mover, to));
      if (std::isfinite(level)) row.steps.push_back({{mover, to, at.landed}, level});
    };
    const auto [first, last] = lattice_->between(mover, stance.station - ahead, stance.station + 1.2 * ahead);
    for (int to = first; to < last; ++to) add(to);
    add(FootholdLattice::kGoal);
    return row.steps;
  }

  /// Most steps lead to where a cheaper one does: how high feet are to be lifted is not asked of them.
  void step(const Node& node, Node& next) {
    if (next.closed || !(node.cost + next.level < next.cost)) return;
    reach(next, node.cost + (next.level + lift_price(next.at, node.at.other)), &node);
  }

  /// Of a step beside the foot that stands; infinite where it cannot be made. What is to be stepped over comes on top.
  double price_of(int mover, const LatticePoint& stance, const LatticePoint& next) const {
    const Strides& most = strides_[mover];
    const Vector3d off = next.place - stance.place;
    const double yaw = 0.5 * (next.yaw + stance.yaw), cosine = std::cos(yaw), sine = std::sin(yaw);
    const double ahead = cosine * off.x() + sine * off.y();
    const double width = most.side * (cosine * off.y() - sine * off.x());
    if (ahead > most.ahead || ahead < -most.back || width < most.least_width || width > most.most_width) return kNever;
    if (std::abs(next.yaw - stance.yaw) > kTurnStride || std::abs(off.z()) > kMostRise * most.rise) return kNever;
    const Eigen::Vector4d ratios(ahead / (stride_ratio_ * most.usual), (width - most.nominal_width) / most.box_width,
                                 kHigh * off.z() / most.rise, kTurned * (next.yaw - stance.yaw));
    const double far = ratios.squaredNorm();
    return 1.0 + kFar * far * far + kEdge * next.near_edge + kBeside * next.beside * next.beside;
  }

  /// Of lifting the foot that has landed over what lies between there and where it was; infinite where it is too high.
  double lift_price(const At& at, int from) {
    const LatticePoint &last = lattice_->at(at.foot, from), &next = lattice_->at(at.foot, at.landed);
    const double lift = lift_of(at.foot, from, at.landed);
    const double top = lift + 0.5 * (last.place.z() + next.place.z());  // half way
    if (top - lattice_->at(1 - at.foot, at.other).place.z() > strides_[at.foot].height) return kNever;
    const double lifted = std::max(lift / problem_->swing_height - 1.0, 0.0);
    return kLifted * lifted * lifted;
  }

  /// How high a swing has to be lifted.
  double lift_of(int l, int from, int to) {
    const std::uint64_t key = ((static_cast<std::uint64_t>(from) << 31 | static_cast<std::uint64_t>(to)) << 1) | l;
    const auto known = lifts_.find(key);
    if (known != lifts_.end()) return known->second;
    return lifts_[key] = lattice_->lift(l, lattice_->at(l, from), lattice_->at(l, to));
  }

  GuessedSteps steps_to(const Node& goal) {
    constexpr double kRounding = 1e-9;
    GuessedSteps out;
    out.price = goal.cost;
    for (const Node* node = &goal; node->from; node = node->from) {
      const At& at = node->at;
      const LatticePoint& foothold = lattice_->at(at.foot, at.landed);
      const int from = node->from->at.other;
      const bool along = lattice_->at(at.foot, from).surface == foothold.surface;
      out.even = out.even && along && lift_of(at.foot, from, at.landed) < kRounding;
      out.steps.push_back({lattice_->feet()[at.foot], foothold.surface, foothold.place, foothold.share});
    }
    std::reverse(out.steps.begin(), out.steps.end());
    return out;
  }

  struct Row {
    bool known = false;
    std::vector<Node> steps;
  };
  const Problem* problem_;
  const FootholdLattice* lattice_;
  double stride_ratio_;
  const StopRequest* stop_;
  std::array<Strides, 2> strides_;
  std::array<Node, 2> begin_{{{{0, FootholdLattice::kStart, FootholdLattice::kStart}},
                              {{1, FootholdLattice::kStart, FootholdLattice::kStart}}}};
  std::array<std::vector<Row>, 2> rows_;  ///< by the foot that stands, and its foothold
  std::size_t reached_ = 0;               ///< nodes
  std::unordered_map<std::uint64_t, double> lifts_;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open_;
};

/// The two feet on which the robot stands at the start and at the goal; -1: it has others, or stands on hands as well.
std::array<int, 2> two_feet(const Problem& problem) {
  constexpr std::array<int, 2> kNone{-1, -1};
  std::vector<int> feet;
  for (int l = 0; l < problem.layout.end_effector_count(); ++l) {
    const bool starts = problem.start_contacts[l] != kFree, ends = problem.goal_contacts[l] != kFree;
    const bool foot = problem.robot.end_effectors[problem.active[l]].kind == "foot";
    if (foot != starts || foot != ends) return kNone;
    if (foot) feet.push_back(l);
  }
  return feet.size() == 2 ? std::array<int, 2>{feet[0], feet[1]} : kNone;
}

}  // namespace

std::vector<double> GuessedSteps::progress(int in_phases) const {
  const int count = static_cast<int>(steps.size());
  // At the knot 2 i + 2 at which footstep i lands, and half way between these.
  std::vector<double> out(in_phases + 1, 1.0);
  const auto share = [&](int i) { return i < 0 ? 0.0 : steps[i].share; };
  double last = 0.0;
  for (int k = 0; k < std::min(2 * count, in_phases); k += 2) {
    out[k] = std::max(last, 0.5 * (share(k / 2 - 1) + share(k / 2 - 2)));
    last = out[k];
  }
  for (int k = 1; k < std::min(2 * count, in_phases); k += 2) out[k] = 0.5 * (out[k - 1] + out[k + 1]);
  return out;
}

GuessedSteps guessed_steps(const Problem& problem, double stride_ratio, const StopRequest& stop) {
  const std::array<int, 2> feet = two_feet(problem);
  if (feet[0] < 0) return {};
  const FootholdLattice lattice(problem, feet);
  return Path(problem, lattice, stride_ratio, stop).find();
}

ContactSequence sequence_of(const Problem& problem, const GuessedSteps& guess) {
  const int count = static_cast<int>(guess.steps.size());
  if (count == 0 || 2 * count > problem.steps) return {};
  ContactSequence out(problem.steps + 1, problem.start_contacts);
  ContactState now = problem.start_contacts;
  for (int k = 0; k <= problem.steps; ++k) {
    out[k] = now;
    if (k % 2 == 0 || k / 2 >= count) continue;
    const GuessedStep& step = guess.steps[k / 2];
    out[k][step.l] = kFree;
    now[step.l] = step.surface;
  }
  return out.back() == problem.goal_contacts && problem.rules.valid(out) ? out : ContactSequence{};
}

Trajectory guess_of(const Problem& problem, const ContactSequence& sequence, const GuessedSteps& guess,
                    const Tuning& tuning) {
  Trajectory out = problem.initial_guess(sequence, tuning);
  const Layout& at = problem.layout;
  const int first = guess.steps[0].l, second = guess.steps[1].l;  // each foot steps to its goal
  Vector3d place[2] = {out.x.front().segment<3>(at.end(first)), out.x.front().segment<3>(at.end(second))};
  // Footstep i lands at knot 2 i + 2, and its foot is where it was until knot 2 i + 1.
  for (int k = 1; k < problem.steps; ++k) {
    const std::size_t landed = static_cast<std::size_t>(k) / 2;
    if (k % 2 == 0 && landed <= guess.steps.size()) place[(landed - 1) % 2] = guess.steps[landed - 1].place;
    const Vector3d middle = 0.5 * (place[0] + place[1]);
    Eigen::VectorXd& x = out.x[k];
    x.segment<3>(at.end(first)) = place[0];
    x.segment<3>(at.end(second)) = place[1];
    x.segment<2>(at.com()) = middle.head<2>();
    x[at.com() + 2] = std::min(place[0].z(), place[1].z()) - problem.limits[first].nominal.z();
  }
  for (int k = 0; k < problem.steps; ++k)
    for (int l : {first, second})
      out.u[k].segment<3>(at.stride(l)) = out.x[k + 1].segment<3>(at.end(l)) - out.x[k].segment<3>(at.end(l));
  for (int k = 1; k < problem.steps; ++k)
    out.x[k].segment<3>(at.velocity()) =
        (out.x[k + 1] - out.x[k - 1]).segment<3>(at.com()) / (out.u[k - 1][at.duration()] + out.u[k][at.duration()]);
  problem.set_sole_yaw(sequence, out);
  return out;
}

}  // namespace mcplan::ddp
