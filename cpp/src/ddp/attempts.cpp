#include "ddp/attempts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>
#include <utility>

#include "ddp/constants.hpp"
#include "ddp/initial_sequence.hpp"
#include "ddp/plan_conversion.hpp"
#include "ddp/reachable_surfaces.hpp"
#include "ddp/stepping_sequence.hpp"
#include "model/text.hpp"

namespace mcplan::ddp {

Attempts::Attempts(Problem&& problem, std::vector<int> surfaces, const Deadline& deadline, BestPlan& best,
                   Report& report)
    : problem_(std::move(problem)),
      surfaces_(std::move(surfaces)),
      first_(problem_.tuning()),
      deadline_(&deadline),
      best_(&best),
      search_(problem_, deadline, report) {
  search_.watch([this](const Incumbent& now, const Tuning& tuning) { keep(now, tuning); });
}

/// Remember an iterate and show it to who watches.
void Attempts::keep(const Incumbent& now, const Tuning& tuning) {
  if (problem_.options.watch) {
    Plan plan = to_plan(problem_, now, false);
    put_back(plan, best_->scene(), surfaces_);
    problem_.options.watch(plan);
  }
  best_->keep(search_, surfaces_, now, tuning);
}

/// Refine the cheapest of the guesses and finish it.
Ending Attempts::attempt(std::vector<Guess> guesses, const Tuning& tuning) {
  Ending ending = Ending::done;
  Incumbent chosen = cheapest(guesses, tuning, ending);
  if (chosen.sequence.empty()) return ending == Ending::done ? Ending::broke_down : ending;
  if (ending == Ending::done) ending = search_.refine(chosen, tuning);
  if (ending == Ending::done) ending = search_.polish_last(chosen, tuning);
  last_ = chosen;
  missed_.clear();
  // Out of time there is a plan already, and none for another one.
  if (ending != Ending::time_limit || !best_->best()) missed_ = finish(std::move(chosen), tuning);
  return late(ending);
}

/// End an attempt. Returns what the checker objects to.
std::vector<Violation> Attempts::finish(Incumbent now, const Tuning& tuning) {
  const double cost = now.evaluation.cost;
  std::vector<Violation> violations = best_->finish(search_, surfaces_, std::move(now), tuning);
  if (!problem_.options.logger) return violations;
  std::string verdict = deadline_->passed() ? "not checked in full" : "accepted";
  if (!violations.empty()) {
    const Violation& worst = *std::max_element(violations.begin(), violations.end(), [](const auto& a, const auto& b) {
      return violation_ratio(a) < violation_ratio(b);
    });
    verdict = "violates " + worst.name;
    if (!worst.end_effector.empty()) verdict += " at " + worst.end_effector;
    if (worst.phase >= 0) verdict += " in phase " + std::to_string(worst.phase);
    verdict += ", " + model::digits(violation_ratio(worst), "%.3g") + " times its tolerance";
  }
  problem_.options.logger(LogLevel::info, "plan of cost " + model::digits(cost, "%.4g") + ": " + verdict);
  return violations;
}

/// What an attempt that has come to its end is called when the time limit has cut its last check short.
Ending Attempts::late(Ending ending) const {
  return ending == Ending::done && !best_->ok() && deadline_->passed() ? Ending::time_limit : ending;
}

Incumbent Attempts::first_guess(const ContactSequence& sequence, const Tuning& tuning) const {
  Incumbent guess;
  guess.trajectory = problem_.initial_guess(sequence, tuning);
  guess.sequence = sequence;
  return guess;
}

/// What there is when time is up before the first iteration: end-effectors where they are due and the weight on those
/// that stand, by the sequence or in turns.
Incumbent Attempts::at_once(const ContactSequence& sequence) {
  Incumbent best_guess = first_guess(sequence, first_);
  if (!problem_.options.initial_sequence.empty()) return best_guess;
  double lowest = search_.evaluate(best_guess, first_).merit();
  for (int mover : {0, 1}) {
    const ContactSequence stepping = stepping_sequence(problem_, mover);
    if (stepping.empty()) continue;
    Incumbent guess = first_guess(stepping, first_);
    const double merit = search_.evaluate(guess, first_).merit();
    if (!(merit < lowest)) continue;
    lowest = merit;
    best_guess = std::move(guess);
  }
  return best_guess;
}

/// The contact sequence that a search begins with; where finding it takes too long, end-effectors in turns.
ContactSequence Attempts::initial(Search& search, const Tuning& tuning, Ending& ending) const {
  const Problem& problem = search.problem();
  const Options& options = problem.options;
  if (!options.initial_sequence.empty()) return problem.to_active(options.initial_sequence);
  const Trajectory guess = problem.initial_guess({}, tuning);
  Schedule schedule;
  schedule.tuning = tuning;
  schedule.contact_weight = options.weights.contact_min;
  search.model().expand(guess, schedule);
  bool stopped = false;
  int looks = 0;
  const double until_s = deadline_->elapsed_s() + kInitialShare * std::max(deadline_->remaining_s(), 0.0);
  ContactSequence found = initial_sequence(search.model(), kBeam, [&] {
    if (++looks % kPollsPerRequest == 0 && options.stop && options.stop()) ending = Ending::interrupted;
    return stopped = ending == Ending::interrupted || deadline_->elapsed_s() >= until_s;
  });
  for (int mover : {0, 1})
    if (stopped && found.empty()) found = stepping_sequence(problem, mover);
  if (!found.empty()) return found;
  if (ending != Ending::interrupted) ending = stopped ? Ending::time_limit : Ending::no_sequence;
  return {};
}

std::vector<Attempts::Guess> Attempts::guesses(const Incumbent& start, const Incumbent* warm) const {
  const Options& options = problem_.options;
  if (warm) return {{*warm, 0.0, true}};
  if (!options.initial_sequence.empty()) return {{first_guess(start.sequence, first_)}};
  // Shorter and longer steps lead to other sequences; the better one goes on.
  std::vector<Guess> out{{start, options.proximal_weight}, {start, kSecondDiscovery * options.proximal_weight}};
  const std::vector<Guess> in_turn = stepping(first_);
  out.insert(out.end(), in_turn.begin(), in_turn.end());
  return out;
}

/// End-effectors in turns, begun with the first or the second of them.
std::vector<Attempts::Guess> Attempts::stepping(const Tuning& tuning) const {
  std::vector<Guess> out;
  for (int mover : {0, 1}) {
    const ContactSequence steps =
        problem_.options.stepping_guesses ? stepping_sequence(problem_, mover) : ContactSequence();
    if (!steps.empty()) out.push_back({first_guess(steps, tuning)});
  }
  return out;
}

/// How much further inside footholds go when a swing has caught an edge.
double Attempts::further_inside() const {
  const Options& options = problem_.options;
  const Robot& robot = problem_.robot;
  const double on_surface = options.sole_inside < 0.0 ? robot.sole_support : options.sole_inside;
  double further_m = (on_surface >= 1.0 ? kExtraMargin_m : kClearanceMin_m) * problem_.similarity.length;
  for (const EndEffector& end : robot.end_effectors)
    if (on_surface < 1.0) further_m = std::max(further_m, kClearanceShare * end.half_size.maxCoeff());
  return further_m / problem_.units.length;
}

/// Whether the best plan that an attempt has ended with exceeds a limb limit, and nothing else by as much.
bool Attempts::asks_too_much_of_joints() const {
  const auto& plan = best_->finished();
  return plan && !plan->ok && (plan->worst.name == "joint_torque" || plan->worst.name == "joint_speed");
}

/// Whether there is no plan that is accepted, or it flies more than once.
bool Attempts::falls_short() const {
  const auto& plan = best_->finished();
  return !plan || !plan->ok || flights(plan->plan) > 1;
}

/// Other settings of what the outcome depends on most, in an order drawn from the seed, until a plan is accepted,
/// with the penalty.
Ending Attempts::restart(Ending ending, const ContactSequence& initial, Tuning tuning) {
  const Problem& p = problem_;
  std::vector<RestartSetting> settings(std::begin(kRestarts), std::end(kRestarts));
  std::mt19937_64 random(p.options.seed);
  for (std::size_t i = settings.size(); i > 1; --i) std::swap(settings[i - 1], settings[random() % i]);
  for (int i = 0; i < p.options.restarts && !best_->solved(); ++i) {
    if (ending != Ending::done && ending != Ending::broke_down) break;
    const auto [proximal, duration_s] = settings[static_cast<std::size_t>(i) % settings.size()];
    tuning.duration_initial = std::clamp(duration_s * p.similarity.time / p.units.time, p.duration_min, p.duration_max);
    Incumbent again = first_guess({}, tuning);
    again.sequence = initial;
    std::vector<Guess> others{{again, proximal}};
    tuning.hold_joints = tuning.hold_joints || asks_too_much_of_joints();
    tuning.penalty = true;
    // A foot too close to the next step catches it with its toe: the same motion with footholds further inside.
    if (best_->finished() && best_->finished()->worst.name == "clearance" && !last_.sequence.empty()) {
      tuning.extra_margin += further_inside();
      tuning.clear_swings = true;
      others.insert(others.begin(), Guess{last_, 0.0, true});
    }
    ending = mend_last(attempt(std::move(others), tuning), tuning);
  }
  return ending;
}

// The interior point is no faster over four feet, and has ended with no crawl where the penalty had one.
Ending Attempts::crawl() {
  Tuning tuning = first_;
  tuning.penalty = true;
  std::vector<Guess> steps = stepping(tuning);
  if (steps.empty()) return Ending::done;
  keep(steps.front().start, tuning);
  Ending ending = attempt(std::move(steps), tuning);
  for (int i = 0; i < problem_.options.restarts && ending == Ending::done && !best_->solved(); ++i) {
    if (!best_->finished() || best_->finished()->worst.name != "clearance" || last_.sequence.empty()) break;
    tuning.extra_margin += further_inside();
    tuning.clear_swings = true;
    ending = attempt({Guess{last_, 0.0, true}}, tuning);
  }
  if (ending != Ending::interrupted) best_->look_back(search_, surfaces_);
  return late(ending);
}

Ending Attempts::walk(const GuessedSteps& steps, int again) {
  Incumbent start;
  start.sequence = sequence_of(problem_, steps);
  if (start.sequence.empty()) return Ending::no_sequence;
  Tuning tuning = first_;
  tuning.clear_swings = true;
  start.trajectory = guess_of(problem_, start.sequence, steps, tuning);
  keep(start, tuning);
  Ending ending = attempt_and_mend({{start}}, tuning);
  for (int i = 0; i < again && ending == Ending::done && !best_->solved() && !last_.sequence.empty(); ++i) {
    const bool caught = best_->finished() && best_->finished()->worst.name == "clearance";
    if (!caught && (tuning.hold_joints || !asks_too_much_of_joints())) break;
    if (caught) tuning.extra_margin += further_inside();
    tuning.hold_joints = tuning.hold_joints || !caught;
    ending = attempt_and_mend({{last_, 0.0, true}}, tuning);
  }
  if (ending == Ending::done) ending = hold_limits(ending, tuning);
  if (ending != Ending::interrupted) best_->look_back(search_, surfaces_);
  return late(ending);
}

Ending Attempts::run(const Incumbent* warm) {
  Ending ending = Ending::done;
  const ContactSequence sequence = initial(search_, first_, ending);
  if (sequence.empty()) return ending;
  Incumbent start = first_guess({}, first_);
  start.sequence = sequence;
  keep(warm ? *warm : at_once(sequence), first_);
  const Options& options = problem_.options;
  if (options.method == Method::paper) {
    const bool unset = options.max_iterations == Options().max_iterations;
    ending = search_.run_paper(start, unset ? kPaperIterations : options.max_iterations, first_);
    if (ending != Ending::broke_down && (ending != Ending::time_limit || !best_->best())) finish(start, first_);
    ending = late(ending);
    // The published algorithm is judged by what it ends with.
    if (ending != Ending::time_limit) best_->drop_iterates();
    return ending;
  }
  if (best_->best() && deadline_->passed()) return Ending::time_limit;
  Tuning tuning = first_;
  ending = attempt_and_mend(guesses(start, warm), tuning);
  // Most plans ask no more of the joints than there is, and are found sooner where nothing looks at that.
  if (ending == Ending::done && asks_too_much_of_joints()) {
    tuning.hold_joints = true;
    search_.begin_anew();
    ending = attempt(guesses(start, warm), tuning);
  }
  // The filter may have led to where no motion is: the penalty goes another way.
  if (ending == Ending::done && options.restarts > 0 && search_.exact_contacts(tuning) && falls_short()) {
    tuning.penalty = true;
    search_.begin_anew();
    ending = attempt(guesses(start, warm), tuning);
  }
  if (!warm && options.initial_sequence.empty() && options.restarts > 0 && problem_.steps <= kFewPhases)
    ending = vary(ending, tuning);
  if (options.restarts > 0) ending = hold_limits(ending, tuning);
  ending = restart(ending, sequence, tuning);
  if (ending != Ending::interrupted) best_->look_back(search_, surfaces_);
  return late(mend_cheapest(ending));
}

}  // namespace mcplan::ddp
