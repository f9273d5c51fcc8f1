#pragma once

#include "ddp/routes.hpp"

namespace mcplan::ddp {

/// The straight way from start to goal as high as the ground is below the feet that stand at both, along it: over what
/// stands across, onto which a body that tilts gets where a level one does not. Empty: there is no such thing.
Route straight_over(const Scene& scene, const Robot& robot);

}  // namespace mcplan::ddp
