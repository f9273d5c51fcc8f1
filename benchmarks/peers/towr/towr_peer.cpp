// TOWR plans a motion that is described by a JSON file, and its solution is sampled each millisecond.
//
//   towr_peer problem.json samples.csv report.json
//
// The report has Ipopt's status, iterations and times. What is in the files: towr.py.

#include <ifopt/ipopt_solver.h>
#include <towr/models/kinematic_model.h>
#include <towr/models/single_rigid_body_dynamics.h>
#include <towr/nlp_formulation.h>
#include <towr/variables/euler_converter.h>

#include <Eigen/Dense>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace {

using Eigen::Vector3d;
using nlohmann::json;

Vector3d vector_of(const json& values) {
  return Vector3d(values.at(0).get<double>(), values.at(1).get<double>(), values.at(2).get<double>());
}

/// Pieces along x, each level or a parabola between level ones: what TOWR's own examples of terrain are made of.
class Profile : public towr::HeightMap {
 public:
  explicit Profile(const json& given, double friction) {
    friction_coeff_ = friction;
    for (const json& piece : given)
      pieces_.push_back({piece.at("from"), piece.at("to"), piece.at("height"), piece.at("depth")});
  }

  double GetHeight(double x, double) const override {
    const Piece* piece = at(x);
    if (!piece) return 0.0;
    const double s = shape(*piece, x);
    return piece->height - piece->depth * (1.0 - s * s);
  }

 private:
  struct Piece {
    double from, to, height, depth;  // [m]; height at the borders, depth of the middle under them
  };

  const Piece* at(double x) const {
    for (const Piece& piece : pieces_)
      if (piece.from <= x && x < piece.to) return &piece;
    return nullptr;
  }

  /// -1 at one border, 1 at the other.
  static double shape(const Piece& piece, double x) {
    return (2.0 * x - piece.from - piece.to) / (piece.to - piece.from);
  }

  double GetHeightDerivWrtX(double x, double) const override {
    const Piece* piece = at(x);
    return piece ? piece->depth * 4.0 * shape(*piece, x) / (piece->to - piece->from) : 0.0;
  }

  double GetHeightDerivWrtXX(double x, double) const override {
    const Piece* piece = at(x);
    return piece ? piece->depth * 8.0 / ((piece->to - piece->from) * (piece->to - piece->from)) : 0.0;
  }

  std::vector<Piece> pieces_;
};

class Kinematics : public towr::KinematicModel {
 public:
  Kinematics(const json& feet, const Vector3d& deviation) : KinematicModel(static_cast<int>(feet.size())) {
    for (size_t e = 0; e < feet.size(); ++e) nominal_stance_.at(e) = vector_of(feet[e].at("nominal"));
    max_dev_from_nominal_ = deviation;
  }
};

class Dynamics : public towr::SingleRigidBodyDynamics {
 public:
  Dynamics(double mass, const Vector3d& inertia, int feet)
      : SingleRigidBodyDynamics(mass, inertia.x(), inertia.y(), inertia.z(), 0.0, 0.0, 0.0, feet) {}
};

towr::NlpFormulation formulate(const json& problem) {
  towr::NlpFormulation formulation;
  const json& feet = problem.at("feet");
  formulation.terrain_ = std::make_shared<Profile>(problem.at("terrain"), problem.at("friction"));
  formulation.model_.kinematic_model_ = std::make_shared<Kinematics>(feet, vector_of(problem.at("deviation")));
  formulation.model_.dynamic_model_ =
      std::make_shared<Dynamics>(problem.at("mass"), vector_of(problem.at("inertia")), static_cast<int>(feet.size()));
  formulation.initial_base_.lin.at(towr::kPos) = vector_of(problem.at("start"));
  formulation.final_base_.lin.at(towr::kPos) = vector_of(problem.at("goal"));
  for (const json& foot : feet) {
    formulation.initial_ee_W_.push_back(vector_of(foot.at("start")));
    formulation.params_.ee_phase_durations_.push_back(foot.at("durations").get<std::vector<double>>());
    formulation.params_.ee_in_contact_at_start_.push_back(true);
  }
  formulation.params_.force_limit_in_normal_direction_ = problem.at("max_force");
  if (problem.at("free_timing")) {
    formulation.params_.bound_phase_duration_ = {problem.at("shortest_s"), problem.at("longest_s")};
    formulation.params_.OptimizePhaseDurations();
  }
  return formulation;
}

void write(std::ostream& out, const Vector3d& v) { out << ',' << v.x() << ',' << v.y() << ',' << v.z(); }

/// A row a millisecond: time, base position, acceleration, angles, angular momentum, then of each foot contact,
/// position, force.
void sample(const towr::SplineHolder& solution, const json& problem, std::ostream& out) {
  const towr::EulerConverter angles(solution.base_angular_);
  const Vector3d inertia = vector_of(problem.at("inertia"));
  const double duration = solution.base_linear_->GetTotalTime();
  out.precision(12);
  for (double t = 0.0; t <= duration; t += 1e-3) {
    const towr::State base = solution.base_linear_->GetPoint(t);
    const Eigen::Matrix3d rotation = Eigen::Matrix3d(angles.GetRotationMatrixBaseToWorld(t));
    out << t;
    write(out, base.p());
    write(out, base.a());
    write(out, solution.base_angular_->GetPoint(t).p());
    write(out, rotation * inertia.asDiagonal() * rotation.transpose() * angles.GetAngularVelocityInWorld(t));
    for (size_t e = 0; e < solution.ee_motion_.size(); ++e) {
      out << ',' << (solution.phase_durations_.at(e)->IsContactPhase(t) ? 1 : 0);
      write(out, solution.ee_motion_.at(e)->GetPoint(t).p());
      write(out, solution.ee_force_.at(e)->GetPoint(t).p());
    }
    out << '\n';
  }
}

int run(const std::string& problem_path, const std::string& samples_path, const std::string& report_path) {
  const json problem = json::parse(std::ifstream(problem_path));
  const auto began = std::chrono::steady_clock::now();
  const std::clock_t cpu = std::clock();
  towr::NlpFormulation formulation = formulate(problem);
  ifopt::Problem nlp;
  towr::SplineHolder solution;
  for (const auto& part : formulation.GetVariableSets(solution)) nlp.AddVariableSet(part);
  for (const auto& part : formulation.GetConstraints(solution)) nlp.AddConstraintSet(part);
  for (const auto& part : formulation.GetCosts()) nlp.AddCostSet(part);
  ifopt::IpoptSolver solver;
  solver.SetOption("linear_solver", "mumps");
  solver.SetOption("jacobian_approximation", "exact");
  solver.SetOption("max_cpu_time", problem.at("time_limit_s").get<double>());
  solver.SetOption("print_level", 0);
  solver.Solve(nlp);
  const double cpu_s = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
  const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  std::ofstream samples(samples_path);
  sample(solution, problem, samples);
  std::ofstream report(report_path);
  report << json{{"status", solver.GetReturnStatus()},
                 {"iterations", nlp.GetIterationCount()},
                 {"variables", nlp.GetNumberOfOptimizationVariables()},
                 {"constraints", nlp.GetNumberOfConstraints()},
                 {"cpu_s", cpu_s},
                 {"wall_s", wall_s}}
                .dump()
         << '\n';
  return samples.good() && report.good() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: towr_peer problem.json samples.csv report.json\n");
    return 2;
  }
  try {
    return run(argv[1], argv[2], argv[3]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}
