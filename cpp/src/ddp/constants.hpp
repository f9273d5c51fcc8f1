#pragma once

#include <cmath>
#include <cstddef>

/// The numbers that steer the search and are no options, each with where it comes from: "measured" points to the page
/// with the figures (docs/theory/ddp.md unless another one is named), "chosen" says that no other value was compared.
/// Tolerances of rounding stay beside what they guard. Lengths and times that carry a unit are those of a robot of
/// human size (robot/similarity.hpp).
namespace mcplan::ddp {

// The problem.

/// Penalties settle slightly outside their bounds, so friction is planned smaller than the surface's by this, ...
/// Measured: 0.67 for 0.7 costs nothing ("Deviations").
constexpr double kFrictionMargin = 0.02;
/// ... down to this ratio of the surface's coefficient. Chosen.
constexpr double kFrictionRatioMin = 0.5;
/// Ratio of friction that plans of robots use which are tracked on point feet, and the least load of such a foot in
/// contact over an equal share of the weight. Measured (docs/tracking.md, "Quadrupeds").
constexpr double kTrackedFrictionRatio = 0.8, kLoadRatio = 0.3;
/// Footholds and centres of pressure are planned this far inside their polygon [m]. Chosen, for the same reason.
constexpr double kEdgeMargin_m = 0.002;
/// A sole that finds no room is kept to the middle of its surface, down to this ratio of the width from either edge,
/// the less the wider it is: less would leave it on its toes, 0.5 would leave no choice. Chosen.
constexpr double kNarrow = 0.35;
/// An end-effector faces a surface when the cosine between its nominal position and the normal is larger. Chosen, about
/// 45 degrees ("State and input").
constexpr double kFacing = 0.7;
/// A force cap above this many weights would not bind; it also stands for "no cap". Chosen.
constexpr double kForceCapMax = 10.0;
/// Depth below a surface down to which a free end-effector is pushed up, in thicknesses of the solid. Chosen: one that
/// crossed the solid between two knots is still noticed.
constexpr double kKeepOutDepth = 2.0;
/// First guess of all durations with Model::lipm [s]: what the paper's model was measured from, of its author's box.
constexpr double kLipmDuration_s = 0.45;
/// Number of phases: the paper's, and the largest that is taken without being asked for (chosen).
constexpr int kPaperPhases = 18, kPhasesMax = 400;
/// Friction coefficient that stands for any larger one where a stride is judged. Chosen.
constexpr double kStrideFrictionMax = 10.0;
/// So many times as many phases are tried where the best plan is acceptable. Measured on 150 random scenes: 7 of 10
/// failures were too few phases for short steps, the others jumps.
constexpr double kMorePhases = 1.3;
/// In more phases than these a walk is one of many steps. Chosen: 43 scenes with an obstacle each have 18 to 50 and are
/// better restarted at once, ground of patches that are 3 m long has 40 to 80.
constexpr int kFarPhases = 40;
/// And where a walk costs more than this a phase. Measured on 115 random scenes (27 November 2026): walks cost 0.004 to
/// 0.02; four cost more, 0.09 to 0.2, of which more phases made 0.006.
constexpr double kDearPhase = 0.03;
/// A crawl on four point feet is tried in so many times as many phases as the way asks for, until one succeeds.
/// Measured on rooms with a door aside: 58 phases fail, 70 are enough.
constexpr double kCrawlPhases[] = {1.0, 1.2, 1.45};
/// Tracked point feet are planned this far inside their surface, in CoM heights (chosen: the radius of Go2's foot), and
/// legs in replans this much shorter than they can be [m] (measured: docs/online.md, "Pushes that are felt").
constexpr double kPointMargin = 0.08, kLegMargin_m = 0.01;

// Routes.

/// Level distance from ground that a foot may have in its nominal place, as a ratio of its stride, less what its sole
/// stays inside, down to the second. Chosen: gaps of twice that are stepped over, with a fifth of the stride to spare.
constexpr double kGapRatio = 0.4, kGapRatioMin = 0.1;
/// Ground faces up by at least this (z of the normal). Chosen: steeper than any friction holds.
constexpr double kGroundNormal = 0.3;
/// Surfaces whose heights differ by less than this ratio of a step are one place. Chosen.
constexpr double kSameHeightRatio = 0.05;
/// The trunk is looked for in solids up to this height and within this distance, in heights of the CoM, or so much
/// beyond where the feet stand. Chosen.
constexpr double kTrunkHeight = 1.3, kTrunkRoom = 0.2, kFootRoom = 0.05;
/// What a way as loose as may be costs more than one over ground, as a ratio, and one on which the robot has no room to
/// turn on the spot. Chosen.
constexpr double kLooseness = 3.0, kTight = 1.0;
/// Spacing of the places that are joined, in strides, and how far beside the way they lie, likewise, or half its length
/// if that is more; the most places that there may be. Chosen.
constexpr double kRoadSpacing = 0.25, kRoadMargin = 5.0, kRoadCellsMax = 2e4;
/// Where no way is found, places so many times as far beside the line are looked at, until they would be this far from
/// each other, in strides. Chosen: a foot's reach to both sides.
constexpr double kWiderRoad = 2.0, kRoadSpacingMax = 0.5;
/// Ground is level where no step is higher than this ratio of the highest that the robot makes. Ways round what is
/// higher are tried as well, so many. Chosen: blocks of 5 cm for humanoid44, 9 cm for TALOS.
constexpr double kLevelRise = 0.25;
constexpr int kLevelDetours = 2;
/// Detours that are looked for, how many points of one are compared, and what passing within so many strides of one
/// costs the next. Chosen.
constexpr int kDetours = 3, kRoadSamples = 40;
constexpr double kAvoided = 4.0, kNearRoute = 0.35;
/// A corner is cut where that costs at most so much more. Chosen.
constexpr double kStraighter = 1.02;
/// Corners are rounded over this share of the route on both sides. Chosen.
constexpr double kRounding = 0.03;
/// The base looks along this share of the route to both sides, and has turned to it after so much. Chosen.
constexpr double kLookAlong = 0.08, kTurnShare = 0.2;
/// It turns in full where the route is twice so far beside the straight line, over that one's length, and not at all up
/// to this. Chosen: a route among stones for a quadruped has 0.04, round a post or a hole 0.14 and more.
constexpr double kTurnAside = 0.05;
/// What a stride turns a foot by at most [rad], where its joints do not say less. Measured: humanoid44 turns by half a
/// turn in 18 phases at 0.08.
constexpr double kTurnStride = 0.25 * M_PI;
/// The base turns to the way where it would otherwise look aside by more than this [rad] and it takes fewer phases by
/// this ratio; below the second one nothing else is tried while there is a plan that does not strain the robot. Chosen.
constexpr double kTurnToWay = 0.35, kFewerPhases = 0.8, kFarFewerPhases = 0.5;

// The trunk.

/// Radius of the ball about the CoM that stays out of solids, in heights of the CoM. Chosen: the checker asks for 0.1.
constexpr double kTrunkRadius = 0.15;
/// Room beside a sole that swings past such a solid, in heights of the CoM. Chosen.
constexpr double kSwingRoom = 0.02;
/// Room between soles that stand beside each other, in heights of the CoM, or this ratio of what they have in the
/// nominal stance. Chosen: links of feet are wider than soles.
constexpr double kSoleRoom = 0.03, kNominalRoom = 0.9;
/// Room that swings keep above solids and beside them, in heights of the CoM; the most that a foot is lifted, in usual
/// swing heights: the largest that a plan's swings are chosen from. Chosen.
constexpr double kPathRoom = 0.01, kLiftMax = 4.0;
/// What is this far inside a solid's outline at most, in heights of the CoM, stands beside it: a foothold put onto the
/// edge of a tread is by rounding inside of the next one, a whole riser deep. Chosen, below what the checker tolerates.
constexpr double kBeside = 1e-3;
/// Distance from the reference of the CoM, in heights of it, within which solids are looked at. Chosen: ground is one
/// away, and robots crouch.
constexpr double kStanding = 0.6;

// Joints.

/// Ratio of a joint's torque and speed limits that is planned: penalties settle slightly outside. Chosen: the checker
/// tolerates 0.02.
constexpr double kJointMargin = 0.97;
/// The lever of a stretched knee, over the shorter link, is at least this; legs are kept from being longer. Chosen:
/// 0.99 of the length of TALOS's stretched leg.
constexpr double kMinLeverRatio = 0.15;

// Weights that are no options.

/// On the state at the start, which is a fact. Chosen: above all weights of the paper.
constexpr double kPinned = 1000.0;
/// And of an end that another plan goes on from: what the solve leaves of it is made good by Search::make_exact().
constexpr double kPinnedEnd = 100.0;
/// Factor on the weight of the base's angles while discovering, and of robots that are tracked. Measured ("Task").
constexpr double kFirmAngle = 10.0;
/// The same on angular momentum and force lines. Measured ("Task"): 0.3 becomes 1.
constexpr double kFirm = 10.0 / 3.0;
/// On centres of pressure of robots that are tracked. Measured on g1, stepping_stones: it falls with 1.
constexpr double kCentred = 4.0;
/// Merit = cost + this times the sum of the defects. Chosen: an exact penalty where it exceeds the multipliers.
constexpr double kDefectPenalty = 30.0;
/// Of the limits in the last polish, over Weights::limit: what is left of a violation comes below the checker's
/// tolerance, since it falls with the square of the weight. Chosen.
constexpr double kHardening = 4.0;

// Iterations of all stages.

/// Range of the proximal weight. Chosen; weights of 3 to 100 work, below 1 usually not (measured, "Deviations").
constexpr double kProximalMin = 0.1, kProximalMax = 1e6;
/// Factor on the proximal weight when a factorisation fails. Chosen.
constexpr double kProximalRetry = 10.0;
/// With the sequence frozen: times this after a step of at least that length, ... Chosen, as are the next two.
constexpr double kProximalFall = 0.7, kFullStep = 0.99;
/// ... times this after one shorter than that.
constexpr double kProximalRise = 4.0, kShortStep = 0.2;
/// The line search halves the step until it is no longer than this. Chosen.
constexpr double kStepEnd = 1.0 / 64.0;
/// A switch must lower the cost by this fraction, so that two sequences of equal cost do not alternate. Chosen.
constexpr double kSwitchGain = 1e-4;
constexpr int kSwitchesPerIteration = 6;  ///< chosen

// Discovery.

/// Iterations after the contact weight has reached its maximum. Chosen.
constexpr int kFreeAtFullWeight = 25;
/// The same before the interior point, which ends at the same optimum from less: running without a switch. Measured on
/// five scenes: with 3, 5 and 25 plans of the same cost.
constexpr int kCalmAtFullWeight = 5;
/// Proximal weight of the second discovery over the first one's: shorter steps lead to other sequences. Chosen.
constexpr double kSecondDiscovery = 4.0;
/// States a step that the first sequence's dynamic programming keeps. Chosen: bounds it on large scenes.
constexpr std::size_t kBeam = 4000;
/// Ratio of what is left of the time limit that it may take; after that a walk in turns takes its place. Chosen.
constexpr double kInitialShare = 0.3;
/// States between two questions whether to stop, and such questions between two calls of the user's. Chosen: a stop
/// request may take longer than a look at the clock.
constexpr int kStatesPerPoll = 32, kPollsPerRequest = 16;

// Polish.

/// First proximal weight, before and from refinement on. Chosen.
constexpr double kPolishProximal = 10.0, kTrialProximal = 3.0;
/// Iterations of a guess, and of the last polish. Chosen.
constexpr int kPolishIterations = 60, kFinalIterations = 120;
/// Converged when the merit changes by less than this fraction, of a guess and in the last polish, ... Chosen, as are
/// the next two.
constexpr double kRoughTolerance = 1e-3, kFinalTolerance = 1e-4;
/// ... so many times running with no defect above that.
constexpr int kConvergedIterations = 3;
constexpr double kConvergedDefect = 1e-4;
/// Progress comes in bursts, so it is judged over so many iterations, and extrapolated by so many times as many.
/// Chosen.
constexpr int kWindow = 5;
constexpr double kWindowsAhead = 3.0;

// Polish by interior point.

/// First barrier parameter of guesses and of trials, and of a motion that has been optimised before. Measured on
/// sequences of seven robots and scenes: 1e-2 to 1e-3 serve from anywhere, 1e-4 after a warm-up, 1e-5 from a solution.
constexpr double kColdBarrier = 1e-2, kTrialBarrier = 1e-4, kWarmBarrier = 1e-5;
/// The same of an earlier plan that begins elsewhere now. Measured on a prototype: with 1e-5 up to 100 iterations.
constexpr double kMovedBarrier = 1e-3;
/// First proximal weight of guesses, and iterations of the penalty polish before them where there was no discovery, and
/// before trials: contacts that are exact at once lead to merits of 1e3 where the sequence has just changed.
/// Measured: a walk of g1 in 28 phases converges in 5 + 26 iterations instead of 84, stairs of humanoid44 in 5 + 16
/// instead of 20 ("Polish by interior point").
constexpr double kColdProximal = 30.0;
constexpr int kWarmUpIterations = 5;
/// Iterations of a guess, of a trial, of the last polish. Chosen.
constexpr int kExactGuessIterations = 100, kExactTrialIterations = 30, kExactLastIterations = 60;
/// Trials before a local optimum is declared. Measured on 41 pairs of robot and scene: with 5 two end 9 % above the
/// penalty, with 8 none above 2 %.
constexpr std::size_t kExactTrials = 8;

// Refinement.

/// Iterations of a trial, trials before a local optimum is declared, rounds. Chosen.
constexpr int kTrialIterations = 20, kTrials = 10, kRefineRounds = 30;
/// Trials before a local optimum is declared of robots that crawl on four point feet. Measured (docs/tracking.md,
/// "Quadrupeds"): ten take up to twice as long for a few hundredths of the cost, which are swings that overlap.
constexpr std::size_t kCrawlTrials = 4;
/// Fraction by which a trial must lower the merit. Chosen.
constexpr double kTrialGain = 2e-3;
/// Riccati steps beyond which the whole-sequence move is left out. Chosen.
constexpr std::size_t kWholeSequenceBudget = 1000;
/// Steps by which a swing is moved, and steps between two swings that may be exchanged. Chosen.
constexpr int kSwingShifts[] = {-2, -1, 1, 2}, kExchangeSteps = 6;
/// Time limits [s] that leave less are met with the caller's thread alone, and how often that asks whether to stop
/// while it waits for others [us]. Chosen.
constexpr double kAheadRest_s = 2.0;
constexpr int kAskPause_us = 500;

/// Candidates from which on threads save more than they cost. Measured; the paper found the same.
constexpr std::size_t kWorthThreads = 400;

// Exact contacts.

/// Weight on what is held: far above all others (1e6 at most), low enough to leave the factorisation its digits.
constexpr double kFixed = 1e10;
/// The stiff costs count a little, so that the change avoids the limits, but not so much that it runs through the
/// inputs that are soft (durations above all) beyond where the linear model holds. Chosen.
constexpr double kCostShare = 1e-3;
/// Ratio of the least torsion of a phase that moments are cut to: the steps still change it. Chosen.
constexpr double kTorsionSpare = 0.9;
/// Most by which a near miss makes joints weaker or slower at once, as a ratio: that of ten tolerances.
constexpr double kJointSpareMax = 0.2;
/// Defects that count as closed, and Newton steps for it: quadratic from 1e-3 on, but every input that meets its bound
/// costs a step. Chosen.
constexpr double kExactDefect = 1e-13;
constexpr int kExactSteps = 30;

// Restarts and statuses.

/// Proximal weight and first guess of the durations [s] of the restarts. Chosen: what the outcome depends on most
/// (docs/robustness.md).
struct RestartSetting {
  double proximal_weight, duration_s;
};
constexpr RestartSetting kRestarts[] = {{10.0, 0.30}, {100.0, 0.40}, {30.0, 0.35},
                                        {10.0, 0.45}, {100.0, 0.30}, {30.0, 0.50}};
/// In so few phases the best plan is brought to the optimum of its sequence by the interior point, which takes 0.04 s,
/// and so are those of more discoveries, with other proximal weights and first guesses of the durations, as ratios of
/// their box, and those of stepping sequences at the first of these. Chosen; measured by benchmarks/optimality.py.
constexpr int kFewPhases = 12;
struct Pace {
  double share, proximal_weight;
};
constexpr Pace kFewPhasesPaces[] = {{0.4, 30.0},   {1.0, 30.0}, {0.1, 30.0}, {0.2, 30.0},  {0.7, 30.0},  {0.3, 30.0},
                                    {0.15, 100.0}, {0.5, 10.0}, {0.25, 3.0}, {0.05, 30.0}, {0.3, 200.0}, {0.5, 100.0}};
constexpr int kFewPhasesStepping = 2;
/// So many attempts without a cheaper motion end that. Measured on 22 searches of up to 26 attempts: the cheapest came
/// with the seventh at the latest.
constexpr int kFewPhasesPatience = 8;
/// The end of a sequence is changed where its motion costs at most this ratio of the cheapest. Measured likewise: with
/// 1.2 `stairs` in 10 phases ends at 0.116 instead of 0.090.
constexpr double kTailsWithin = 1.5;
/// How much further inside footholds go, each time a swing has caught an edge: a ratio of the longest half sole, so
/// that the second time the whole sole stands clear of the next riser, and at least so much [m]. Measured
/// ("Deviations"): 300 random scenes solved, 289 without.
constexpr double kClearanceShare = 0.6, kClearanceMin_m = 0.04;
/// Where soles are kept on their surface anyway, a toe's room is enough [m]. Measured likewise.
constexpr double kExtraMargin_m = 0.03;
/// A violation within this factor of its tolerance is called acceptable, beyond it infeasible. Chosen.
constexpr double kAcceptable = 10.0;

/// A near miss is mended in so many rounds, with that ratio of the iteration limit on top, and each is converged to
/// that: a base that turns at the goal as fast as the checker allows costs 1e-4. Chosen.
constexpr int kMendRounds = 5;
constexpr double kMendRatio = 0.1, kMendTolerance = 1e-6;
/// Before there are restarts, as long as that makes the motion dearer by no more than this ratio, or a walk in many
/// phases costs no more than that a phase. Chosen.
constexpr double kMendDearer = 1.25, kFairPhase = 0.02;
/// Plans whose costs differ by less, as a ratio, are the same one: it is mended once. Chosen.
constexpr double kSameOptimum = 1e-3;

// Method::paper.

/// Without a proximal term the published algorithm diverges on every scene. Measured ("Paper mode").
constexpr double kPaperProximal = 10.0;
/// The paper counts about 50 iterations to convergence and reports averages over 100.
constexpr int kPaperIterations = 60;

// Scenes of many surfaces.

/// Of the first and the second search: surfaces within so many reaches of the way, and the nearest ones among which a
/// contact is looked for, if they are within so many diagonals of the reach. Chosen: all surfaces of the built-in
/// scenes lie within the first ("Many surfaces").
constexpr double kOutlookReach[] = {1.0, 4.0}, kOutlookWithin[] = {0.75, 0.0};
constexpr std::size_t kFewSurfaces = 16;  ///< that no search looks past, however far away they are; chosen
constexpr int kOutlookNearest[] = {32, 128};

// Time limits and plans.

/// Instants at which iterates are checked: so many in all, and so many a phase, fewer once the time is over. Chosen.
constexpr double kLookInstants = 400.0, kLookInstantsPerPhase = 3.0, kLookInstantsPerPhaseLate = 1.0;
/// Instants of a check in full at most: those of a plan of 1000 s. The checker takes twice as many. Chosen.
constexpr double kFullInstantsMax = 1e6;
/// Rounds that Newton's method takes at least to make the first iterate exact, from a defect of a tenth to rounding:
/// 1e-1, 1e-2, 1e-4, 1e-8, 1e-16.
constexpr double kExactRoundsMin = 4.0;
/// The first iterate may be made exact for so long after the limit [s]: the only plan there is. Chosen.
constexpr double kGrace_s = 0.01;
/// An iterate is looked at after so many iterations, the next one after twice as many more, and so on. Chosen; what it
/// costs is in "Time limit".
constexpr int kLookPause = 8;
/// Once there is a plan that the checker accepts, only one of so much less merit is looked at. Chosen.
constexpr double kCheaper = 0.9;

// Replanning.

/// The first phase lasts at least so long [s]: what is left of one may be nothing. Chosen.
constexpr double kReplanRest_s = 0.02;
/// Phases before and after the one under way among which measured contacts are looked for. Chosen.
constexpr int kContactsAhead = 2;
/// An end-effector that is late comes down at this speed [m/s] at least, and the phase put in for it takes at least and
/// at most so long [s]. Chosen.
constexpr double kLateDescent = 0.3, kLateMin_s = 0.02, kLateMax_s = 0.1;
/// First guess of the phases at the end in which the robot stands [s]. Chosen.
constexpr double kStanding_s = 0.3;
/// A robot that stops stands for so many phases of that length, feet land within so many heights of the CoM of where
/// they were to, on one of so many surfaces, and one after the other in such intervals [s]. Chosen.
constexpr int kStopPhases = 4;
constexpr double kStopReach = 0.5;
constexpr std::size_t kStopGrounds = 2;
constexpr double kStopApart_s = 0.05;
/// Weight on the distance of footholds from where they were planned, of those that are committed and of others, and the
/// distance [in CoM heights] up to which the price grows with its square, then with itself. With it, footholds of
/// states that are as planned move by less than 1 mm; measured.
constexpr double kCommitted = 1000.0, kKept = 12.0, kKeptBend = 0.01;
/// First barrier parameter from a state that is not the planned one, and iterations of a sequence.
constexpr double kReplanBarrier = 1e-3;
constexpr int kReplanIterations = 42;
/// A sequence that is foreseen to cost more than this after so many iterations is given up. Measured on 600 draws of
/// benchmarks/replanning.py: what was accepted cost at most 46, what was not and was given its iterations 100 to
/// 11,000.
constexpr double kHopeless = 300.0;
constexpr int kHopelessPatience = 25;
/// Another step is not tried where the plan's own sequence ends with a cost above this: none of 1,020 draws gained by
/// it.
constexpr double kHopelessWithMore = 100.0;
/// The base's angle and momentum at the end of a replan weigh more than in a search by this ratio: the solve is short,
/// and the checker asks for 0.01 rad/s. Measured.
constexpr double kEndFirmer = 3.0;
/// What comes after the solve under a time limit [ms a phase]: exact contacts, swings, the check of the next steps, and
/// where that finds them wanting, the check of those that were planned. Measured.
constexpr double kFinishing_ms = 0.2;
/// Limits shorter than so many times that are those in which the plan as it was planned is looked at first. Chosen.
constexpr double kShortLimits = 1.5;
/// Fewer iterations than these are not worth a sequence. Chosen.
constexpr int kWorthwhile = 10;
/// Swings of steps that are put in last so much of the way from the shortest to the longest phase. Chosen.
constexpr double kAddedSwing = 0.6;
/// Under a velocity command the robot stops within so long at the end of the horizon [s]; ground there may lie so far
/// from where a foot is due, in heights of the CoM; and strides take at most so much of the length of a reach box, all
/// chosen, and of a crawl's measured (docs/online.md, "Four feet").
constexpr double kCommandStop_s = 0.8, kCommandOff = 0.15, kCommandStride = 0.85, kCrawlStride = 0.7;
/// What a start violates is made good within this ratio of the time that the checker forgives it for: limits are held
/// at a few instants, and those move with the durations. Chosen.
constexpr double kSlackRatio = 0.85;
/// A measured contact may lie so far off its surface [m]. Chosen: more is no noise.
constexpr double kStandsOff_m = 0.1;
/// A phase that ends within the committed time keeps its duration up to this ratio. Chosen.
constexpr double kCommittedRatio = 0.02;

/// Vertical velocity of the CoM of replans weighs more than level velocity by this ratio. Without, a push is answered
/// by dropping the CoM, which slows down its fall to the side, by up to 0.2 m at 0.9 m/s: knees cannot catch that.
/// Measured.
constexpr double kVerticalFirmer = 5.0;

/// A phase that is under way is drawn to what is left of it by so many times the weight of other durations. Measured:
/// with 1 what asks for longer phases, as a turn does, puts the end off in replan after replan.
constexpr double kUnderWay = 10.0;

/// Durations have a soft bound only: an iterate that is stopped early may have one below zero, which no plan can have
/// [s]. Chosen.
constexpr double kPhaseMin_s = 1e-3;

}  // namespace mcplan::ddp
