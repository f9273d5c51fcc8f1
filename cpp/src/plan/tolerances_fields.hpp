#pragma once

#include "mcplan/plan/checker.hpp"
#include "model/fields.hpp"

namespace mcplan::model {

// A negative tolerance asks for as much to spare, an infinite one for nothing.
template <>
struct Fields<Tolerances> {
  static constexpr const char* name = "Tolerances";
  static constexpr const char* meaning =
      "Published tolerances of the checker, for robots of human size; for others times a factor of each unit.";
  static constexpr auto all = std::make_tuple(
      field("dynamics", &Tolerances::dynamics, "m, m/s, rad, rad/s, kg m^2/s", "Replayed state against the next knot.")
          .or_infinite(),
      field("orientation", &Tolerances::orientation, "rad", "Replayed orientation of the base.").or_infinite(),
      field("center_of_pressure", &Tolerances::center_of_pressure, "m",
            "Centre of pressure off the sole or off the surface.")
          .or_infinite(),
      field("contact_distance", &Tolerances::contact_distance, "m",
            "End-effector in contact off its plane or beyond its polygon.")
          .or_infinite(),
      field("slip", &Tolerances::slip, "m", "Travel of an end-effector while in contact.").or_infinite(),
      field("friction", &Tolerances::friction, "-", "Tangential over normal force, beyond the coefficient.")
          .or_infinite(),
      field("force", &Tolerances::force, "N", "Pull of a contact, or force of a free end-effector.").or_infinite(),
      field("force_cap", &Tolerances::force_cap, "-", "Relative excess over max_force, or over a claimed momentum_max.")
          .or_infinite(),
      field("joint", &Tolerances::joint, "-", "Relative excess over torque and speed limits of joints.").or_infinite(),
      field("moment", &Tolerances::moment, "N m", "Excess over max_moment or the torsion the contact can give.")
          .or_infinite(),
      field("reach", &Tolerances::reach, "m", "Outside the reach box.").or_infinite(),
      field("yaw", &Tolerances::yaw, "rad", "Heading of a sole outside its range.").or_infinite(),
      field("clearance", &Tolerances::clearance, "m", "End-effector, limb or trunk inside a solid.").or_infinite(),
      field("boundary", &Tolerances::boundary, "m, m/s, rad, rad/s", "Start and goal against the scene's.")
          .or_infinite(),
      field("stance", &Tolerances::stance, "m", "End-effectors in contact at the start off the nominal stance.")
          .or_infinite(),
      field("switches", &Tolerances::switches, "-",
            "Contacts made or broken in one step; surface to surface counts two."),
      field("sample_s", &Tolerances::sample_s, "s", "Sampling of the constraints in time.").positive(),
      field("scaled", &Tolerances::scaled, "",
            "Times the factors of the robot's size, which are 1 for CoM heights of 0.4 to 1.6 m, 20 to 160 kg and "
            "earth's gravity; False: as they stand."));
};

}  // namespace mcplan::model
