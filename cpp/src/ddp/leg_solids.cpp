#include <algorithm>

#include "ddp/costs/prism.hpp"
#include "ddp/hip.hpp"
#include "ddp/leg_lines.hpp"
#include "mcplan/base/rotation.hpp"
#include "plan/solid_box.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// How far from its reference a leg may be, in heights of the CoM. Chosen.
constexpr double kLegMove = 0.2;
/// What is at least so far below the CoM, in its heights, is no obstacle for a knee: ground, curbs, treads. Chosen.
constexpr double kBelowKnees = 0.85;

}  // namespace

/// The solids that come near the legs, which are bodies, along the reference, whichever way they turn.
void Problem::find_leg_solids() {
  leg_solids.clear();
  leg_rooms.clear();
  double aside = 0.0, high = 0.0;
  for (int l : jointed.ends) {
    const LimbLimits& limb = limits[l].limb;
    if (!(limb.radius > 0.0)) continue;
    const double room = kLegRoom * limb.radius + kLegMove;
    aside = std::max(aside, limb.hip_B.head<2>().norm() + std::abs(limb.beside) + 0.5 * limb.upper + room);
    high = std::max(high, limb.hip_B.z() + room);
  }
  if (options.method == Method::paper || !(aside > 0.0)) return;
  if (solid_boxes.empty())
    for (std::size_t i = 0; i < polygons.size(); ++i) solid_boxes.push_back(box_of(Solid{polygons[i], thickness[i]}));
  std::vector<Eigen::AlignedBox3d> pieces;
  for (int k = 0; k < steps; ++k) {
    Eigen::AlignedBox3d& piece = pieces.emplace_back();
    for (int j : {k, k + 1}) {
      const Vector3d com = reference.x[j].segment<3>(layout.com());
      piece.extend(com + Vector3d(-aside, -aside, -kBelowKnees)).extend(com + Vector3d(aside, aside, high));
    }
  }
  for (std::size_t i = 0; i < polygons.size(); ++i)
    if (std::any_of(pieces.begin(), pieces.end(), [&](const auto& piece) { return piece.intersects(solid_boxes[i]); }))
      leg_solids.push_back(static_cast<int>(i));
  make_leg_rooms();
}

/// Where the scene itself puts a leg nearer to a solid than that there is no more room to ask for.
void Problem::make_leg_rooms() {
  leg_rooms.resize(limits.size());
  for (int l : jointed.ends) {
    const LimbLimits& limb = limits[l].limb;
    for (int solid : leg_solids) {
      double room = kLegRoom * limb.radius;
      for (const VectorXd* x : {&reference.x.front(), &reference.x.back()}) {
        const Vector3d angles = rpy(*x);
        const Eigen::Matrix3d level = rotation_from_rpy({0.0, 0.0, angles.z()});
        const Hip hip(*this, limb, x->segment<3>(layout.com()), rotation_from_rpy(angles), *x, nullptr, 0.0);
        const Vector3d ankle = x->segment<3>(layout.end(l)) + level * limb.ankle;
        const LegLines lines(limb, ankle, hip.place_W - ankle, level.col(0));
        for (const LegLines::Part part : {LegLines::thigh, LegLines::shank}) {
          const Vector3d from = lines.from(part), along = lines.along(part);
          room = std::min(room, nearest_on_line(polygons[solid], thickness[solid], from, along).outside.distance);
        }
      }
      leg_rooms[l].push_back(std::max(room, limb.radius));
    }
  }
}

}  // namespace mcplan::ddp
