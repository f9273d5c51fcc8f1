#pragma once

#include <array>
#include <string>
#include <vector>

#include "mcplan/planar/sip/options.hpp"
#include "mcplan/planar/task.hpp"

namespace mcplan::sip {

/// Where the parameters of a task's program are. P consists of
///
///     control points    of each joint's spline, intervals - 1: the first three of a spline are equal and so are the
///     last
///                       three, which is rest at both ends with free postures; with a parameterised free-flyer three
///                       more splines (x, y, angle of the base)
///     durations         one for each phase, or one for the motion
///     log weights       of contacts (case 2) or of points (case 3), the first of each phase being 1
///     forces            cubic in each interval, two components at each point of a phase (sec. III-C)
struct Layout {
  Layout(const PlanarTask& task, const Options& options);

  int splines = 0, intervals = 0;
  int durations = 0;  ///< phases, or 1
  int first_duration = 0;
  std::vector<int> first_weight, weights;  ///< of each phase
  std::vector<int> first_force, forces;    ///< of each interval
  int parameters = 0;                      ///< N

  int control_points() const { return intervals - 1; }
  int control_point(int spline, int i) const { return i * splines + spline; }

  /// Free control point behind number `full` of the intervals + 3 of a spline.
  int free_of(int full) const;

  int duration_of_phase(int phase) const { return first_duration + (durations == 1 ? 0 : phase); }
};

/// The parameters that one interval touches, in the order of its local columns: control points spline by spline, the
/// durations on which its knots depend, its phase's log weights, its forces.
struct LocalParameters {
  LocalParameters(const PlanarTask& task, const Layout& layout, int interval);

  int interval = 0, phase = 0;
  int splines = 0;
  std::vector<int> controls;           ///< free control points, ascending; one to four
  std::array<int, 4> control{};        ///< of the interval's four: index into controls
  std::vector<int> durations;          ///< variables, ascending
  int own_duration = 0;                ///< index into durations of the interval's phase
  std::array<int, 5> knot_duration{};  ///< of the five spacings about the interval: index into durations
  std::array<double, 5> knot_ratio{};  ///< spacing = ratio * duration
  int weights = 0, forces = 0;
  std::vector<int> variables;  ///< in the program, column by column

  int count() const { return static_cast<int>(variables.size()); }
  int control_column(int spline, int place) const { return spline * static_cast<int>(controls.size()) + place; }
  int duration_column(int i) const { return splines * static_cast<int>(controls.size()) + i; }
  int weight_column(int i) const { return duration_column(static_cast<int>(durations.size())) + i; }
  int force_column(int i) const { return weight_column(weights) + i; }
};

}  // namespace mcplan::sip
