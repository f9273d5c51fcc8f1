#pragma once

#include "mcplan/planar/checker.hpp"
#include "model/fields.hpp"

namespace mcplan::model {

// A negative tolerance asks for as much to spare, an infinite one for nothing.
template <>
struct Fields<PlanarTolerances> {
  using Tolerances = PlanarTolerances;
  static constexpr const char* name = "PlanarTolerances";
  static constexpr const char* meaning = "Published tolerances of the checker of planar plans.";
  static constexpr auto all = std::make_tuple(
      field("limit", &Tolerances::limit, "-", "Position, velocity and torque beyond their limits, relative.")
          .or_infinite(),
      field("drift", &Tolerances::drift, "m", "End-effector in contact from where it should be.").or_infinite(),
      field("drift_angle", &Tolerances::drift_angle, "rad", "The same of its angle.").or_infinite(),
      field("balance", &Tolerances::balance, "N", "Force that nothing carries.").or_infinite(),
      field("moment", &Tolerances::moment, "N m", "Moment that nothing carries.").or_infinite(),
      field("friction", &Tolerances::friction, "-", "Of m g: tangential force beyond the cone.").or_infinite(),
      field("pull", &Tolerances::pull, "-", "Of m g: pull of a contact.").or_infinite(),
      field("clearance", &Tolerances::clearance, "m", "Swinging end-effector in a solid, capsules in each other.")
          .or_infinite(),
      field("continuity", &Tolerances::continuity, "rad", "Jumps at knots, and what is not rest at the ends.")
          .or_infinite(),
      field("pose", &Tolerances::pose, "m, rad", "Poses at given instants.").or_infinite(),
      field("sample_s", &Tolerances::sample_s, "s", "Sampling in time.").positive());
};

}  // namespace mcplan::model
