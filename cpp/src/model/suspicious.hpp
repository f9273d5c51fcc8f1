#pragma once

/// Numbers that give units away.
namespace mcplan::model {

/// [m] of a robot; above it a length is taken to be in millimetres.
constexpr double high_com_m = 50.0;

/// [m/s^2]; above it a gravity is taken to be in millimetres: there is none like it on any planet.
constexpr double strong_gravity = 100.0;

constexpr const char* gravity_rule =
    "goes with lengths in metres, which these look like, and this looks like one for millimetres";

}  // namespace mcplan::model
