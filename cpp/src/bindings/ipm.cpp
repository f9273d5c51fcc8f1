#include <pybind11/functional.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>

#include "callbacks.hpp"
#include "mcplan/ipm/solver.hpp"
#include "mcplan/nlp/derivative_check.hpp"
#include "signals.hpp"

namespace mcplan::bindings {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMaxStage = 1000000;     // the kernel keeps a list a stage
constexpr std::size_t kMaxWorst = 10;  // violations that a solution tells

/// A solve as Python sees it.
struct Solved {
  nlp::Solution solution;
  VectorXd bound_multipliers;                              ///< NaN unless it converged
  std::vector<std::pair<std::string, double>> violations;  ///< beyond the tolerance, worst first
  std::string table;                                       ///< of the iterations
};

/// What Python has gathered of a stage problem: a Problem is made of it for each solve, since one serves one thread.
class Program {
 public:
  int add_variables(const std::string& name, VectorXd lower, VectorXd upper, VectorXd start, int first, int last);
  void add_linear(const std::string& name, std::vector<int> variables, MatrixXd A, VectorXd lower, VectorXd upper);
  void add_quadratic(const std::string& name, std::vector<int> variables, const MatrixXd& H, VectorXd g, double c);
  void add_function(const std::string& name, std::vector<int> variables, std::vector<int> sizes, py::function value,
                    py::function jacobian, py::object hessian, VectorXd lower, VectorXd upper);
  void add_cost(const std::string& name, std::vector<int> variables, std::vector<int> sizes, py::function value,
                py::function jacobian, py::object hessian);
  void add_least_squares(const std::string& name, std::vector<int> variables, std::vector<int> sizes,
                         py::function value, py::function jacobian, py::object hessian, VectorXd weights);

  Solved solve(nlp::Solver solver, nlp::SolverOptions options, const std::function<void(std::string)>& log) const;
  std::vector<nlp::WrongDerivative> check_derivatives(const VectorXd& x, double tolerance) const;

 private:
  struct Group {
    std::string name;
    VectorXd lower, upper;
    nlp::Stages stages;
  };
  enum class Kind { linear, quadratic, constraint, cost, least_squares };
  struct Block {
    Kind kind = Kind::linear;
    std::string name;
    std::vector<int> variables;
    VectorXd lower, upper;                       ///< limits of the rows of a constraint
    MatrixXd matrix;                             ///< A or H
    VectorXd vector;                             ///< g, or weights
    double constant = 0.0;                       ///< c
    std::shared_ptr<const Callbacks> callbacks;  ///< null for arrays
  };

  void require_variables(const std::string& name, const std::vector<int>& variables) const;
  std::string where(const std::string& name, const std::vector<int>& variables) const;
  std::shared_ptr<const Callbacks> callbacks(const std::string& name, const std::vector<int>& variables,
                                             std::vector<int> sizes, py::function value, py::function jacobian,
                                             py::object hessian, int rows) const;
  nlp::Problem with_variables() const;
  nlp::Problem problem(const std::shared_ptr<const bool>& ready) const;
  Solved judged(const nlp::Problem& problem, nlp::Solution solution, double tolerance) const;

