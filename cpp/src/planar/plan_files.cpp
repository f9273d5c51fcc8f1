#include "mcplan/planar/plan_files.hpp"

#include <variant>

#include "mcplan/base/error.hpp"
#include "model/read.hpp"
#include "model/write.hpp"
#include "plan/plan_json.hpp"
#include "plan_fields.hpp"

namespace mcplan {
namespace {

/// The points of the splines are as many as the intervals.
void require_few_intervals(const PlanarTask& task) {
  const int count = task.interval_count();
  if (count > model::max_planar_intervals)
    throw InvalidPlan("task.phases", "may have " + text(model::max_planar_intervals) + " intervals at most",
                      text(count));
}

}  // namespace

std::string planar_plan_to_json(const PlanarPlan& plan) {
  plan.validate();
  require_few_intervals(plan.task);
  PlanarPlan said = plan;  // without what its force law does not look at
  std::visit([&](auto law) { law.clear_others(said); }, plan.force_law);
  model::Writing exactly;
  exactly.exact = true;
  return model::plan_json(model::written(said, exactly), model::planar_plan_kind);
}

PlanarPlan planar_plan_from_json(const std::string& content) {
  return model::planar_plan_from(model::plan_fields(model::parse_plan_json(content), model::planar_plan_kind));
}

PlanarPlan model::planar_plan_from(const Value& fields) {
  Reading reading;
  reading.exact = true;
  PlanarPlan plan;
  if (require_few_keys(fields, reading.found)) read_struct(fields, plan, Place(), reading);
  reading.found.raise<InvalidPlan>();
  try {
    plan.task.validate();
  } catch (const InvalidPlanarTask& bad) {
    throw moved<InvalidPlan>(bad, "", "task");
  } catch (const InvalidRobot& bad) {
    throw moved<InvalidPlan>(bad, "", "task.robot");
  }
  require_few_intervals(plan.task);
  // Of a matrix without rows nobody writes the columns.
  if (plan.control_points.rows() == 0) plan.control_points.resize(0, plan.task.interval_count() + 3);
  plan.validate();
  return plan;
}

PlanarPlan load_planar_plan(const std::string& path) {
  try {
    return planar_plan_from_json(model::read_plan_json(path));
  } catch (const InvalidInput& found) {
    model::throw_as<InvalidPlan>(found, path);
  }
}

void PlanarPlan::save(const std::string& path) const { model::write_plan_json(planar_plan_to_json(*this), path); }

bool operator==(const PlanarPlan& a, const PlanarPlan& b) { return model::equal(a, b); }

}  // namespace mcplan
