#pragma once

#include "mcplan/online/felt_push.hpp"
#include "model/fields.hpp"

namespace mcplan::model {

template <>
struct Fields<online::FeltPush> {
  using Push = online::FeltPush;
  static constexpr const char* name = "FeltPush";
  static constexpr const char* meaning = "What pushes a robot to a side, as its controller feels it.";
  static constexpr auto all =
      std::make_tuple(field("acceleration_W", &Push::acceleration_W, "m/s^2",
                            "Of the CoM on the level, which the controller's model does not explain.")
                          .within(-100.0, 100.0),
                      field("lasted_s", &Push::lasted_s, "s", "Time for which it has been felt.").not_negative());
};

}  // namespace mcplan::model
