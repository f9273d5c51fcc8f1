#include "mcplan/plan/plan_files.hpp"

#include "mcplan/base/error.hpp"
#include "model/read.hpp"
#include "model/write.hpp"
#include "plan_fields.hpp"
#include "plan_json.hpp"

namespace mcplan {

std::string plan_to_json(const Plan& plan) {
  plan.validate();
  model::Findings found;
  model::check_struct(plan, model::Place(), found);
  found.raise<InvalidPlan>();
  model::Writing in_json;
  in_json.json = true;
  return model::plan_json(model::written(plan, in_json), model::plan_kind);
}

Plan plan_from_json(const std::string& content) {
  return model::plan_from(model::plan_fields(model::parse_plan_json(content), model::plan_kind));
}

Plan model::plan_from(const Value& fields) {
  Reading reading;
  Plan plan;
  if (require_few_keys(fields, reading.found)) read_struct(fields, plan, Place(), reading);
  reading.found.raise<InvalidPlan>();
  try {
    plan.scene.validate();
  } catch (const InvalidScene& bad) {
    throw moved<InvalidPlan>(bad, "", "scene");
  }
  try {
    plan.robot.validate();
  } catch (const InvalidRobot& bad) {
    throw moved<InvalidPlan>(bad, "", "robot");
  }
  plan.validate();
  return plan;
}

Plan load_plan(const std::string& path) {
  try {
    return plan_from_json(model::read_plan_json(path));
  } catch (const InvalidInput& found) {
    model::throw_as<InvalidPlan>(found, path);
  }
}

void Plan::save(const std::string& path) const { model::write_plan_json(plan_to_json(*this), path); }

bool operator==(const Plan& a, const Plan& b) { return model::equal(a, b); }

}  // namespace mcplan
