// Wheel over one limb: joints, forces and timing of a planar robot, proved to keep its limits at every instant.

#include <cstdio>
#include <mcplan/mcplan.hpp>
#include <string>

namespace {

void print(const char* name, const mcplan::sip::Result& found) {
  std::printf("%s: %s, %d iterations, %.1f s, %.0f N2 m2 s in %.2f s\n", name,
              std::string(mcplan::to_string(found.report.status)).c_str(), found.report.iterations, found.report.time_s,
              found.report.cost, found.plan.duration());
}

}  // namespace

int main() {
  const mcplan::PlanarTask task = mcplan::load_planar_task("cartwheel");

  // First with forces that share the load evenly, then with a weight for each point of contact, from where the first
  // ends.
  mcplan::sip::Options options;
  options.time_limit_s = 60.0;
  options.forces = mcplan::sip::Forces::uniform;
  const mcplan::sip::Result even = mcplan::sip::Planner(task, options).solve();
  print("uniform", even);
  options.forces = mcplan::sip::Forces::per_point;
  const mcplan::sip::Result result = mcplan::sip::Planner(task, options).solve(even.plan);
  print("per point", result);
  if (result.report.status != mcplan::Status::solved) {
    std::printf("%s\n", result.report.message.c_str());
    return 1;
  }
  const mcplan::sip::Certificate certificate = mcplan::sip::certify(result.plan);
  std::printf("%s\n", certificate.to_string().c_str());

  const mcplan::PlanarState state = result.plan.at(0.5);  // any instant: base, joints, torques, contact forces
  std::printf("at 0.5 s the joints need");
  for (const double torque : state.torque) std::printf(" %.0f", torque);
  std::printf(" N m\n");
  for (const mcplan::PlanarPointForce& force : state.forces)
    std::printf("  point %d of limb %s: %.0f N into the limb, %.0f N along\n", force.point,
                task.robot.end_effectors[force.end_effector].name.c_str(), force.normal, force.tangential);
  result.plan.save("cartwheel.json");
  return certificate.proved() ? 0 : 1;
}
