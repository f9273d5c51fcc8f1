#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "mcplan/plan/plan.hpp"

namespace mcplan::bindings {
namespace {

/// An array of doubles that is filled instant by instant: the first index is the instant.
class Column {
 public:
  Column(const char* name, std::vector<py::ssize_t> shape) : name_(name), array_(std::move(shape)) {
    next_ = array_.mutable_data();
  }
  template <class V>
  void add(const V& v) {
    for (Eigen::Index i = 0; i < v.size(); ++i) *next_++ = v[i];
  }
  void add(double value) { *next_++ = value; }
  void give(py::dict& out) { out[name_] = std::move(array_); }

 private:
  const char* name_;
  py::array_t<double> array_;
  double* next_;
};

py::dict plan_samples(const Plan& plan, const std::vector<double>& times) {
  plan.validate();
  const auto n = static_cast<py::ssize_t>(times.size()), count = static_cast<py::ssize_t>(plan.end_effector_count());
  py::array_t<int> phase(n), surfaces({n, count});
  Column com("com_W", {n, 3}), velocity("com_velocity_W", {n, 3}), acceleration("com_acceleration_W", {n, 3});
  Column rpy("base_rpy", {n, 3}), rate("base_rpy_rate", {n, 3}), quat_wxyz("base_quat_wxyz", {n, 4});
  Column momentum("angular_momentum_W", {n, 3}), place("end_effectors_W", {n, count, 3});
  Column speed("end_effector_velocities_W", {n, count, 3}), force("forces_W", {n, count, 3});
  Column moment("moments_W", {n, count, 3}), center("centers_of_pressure_W", {n, count, 3}),
      yaw("end_effector_yaw", {n, count});
  int *next_phase = phase.mutable_data(), *next_surface = surfaces.mutable_data();
  const double end_s = plan.duration();
  constexpr double kRounding = 1e-9;  // as Plan::at
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!(times[i] >= -kRounding && times[i] <= end_s + kRounding))
      throw InvalidInput("times[" + std::to_string(i) + "]", "must lie in [0, " + text(end_s) + "] s", text(times[i]));
    const PlanState now = plan.at(times[i]);
    *next_phase++ = now.phase;
    com.add(now.com_W);
    velocity.add(now.com_velocity_W);
    acceleration.add(now.com_acceleration_W);
    rpy.add(now.base_rpy);
    rate.add(now.base_rpy_rate);
    quat_wxyz.add(now.base_quat_wxyz);
    momentum.add(now.angular_momentum_W);
    for (const EndEffectorState& end : now.end_effectors) {
      *next_surface++ = end.surface;
      place.add(end.position_W);
      speed.add(end.velocity_W);
      force.add(end.force_W);
      moment.add(end.moment_W);
      center.add(end.center_of_pressure_W);
      yaw.add(end.yaw);
    }
  }
  py::dict out;
  out["phase"] = std::move(phase);
  out["surfaces"] = std::move(surfaces);
  for (Column* column : {&com, &velocity, &acceleration, &rpy, &rate, &quat_wxyz, &momentum, &place, &speed, &force,
                         &moment, &center, &yaw})
    column->give(out);
  return out;
}

}  // namespace

void bind_plan_samples(py::module_& m) {
  m.def("plan_samples", &plan_samples, py::arg("plan"), py::arg("times"),
        "Arrays of what Plan.at says at the times [s]. Raises InvalidInput that names the time, and InvalidPlan.");
}

}  // namespace mcplan::bindings