  std::vector<Group> groups_;
  std::vector<nlp::Stages> stages_;  ///< of each variable
  std::vector<double> start_;
  std::vector<Block> blocks_;
};

void require_size(const std::string& field, Eigen::Index size, Eigen::Index found) {
  if (size != found) throw InvalidInput(field, "must have " + std::to_string(size) + " values", std::to_string(found));
}

void require_limits(const std::string& name, const VectorXd& lower, const VectorXd& upper) {
  if (lower.size() == 0) throw InvalidInput(name, "must have a row at least", "none");
  require_size(name + ": upper", lower.size(), upper.size());
  if (lower.hasNaN()) throw InvalidInput(name + ": lower", "must be numbers", text(lower));
  if (upper.hasNaN()) throw InvalidInput(name + ": upper", "must be numbers", text(upper));
}

int Program::add_variables(const std::string& name, VectorXd lower, VectorXd upper, VectorXd start, int first,
                           int last) {
  require_limits(name, lower, upper);
  require_size(name + ": start", lower.size(), start.size());
  if (!start.allFinite()) throw InvalidInput(name + ": start", "must be finite", text(start));
  if (first < 0 || last < first || last > kMaxStage)
    throw InvalidInput(name + ": stage", "must be a stage in [0, " + text(kMaxStage) + "], or a first and a last one",
                       "(" + text(first) + ", " + text(last) + ")");
  const int at = static_cast<int>(stages_.size());
  stages_.insert(stages_.end(), lower.size(), {first, last});
  start_.insert(start_.end(), start.data(), start.data() + start.size());
  groups_.push_back({name, std::move(lower), std::move(upper), {first, last}});
  return at;
}

void Program::require_variables(const std::string& name, const std::vector<int>& variables) const {
  if (variables.empty()) throw InvalidInput(name + ": variables", "must be one at least", "none");
  const int count = static_cast<int>(stages_.size());
  for (int variable : variables)
    if (variable < 0 || variable >= count)
      throw InvalidInput(name + ": variables", "must lie in [0, " + text(count) + ")", text(variable));
  if (std::set<int>(variables.begin(), variables.end()).size() != variables.size())
    throw InvalidInput(name + ": variables", "must differ from each other", "one twice");
}

/// As nlp::Problem::piece_stages() counts.
std::string Program::where(const std::string& name, const std::vector<int>& variables) const {
  int stage = -1, lasting = 0;
  for (int variable : variables) {
    const nlp::Stages at = stages_[variable];
    lasting = std::max(lasting, at.first);
    if (at.first == at.last) stage = std::max(stage, at.last);
  }
  return name + " at stage " + std::to_string(stage < 0 ? lasting : stage);
}

void Program::add_linear(const std::string& name, std::vector<int> variables, MatrixXd A, VectorXd lower,
                         VectorXd upper) {
  require_variables(name, variables);
  require_limits(name, lower, upper);
  require_size(name + ": rows of the matrix", lower.size(), A.rows());
  require_size(name + ": columns of the matrix", static_cast<Eigen::Index>(variables.size()), A.cols());
  if (!A.allFinite()) throw InvalidInput(name + ": matrix", "must be finite", "");
  blocks_.push_back(
      {Kind::linear, name, std::move(variables), std::move(lower), std::move(upper), std::move(A), {}, 0.0, nullptr});
}

void Program::add_quadratic(const std::string& name, std::vector<int> variables, const MatrixXd& H, VectorXd g,
                            double c) {
  require_variables(name, variables);
  const auto size = static_cast<Eigen::Index>(variables.size());
  require_size(name + ": rows of the matrix", size, H.rows());
  require_size(name + ": columns of the matrix", size, H.cols());
  require_size(name + ": gradient", size, g.size());
  if (!H.allFinite()) throw InvalidInput(name + ": matrix", "must be finite", "");
  if (!g.allFinite()) throw InvalidInput(name + ": gradient", "must be finite", text(g));
  if (!std::isfinite(c)) throw InvalidInput(name + ": constant", "must be finite", text(c));
  const MatrixXd symmetric = 0.5 * H + 0.5 * H.transpose();  // v' H v is the same
  blocks_.push_back({Kind::quadratic, name, std::move(variables), {}, {}, symmetric, std::move(g), c, nullptr});
}

std::shared_ptr<const Callbacks> Program::callbacks(const std::string& name, const std::vector<int>& variables,
                                                    std::vector<int> sizes, py::function value, py::function jacobian,
                                                    py::object hessian, int rows) const {
  require_variables(name, variables);
  std::int64_t sum = 0;
  for (int size : sizes) {
    if (size < 1) throw InvalidInput(name + ": sizes", "must be positive", text(size));
    sum += size;
  }
  if (sum != static_cast<std::int64_t>(variables.size()))
    throw InvalidInput(name + ": sizes", "must add up to " + std::to_string(variables.size()), std::to_string(sum));
  if (!hessian.is_none() && !PyCallable_Check(hessian.ptr()))
    throw InvalidInput(name + ": hessian", "must be a function or None",
                       py::str(py::type::of(hessian).attr("__name__")));
  return std::make_shared<const Callbacks>(Callbacks{where(name, variables), std::move(sizes), rows, std::move(value),
                                                     std::move(jacobian), std::move(hessian)});
}

void Program::add_function(const std::string& name, std::vector<int> variables, std::vector<int> sizes,
                           py::function value, py::function jacobian, py::object hessian, VectorXd lower,
                           VectorXd upper) {
  require_limits(name, lower, upper);
  auto called = callbacks(name, variables, std::move(sizes), std::move(value), std::move(jacobian), std::move(hessian),
                          static_cast<int>(lower.size()));
  blocks_.push_back(
      {Kind::constraint, name, std::move(variables), std::move(lower), std::move(upper), {}, {}, 0.0, called});
}

void Program::add_cost(const std::string& name, std::vector<int> variables, std::vector<int> sizes, py::function value,
                       py::function jacobian, py::object hessian) {
  auto called =
      callbacks(name, variables, std::move(sizes), std::move(value), std::move(jacobian), std::move(hessian), 1);
  blocks_.push_back({Kind::cost, name, std::move(variables), {}, {}, {}, {}, 0.0, called});
}

void Program::add_least_squares(const std::string& name, std::vector<int> variables, std::vector<int> sizes,
                                py::function value, py::function jacobian, py::object hessian, VectorXd weights) {
  if (weights.size() == 0) throw InvalidInput(name + ": weights", "must be one at least", "none");
  if (!weights.allFinite() || weights.minCoeff() < 0.0)
    throw InvalidInput(name + ": weights", "must be finite and not negative", text(weights));
  auto called = callbacks(name, variables, std::move(sizes), std::move(value), std::move(jacobian), std::move(hessian),
                          static_cast<int>(weights.size()));
  blocks_.push_back({Kind::least_squares, name, std::move(variables), {}, {}, {}, std::move(weights), 0.0, called});
}

nlp::Problem Program::with_variables() const {
  if (groups_.empty()) throw InvalidInput("problem", "must have variables", "none");
  nlp::Problem out;
  for (const Group& group : groups_) {
    const int size = static_cast<int>(group.lower.size());
    const int first = out.add_variables(group.name, size, 0.0, 0.0, group.stages);
    for (int i = 0; i < size; ++i) out.set_bounds(first + i, group.lower[i], group.upper[i]);
  }
  return out;
}

nlp::Problem Program::problem(const std::shared_ptr<const bool>& ready) const {
  nlp::Problem out = with_variables();
  for (const Block& b : blocks_) {
    switch (b.kind) {
      case Kind::linear:
        out.add_constraint(std::make_unique<nlp::LinearPiece>(b.name, b.variables, b.matrix), b.lower, b.upper);
        break;
      case Kind::quadratic:
        out.add_cost(std::make_unique<QuadraticPiece>(b.name, b.variables, b.matrix, b.vector, b.constant));
        break;
      case Kind::constraint:
        out.add_constraint(std::make_unique<CallbackPiece>(b.name, b.variables, b.callbacks, ready), b.lower, b.upper);
        break;
      case Kind::cost:
        out.add_cost(std::make_unique<CallbackPiece>(b.name, b.variables, b.callbacks, ready));
        break;
      case Kind::least_squares:
        out.add_cost(std::make_unique<LeastSquaresPiece>(b.name, b.variables, b.callbacks, b.vector, ready));
        break;
    }
  }
  out.finish();
  return out;
}

double beyond(double value, double lower, double upper) {
  return std::isnan(value) ? nlp::kInfinity : std::max({lower - value, value - upper, 0.0});
}

/// The solution with the multipliers of its bounds, and with the rows that do not hold by name.
Solved Program::judged(const nlp::Problem& problem, nlp::Solution solution, double tolerance) const {
  Solved out;
  const VectorXd& x = solution.x;
  const bool converged =
      solution.outcome == nlp::Outcome::converged || solution.outcome == nlp::Outcome::nearly_converged;
  out.bound_multipliers = VectorXd::Constant(x.size(), std::numeric_limits<double>::quiet_NaN());
  if (converged && solution.multipliers.size() == problem.row_count()) {
    VectorXd dual(x.size()), jacobian(static_cast<Eigen::Index>(problem.jacobian_structure().size()));
    problem.gradient(x, dual);
    problem.jacobian(x, jacobian);
    for (Eigen::Index i = 0; i < jacobian.size(); ++i) {
      const nlp::Entry& entry = problem.jacobian_structure()[i];
      dual[entry.column] += jacobian[i] * solution.multipliers[entry.row];
    }
    out.bound_multipliers = -dual;
    for (Eigen::Index i = 0; i < x.size(); ++i)  // without a bound there is none: what is left is the tolerance's
      if (problem.variable_lower()[i] == -nlp::kInfinity && problem.variable_upper()[i] == nlp::kInfinity)
        out.bound_multipliers[i] = 0.0;
  }
  VectorXd rows(problem.row_count());
  const bool violated = !(solution.worst.value <= tolerance);  // else functions, which may be slow, are not asked again
  if (violated) problem.rows(x, rows);
  for (int i = 0; violated && i < problem.row_count(); ++i) {
    const double amount = beyond(rows[i], problem.row_lower()[i], problem.row_upper()[i]);
    if (amount > tolerance) out.violations.emplace_back(std::to_string(i), amount);
  }
  std::stable_sort(out.violations.begin(), out.violations.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  if (out.violations.size() > kMaxWorst) out.violations.resize(kMaxWorst);
  for (auto& [name, amount] : out.violations) name = problem.row_name(std::stoi(name));
  out.solution = std::move(solution);
  return out;
}

Solved Program::solve(nlp::Solver solver, nlp::SolverOptions options,
                      const std::function<void(std::string)>& log) const {
  options.validate();
  const auto ready = std::make_shared<bool>(false);
  const nlp::Problem built = problem(ready);  // made and destroyed under the GIL, as its callbacks must be
  *ready = true;
  const VectorXd x0 = Eigen::Map<const VectorXd>(start_.data(), static_cast<Eigen::Index>(start_.size()));
  std::string table;
  options.stop = SignalWatch::stop;
  options.logger = watched(Logger([&](LogLevel, const std::string& line) {
    table += line + "\n";
    if (log) log(line);
  }));
  return interruptible([&] {
    Solved out = judged(built, ipm::solve(solver, built, x0, options), options.constraint_tolerance);
    if (SignalWatch::stop()) out.solution.outcome = nlp::Outcome::interrupted;
    out.table = table;
    return out;
  });
}

/// Of callbacks alone: arrays are their own derivatives. Least squares are checked by their residuals, which tell more
/// than a sum of squares that is near zero.
std::vector<nlp::WrongDerivative> Program::check_derivatives(const VectorXd& x, double tolerance) const {
  const auto ready = std::make_shared<bool>(false);
  std::vector<nlp::WrongDerivative> out;
  for (const bool has_hessian : {true, false}) {
    nlp::Problem part = with_variables();
    for (const Block& b : blocks_)
      if (b.callbacks && b.callbacks->hessian.is_none() != has_hessian)
        part.add_constraint(std::make_unique<CallbackPiece>(b.callbacks->where, b.variables, b.callbacks, ready), 0.0,
                            0.0);
    *ready = false;
    part.finish();
    *ready = true;
    for (const nlp::WrongDerivative& wrong : nlp::check_derivatives(part, x, tolerance))
      if (has_hessian || wrong.kind == "jacobian") out.push_back(wrong);
  }
  return out;
}

void bind_program(py::module_& m) {
  py::class_<Program> c(
      m, "Program",
      "A stage problem as mcplan.ipm hands it over: variables by number, blocks by arrays and functions. "
      "Use mcplan.ipm.Problem.");
  c.def(py::init<>());
  c.def("add_variables", &Program::add_variables, py::arg("name"), py::arg("lower"), py::arg("upper"), py::arg("start"),
        py::arg("first_stage"), py::arg("last_stage"), "The number of the first one.");
  c.def("add_linear", &Program::add_linear, py::arg("name"), py::arg("variables"), py::arg("matrix"), py::arg("lower"),
        py::arg("upper"), "lower <= A v <= upper.");
  c.def("add_quadratic", &Program::add_quadratic, py::arg("name"), py::arg("variables"), py::arg("matrix"),
        py::arg("gradient"), py::arg("constant"), "The cost 1/2 v' H v + g' v + c.");
  c.def("add_function", &Program::add_function, py::arg("name"), py::arg("variables"), py::arg("sizes"),
        py::arg("value"), py::arg("jacobian"), py::arg("hessian"), py::arg("lower"), py::arg("upper"),
        "lower <= f(v) <= upper.");
  c.def("add_cost", &Program::add_cost, py::arg("name"), py::arg("variables"), py::arg("sizes"), py::arg("value"),
        py::arg("jacobian"), py::arg("hessian"), "The cost f(v), one number.");
  c.def("add_least_squares", &Program::add_least_squares, py::arg("name"), py::arg("variables"), py::arg("sizes"),
        py::arg("value"), py::arg("jacobian"), py::arg("hessian"), py::arg("weights"), "The cost 1/2 sum w r(v)^2.");
  c.def(
      "solve",
      [](const Program& self, nlp::Solver solver, double tolerance, double constraint_tolerance, int max_iterations,
         double time_limit_s, double initial_barrier, bool adaptive_barrier,
         const std::function<void(std::string)>& log) {
        nlp::SolverOptions options;
        options.tolerance = tolerance;
        options.constraint_tolerance = constraint_tolerance;
        options.max_iterations = max_iterations;
        options.time_limit_s = time_limit_s;
        options.initial_barrier = initial_barrier;
        options.adaptive_barrier = adaptive_barrier;
        const Program copy = self;  // a callback may add to it meanwhile
        return copy.solve(solver, options, log);
      },
      py::kw_only(), py::arg("solver"), py::arg("tolerance"), py::arg("constraint_tolerance"),
      py::arg("max_iterations"), py::arg("time_limit_s"), py::arg("initial_barrier"), py::arg("adaptive_barrier"),
      py::arg("log"), "Releases the GIL. `log` gets each line of the iteration table; None: nobody.");
  c.def(
      "check_derivatives",
      [](const Program& self, const VectorXd& x, double tolerance) {
        py::list out;
        const Program copy = self;
        for (const nlp::WrongDerivative& w : copy.check_derivatives(x, tolerance))
          out.append(py::make_tuple(w.piece, w.kind, w.row, w.first, w.second, w.given, w.difference));
        return out;
      },
      py::arg("x"), py::arg("tolerance"),
      "Block, kind, row, one or two variables, given and difference of each derivative that is wrong.");
}

void bind_solution(py::module_& m) {
  py::class_<Solved>(m, "Solution", "How a Program was solved; mcplan.ipm.Result has it by name.")
      .def_property_readonly("status", [](const Solved& s) { return nlp::status_of(s.solution.outcome); })
      .def_property_readonly("message", [](const Solved& s) { return s.solution.message; })
      .def_property_readonly("solver", [](const Solved& s) { return s.solution.solver; })
      .def_property_readonly("x", [](const Solved& s) { return VectorXd(s.solution.x); })
      .def_property_readonly("multipliers", [](const Solved& s) { return VectorXd(s.solution.multipliers); })
      .def_property_readonly("bound_multipliers", [](const Solved& s) { return VectorXd(s.bound_multipliers); })
      .def_property_readonly("objective", [](const Solved& s) { return s.solution.cost; })
      .def_property_readonly("iterations", [](const Solved& s) { return s.solution.iterations; })
      .def_property_readonly("violation", [](const Solved& s) { return s.solution.worst.value; })
      .def_property_readonly("worst", [](const Solved& s) { return s.solution.worst.name; })
      .def_property_readonly("violations", [](const Solved& s) { return s.violations; })
      .def_property_readonly("time_s", [](const Solved& s) { return s.solution.time_s; })
      .def_property_readonly("evaluation_s", [](const Solved& s) { return s.solution.evaluation_s; })
      .def_property_readonly("linear_solver_s", [](const Solved& s) { return s.solution.linear_solver_s; })
      .def_property_readonly("table", [](const Solved& s) { return s.table; });
}

}  // namespace

void bind_ipm(py::module_& parent) {
  py::module_ m = parent.def_submodule("ipm", "The interior-point kernel for problems of one's own.");
  bind_solution(m);
  bind_program(m);
}

}  // namespace mcplan::bindings
