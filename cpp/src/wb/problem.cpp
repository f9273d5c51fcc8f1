#include "mcplan/wb/problem.hpp"

#include <cmath>
#include <utility>

#include "mcplan/base/error.hpp"

namespace mcplan::wb {
namespace {

void require(bool holds, const std::string& field, const std::string& rule, const std::string& found) {
  if (!holds) throw InvalidInput(field, rule, found);
}

}  // namespace

void Problem::validate() const {
  const int count = velocity_count(), ends = static_cast<int>(end_effectors.size());
  require(count >= 6, "links", "must begin with the six of the base", std::to_string(count));
  require(node_count() >= 4, "nodes", "must be at least 4", std::to_string(node_count()));
  require(posture.size() == joint_count(), "posture", "must have " + std::to_string(joint_count()) + " values",
          std::to_string(posture.size()));
  require(weight_N > 0.0 && std::isfinite(weight_N), "weight_N", "must be positive", std::to_string(weight_N));
  require(point_load_min >= 0.0 && point_load_min < 0.25, "point_load_min", "must lie in [0, 0.25)",
          std::to_string(point_load_min));
  for (int i = 0; i < count; ++i) {
    const std::string name = "links[" + std::to_string(i) + "]";
    const Link& link = links[i];
    require(link.parent >= -1 && link.parent < i, name + ".parent", "must be a link before it",
            std::to_string(link.parent));
    if (i < 6) continue;
    require(link.position_min < link.position_max, name + ".position_min", "must be below position_max",
            std::to_string(link.position_min));
    require(link.velocity_max > 0.0, name + ".velocity_max", "must be positive", std::to_string(link.velocity_max));
    require(link.torque_max > 0.0, name + ".torque_max", "must be positive", std::to_string(link.torque_max));
  }
  for (int e = 0; e < ends; ++e)
    require(end_effectors[e].link >= 0 && end_effectors[e].link < count,
            "end_effectors[" + std::to_string(e) + "].link", "must be a link", std::to_string(end_effectors[e].link));
  for (int k = 0; k < node_count(); ++k) {
    const std::string name = "nodes[" + std::to_string(k) + "]";
    require(k == 0 || nodes[k].time_s > nodes[k - 1].time_s, name + ".time_s", "must ascend",
            std::to_string(nodes[k].time_s));
    for (const auto& [field, factor] :
         {std::pair{".acceleration", nodes[k].acceleration}, {".torque", nodes[k].torque}})
      require(factor >= 0.0 && std::isfinite(factor), name + field, "must be finite and not negative",
              std::to_string(factor));
    for (const Contact& contact : nodes[k].contacts) {
      require(contact.end_effector >= 0 && contact.end_effector < ends, name + ".contacts", "must be of end-effectors",
              std::to_string(contact.end_effector));
      require(contact.friction > 0.0, name + ".contacts.friction", "must be positive",
              std::to_string(contact.friction));
      require(contact.points_S.cols() == end_effectors[contact.end_effector].points_S.cols(),
              name + ".contacts.points_S", "must be as many as those of the end-effector",
              std::to_string(contact.points_S.cols()));
      require(contact.load_max > point_load_min * weight_N, name + ".contacts.load_max",
              "must be above point_load_min of weight_N", std::to_string(contact.load_max));
    }
    for (const Swing& swing : nodes[k].swings)
      require(swing.end_effector >= 0 && swing.end_effector < ends, name + ".swings", "must be of end-effectors",
              std::to_string(swing.end_effector));
  }
  const int hulls = static_cast<int>(capsules.size());
  for (const Capsule& capsule : capsules)
    require(capsule.link >= 0 && capsule.link < count, "capsules", "must be fixed to links",
            std::to_string(capsule.link));
  for (const CapsulePair& pair : pairs)
    require(pair.first >= 0 && pair.first < hulls && pair.second >= 0 && pair.second < hulls, "pairs",
            "must be of capsules", std::to_string(std::max(pair.first, pair.second)));
}

}  // namespace mcplan::wb
