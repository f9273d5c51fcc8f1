#pragma once

#include "mcplan/base/entire_functions.hpp"
#include "mcplan/base/error.hpp"
#include "mcplan/base/logging.hpp"
#include "mcplan/base/rotation.hpp"
#include "mcplan/base/status.hpp"
#include "mcplan/plan/checker.hpp"
#include "mcplan/plan/plan.hpp"
#include "mcplan/plan/report.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/polygon.hpp"
#include "mcplan/scene/scene.hpp"
#include "mcplan/version.hpp"
