#include "check_rows.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

enum { before, after, right_pad, left_pad, slope };

Writer contact_of(const ddp::Problem& problem, int l, int surface) { return term(problem, "contact", {2, l, surface}); }

}  // namespace

TEST_CASE("contact: gradients") {
  for (ddp::Model model : kModels) {
    const ddp::Problem problem = workshop(phases(6, model));
    for (int surface : {before, slope, right_pad}) check_rows(problem, contact_of(problem, 1, surface), 46, 0.8, 40);
  }
}

TEST_CASE("contact: height off the plane, way beyond every edge, and motion") {
  ddp::Options options = phases(6);
  for (ddp::Method method : {ddp::Method::standard, ddp::Method::paper}) {
    options.method = method;
    const ddp::Problem problem = workshop(options);
    const ddp::Layout& at = problem.layout;
    const bool paper = method == ddp::Method::paper;
    const double margin = paper ? 0.0 : 0.002 / 0.7, factor = paper ? 1.0 : options.weights.overshoot_factor;
    const auto price = [&](const Vector3d& position_W, bool last, double stride = 0.0) {
      VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(last ? 0 : at.nu());
      x.segment<3>(at.end(2)) = position_W / 0.7;
      if (!last) u[at.stride(2) + 1] = stride;
      return cost(problem, contact_of(problem, 2, right_pad), x, u) / (0.5 * 3.0 * 3.0);
    };
    const auto beyond = [&](double metres) { return std::pow(factor * (metres / 0.7 + margin), 2); };
    for (bool last : {false, true}) {
      CHECK(price({0.9, -0.4, 0.5}, last) == doctest::Approx(0.0).epsilon(1e-20));
      CHECK(price({0.9, -0.4, 0.64}, last) == doctest::Approx(0.04));
      CHECK(price({0.9, -0.4, 0.36}, last) == doctest::Approx(0.04));
      CHECK(price({0.98, -0.4, 0.5}, last) == doctest::Approx(beyond(0.03)));
      CHECK(price({0.98, -0.55, 0.5}, last) == doctest::Approx(beyond(0.03) + beyond(0.05)));
    }
    CHECK(price({0.9, -0.4, 0.5}, false, 0.2) == doctest::Approx(0.04));
  }
}

TEST_CASE("contact: soles that are to lie inside are priced by their corner that hangs over") {
  ddp::Options options = phases(6);
  options.weights.overshoot_factor = 1.0;
  for (double share : {0.5, 1.0}) {
    options.sole_inside = share;
    const ddp::Problem problem = workshop(options);
    const ddp::Layout& at = problem.layout;
    const Eigen::Vector2d half = share * problem.robot.end_effectors[0].half_size;
    double ahead = 0.0;  // of the share of the sole, turned as at the start
    for (double side : {-1.0, 1.0}) ahead = std::max(ahead, std::cos(0.4) * half[0] + side * std::sin(0.4) * half[1]);
    const double edge = problem.scene.surfaces[before].vertices_W[1].x();
    const auto price = [&](double x_m) {
      VectorXd x = VectorXd::Zero(at.nx());
      x.segment<3>(at.end(0)) = Vector3d(x_m, 0.0, 0.0) / 0.7;
      return cost(problem, contact_of(problem, 0, before), x, VectorXd()) / (0.5 * 3.0 * 3.0);
    };
    CHECK(price(edge - ahead - 0.003) == 0.0);
    CHECK(price(edge - ahead + 0.01) == doctest::Approx(std::pow(0.012 / 0.7, 2)));
    CHECK(price(edge) == doctest::Approx(std::pow((ahead + 0.002) / 0.7, 2)));
    check_rows(problem, contact_of(problem, 1, slope), 48, 0.8, 40);
  }
}

TEST_CASE("contact: on a surface too small for the sole its place is near the middle") {
  ddp::Options options = phases(6);
  options.sole_inside = 2.0;
  const ddp::Problem problem = workshop(options);
  const ddp::Layout& at = problem.layout;
  const Vector3d middle = problem.polygons[right_pad].centroid_W();
  const auto price = [&](const Vector3d& offset) {
    VectorXd x = VectorXd::Zero(at.nx());
    x.segment<3>(at.end(0)) = middle + offset;
    return cost(problem, contact_of(problem, 0, right_pad), x, VectorXd());
  };
  for (double sign : {1.0, -1.0}) {  // the pad is 0.10 m by 0.25 m
    CHECK(price(Vector3d(sign * 0.01, sign * 0.03, 0.0) / 0.7) == 0.0);
    CHECK(price(Vector3d(sign * 0.02, 0.0, 0.0) / 0.7) > 0.0);
    CHECK(price(Vector3d(0.0, sign * 0.04, 0.0) / 0.7) > 0.0);
  }
}

TEST_CASE("contact: after a caught edge the soles of feet, not the points of hands, stand further inside") {
  const ddp::Problem problem = workshop();
  const ddp::Layout& at = problem.layout;
  const ddp::Pendulum pendulum(at, problem.inertia, problem.options.stiffness_input, problem.model);
  const int index = ddp::cost_term_index("contact");
  const ddp::Instants none;
  const auto overstepped = [&](int l, int surface, double extra_margin) {
    ddp::Schedule schedule;
    schedule.tuning.extra_margin = extra_margin;
    VectorXd x = VectorXd::Zero(at.nx());
    const Vector3d edge = problem.scene.surfaces[surface].vertices_W[1] / 0.7;
    x.segment<3>(at.end(l)) = edge + Vector3d(-0.01, l == 2 ? 0.1 : 1.0, 0.0);
    Rows rows(at.nz(), false);
    const ddp::StepView step{problem, pendulum, schedule, 2, x, nullptr, none, l, surface};
    rows.begin(index);
    ddp::cost_terms()[static_cast<std::size_t>(index)]->write(step, rows);
    return rows.cost() > 0.0;
  };
  CHECK_FALSE(overstepped(0, before, 0.0));
  CHECK(overstepped(0, before, 0.05));
  CHECK_FALSE(overstepped(2, right_pad, 0.0));
  CHECK_FALSE(overstepped(2, right_pad, 0.05));
}
