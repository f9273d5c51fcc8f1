#pragma once

#include <optional>
#include <vector>

#include "ddp/best_plan.hpp"
#include "ddp/ending.hpp"
#include "ddp/headings.hpp"
#include "ddp/problem.hpp"
#include "ddp/reachable_surfaces.hpp"
#include "mcplan/base/deadline.hpp"
#include "mcplan/plan/report.hpp"

namespace mcplan::ddp {

/// A search of its own: along a course, with flights or without.
struct Way {
  Course course = {};
  bool flights = true;
  int min_contacts = 0;
  bool brief = false;        ///< one attempt: there is a plan already, and this way is the answer only if it costs less
  bool watch = false;        ///< swings are held out of solids from the first attempt on
  bool longer = false;       ///< at once in more phases than its length asks for, as the plan that there is
  bool crawl_known = false;  ///< what a crawl comes to is known
  bool walk_known = false;   ///< and what footsteps come to
  bool even_too = false;     ///< footsteps are tried though all of them are alike
  int iterations = 0;        ///< of the report, after which it ends; 0: the limit of the options
  bool over_bars = false;    ///< the ground is cut at what stands low across the way
  bool far = false;          ///< feet reach all of their boxes, beyond what is usual of them
};

/// What it has found.
struct Found {
  BestPlan best;
  Ending ending = Ending::no_sequence;
  int steps = 0;
  Way way = {};
  bool crawled = false;                 ///< also in more phases than the way asks for
  bool tried_more = false;              ///< in more phases than the way asks for
  bool easy_walk = false;               ///< from footsteps
  bool even_ground = false;             ///< where these are all alike
  std::vector<int> surfaces = {};       ///< that it has looked at
  std::optional<Barrier> barrier = {};  ///< why no ground leads to the goal
};

/// Whether a search that ended so may have missed what it did not look at.
bool ended_by_itself(Ending ending);

/// Whether an accepted plan costs so much that steps as long as that strain the robot. A flight costs more by itself.
bool strains(const BestPlan::Finished& found);

/// Whether a plan is better, and where its steps alone go beyond the usual reach, whether it is worth that.
bool better_walk(const Found& one, const Found& other);

/// Call surfaces in rows of the report from this one on as the scene does.
void name_surfaces(Report& report, std::size_t first_row, const std::vector<int>& surfaces);

/// The ways from the start of a scene to its goal, and a search along each. Theory: docs/theory/ddp.md, "Routes".
class WaysToGoal {
 public:
  /// Keeps references. `earlier`: a plan to begin with, or null.
  WaysToGoal(const Scene& scene, const Robot& robot, const Options& options, const Plan* earlier,
             const Deadline& deadline)
      : scene_(&scene), robot_(&robot), options_(&options), earlier_(earlier), deadline_(&deadline) {}

  /// Straight on; where steps do not lead along there, round what is in the way as well, and where they do, again
  /// without flights if there were any. The best of what is found; once there is a plan, other ways are tried briefly.
  Found search(Report& report) const;

 private:
  std::vector<int> surfaces_of(const Route& route, const Outlook& outlook) const;
  /// What a search along a way is told besides, in a thread beside others: it is heard of later.
  struct Beside {
    StopRequest stop;
  };
  struct Posed {
    Problem problem;
    std::vector<int> surfaces;
    bool all = true;  ///< of the scene's
  };
  Problem pose(const Way& way, int phases, std::vector<int>& surfaces, const Beside* beside) const;
  Posed pose_within(int level, const Way& way, int phases, const Beside* beside) const;
  bool crawl_along(const Way& way, Report& report, Found& found, const Beside* beside) const;
  void search_in(int phases, const Way& way, Report& report, Found& found, const Beside* beside = nullptr) const;
  Found search_along(const Way& way, Report& report, const Beside* beside = nullptr) const;
  void improve(const Way& way, const BestPlan::Finished* plan, Report& report, Found& found) const;
  bool phases_given() const;
  int more_phases(const Found& found) const;
  int first_phases(const Way& way) const;
  void try_more_phases(Report& report, Found& found, const Beside* beside = nullptr) const;
  bool steps_freely() const;
  double price_of(const Way& way) const;
  bool longer(const Way& way, const Found& easy) const;
  bool in_vain(const Way& way, const Found& best) const;
  Found walk_in(double stride_ratio, int again, const Way& way, Report& report, const Beside* beside) const;
  Found walk_with(double stride_ratio, int again, const Way& way, Report& report, const Beside* beside) const;
  /// What footsteps have led to; `easy`: there is no need to look for another plan.
  struct Walked {
    Found found;
    bool easy = false;
    bool done() const;
  };
  Walked walk_near_and_far(const Way& way, Report& report, const Beside* beside) const;
  void walk_evenly(Report& report, Found& found, const Beside* beside) const;
  std::optional<Found> walk_over(Way& bars, Report& report) const;
  Walked walk_along(const Way& way, Report& report, const Beside* beside) const;
  void walk_at_last(Report& report, Found& found) const;
  Found search_phases(const Way& way, Report& report, const Beside* beside) const;
  void mend(Report& report, Found& found, double dearest, const Beside* beside = nullptr) const;
  bool four_feet_stand() const;
  /// Ways to try, those that may lead to the goal, and others for want of a plan; `bars`: something low stands across.
  struct Listed {
    std::vector<Way> sure, otherwise;
    bool bars = false;
  };
  Listed ways_of(const Routes& routes, bool given, int least) const;
  double phases_facing(const Route& route) const;
  void tell(const Way& way, const Found& found) const;
  /// What a thread has found on a way ahead of the others, if it came to its end.
  struct Ahead {
    std::optional<Found> found;
    Report report;
    int before = 0;  ///< iterations at its beginning
  };
  std::vector<Ahead> search_ahead(const std::vector<Way>& ways, const Report& before) const;

  const Scene* scene_;
  const Robot* robot_;
  const Options* options_;
  const Plan* earlier_;
  const Deadline* deadline_;
};

}  // namespace mcplan::ddp
