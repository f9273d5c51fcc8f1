#pragma once

#include "mcplan/ddp/replan.hpp"
#include "model/fields.hpp"

namespace mcplan::model {

template <>
struct Fields<ddp::VelocityCommand> {
  using Command = ddp::VelocityCommand;
  static constexpr const char* name = "VelocityCommand";
  static constexpr const char* meaning = "A velocity to walk at, instead of the scene's goal.";
  static constexpr auto all = std::make_tuple(
      field("velocity_B", &Command::velocity_B, "m/s", "Of the CoM: ahead and to the left of the heading."),
      field("yaw_rate", &Command::yaw_rate, "rad/s", "Of the base, to the left."));
};

template <>
struct Fields<ddp::ReplanOptions> {
  using Options = ddp::ReplanOptions;
  static constexpr const char* name = "ReplanOptions";
  static constexpr const char* meaning = "How to plan on from a measured state, beside the options of the search.";
  static constexpr auto all = std::make_tuple(
      field("committed_s", &Options::committed_s, "s",
            "Contacts that are due within this time are made and broken as planned, when and where. The default goes "
            "with the size of the robot.")
          .not_negative(),
      field("start_slack_s", &Options::start_slack_s, "s",
            "Time within which what the measured state itself violates has to be made good. The default goes with the "
            "size of the robot.")
          .not_negative()
          .at_most(5.0),
      field("phases_min", &Options::phases_min, "",
            "The horizon never gets shorter than this: at its end the robot stands.")
          .at_least(1)
          .at_most(400),
      field("horizon", &Options::horizon, "",
            "Number of phases that are planned ahead under a velocity command. To a goal twice as many are planned "
            "anew: what comes later stays as it was planned.")
          .at_least(3)
          .at_most(400),
      field("other_sequences", &Options::other_sequences, "",
            "Try sequences near to the plan's own where that does not do."),
      field("recovery_first", &Options::recovery_first, "",
            "Pushed, try steps that catch the robot before the plan's own sequence, not after it."),
      field(
          "crossing", &Options::crossing, "",
          "Where the plan's own sequence does not catch a push outward over the foot that stands, the foot in the air "
          "may step across it, in front of it or behind it."),
      field("max_work", &Options::max_work, "",
            "Iterations times phases, over all sequences, after which no other one is tried: 1000 take about 30 ms.")
          .not_negative(),
      field("previous_accepted", &Options::previous_accepted, "",
            "The checker has accepted the plan under way, to its end: what is kept of it, on the same scene and for "
            "the same robot, is not looked at again."));
};

}  // namespace mcplan::model
