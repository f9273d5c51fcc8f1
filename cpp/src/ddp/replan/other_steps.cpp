#include "ddp/replan/other_steps.hpp"

#include <algorithm>

#include "ddp/constants.hpp"

namespace mcplan::ddp {
namespace {

/// Steps in place, one after the other, put in after phase k, with a short stance after each of them.
Rest with_steps(const Rest& rest, int k, const std::vector<int>& feet, const Eigen::Vector2d& box_s) {
  Rest out = rest;
  const ContactState standing = rest.contacts(k);
  int at = k + 1;
  for (int foot : feet) {
    ContactState swinging = standing;
    swinging[foot] = kFree;
    out.insert(at++, swinging, swing_duration_of(box_s));
    out.insert(at++, standing, box_s[0]);
  }
  return out;
}

}  // namespace

std::vector<Rest> other_steps(const Rest& rest, const Robot& robot, const Similarity& similarity) {
  const Eigen::Vector2d box_s = phase_duration_of(robot, similarity);
  std::vector<int> feet;
  for (int e = 0; e < static_cast<int>(robot.end_effectors.size()); ++e)
    if (robot.end_effectors[e].kind == "foot") feet.push_back(e);
  const auto stands = [&](int k, int e) { return rest.surface(k, e) != kFree; };
  // The first phase in which all feet stand, and whose turn it would be after it.
  int k = 0;
  while (k < rest.size() && !std::all_of(feet.begin(), feet.end(), [&](int e) { return stands(k, e); })) ++k;
  std::vector<Rest> out;
  if (k == rest.size()) return out;
  int turn = k;
  while (turn < rest.size() && std::all_of(feet.begin(), feet.end(), [&](int e) { return stands(turn, e); })) ++turn;
  const auto planned = turn == rest.size()
                           ? feet.end()
                           : std::find_if(feet.begin(), feet.end(), [&](int e) { return !stands(turn, e); });
  std::vector<int> others;
  for (int e : feet)
    if (planned == feet.end() || e != *planned) others.push_back(e);
  if (k == 0) {
    // All stand: another foot steps first. Where nothing is planned the other one follows it.
    for (int e : others) {
      std::vector<int> steps{e};
      for (int f : feet)
        if (planned == feet.end() && f != e) steps.push_back(f);
      out.push_back(with_steps(rest, k, steps, box_s));
      if (planned != feet.end()) out.push_back(with_steps(rest, k, {*planned, e}, box_s));
    }
    return out;
  }
  // A swing is under way: after it another foot, and the same again.
  std::vector<int> swinging;
  for (int e : feet)
    if (!stands(0, e)) swinging.push_back(e);
  for (int e : feet)
    if (stands(0, e) && !swinging.empty()) out.push_back(with_steps(rest, k, {e, swinging.front()}, box_s));
  return out;
}

}  // namespace mcplan::ddp
