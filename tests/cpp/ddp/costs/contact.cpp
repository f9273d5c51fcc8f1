#include "check_rows.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

enum { before, after, right_pad, left_pad, slope };

Writer contact_of(const ddp::Problem& problem, int l, int surface) {
  return [&problem, l, surface](const VectorXd& x, const VectorXd& u, Rows& rows) {
    contact_cost(problem, x, u.size() ? &u : nullptr, l, surface, 3.0, rows);
  };
}

}  // namespace

TEST_CASE("contact and free: gradients") {
  for (ddp::Model model : kModels) {
    const ddp::Problem problem = workshop(phases(6, model));
    for (int surface : {before, slope, right_pad}) check_rows(problem, contact_of(problem, 1, surface), 46, 0.8, 40);
    check_rows(
        problem, [&](const VectorXd&, const VectorXd& u, Rows& rows) { free_cost(problem, u, 1, 3.0, rows); }, 47, 0.5,
        10);
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

TEST_CASE("free: no stiffness and no moment of this end-effector, whatever the others do") {
  for (ddp::Model model : kModels) {
    const ddp::Problem problem = workshop(phases(6, model));
    const ddp::Layout& at = problem.layout;
    VectorXd u = VectorXd::Ones(at.nu());
    Rows rows(at.nz(), true);
    free_cost(problem, u, 1, 3.0, rows);
    CHECK(rows.cost() == doctest::Approx(0.5 * 9.0 * 4));  // one stiffness, three moments
    u[at.stiffness(1)] = 0.0;
    for (int i = 0; i < at.moment_count(); ++i)
      if (at.moments()[i].end_effector == 1) u[at.moment(i)] = 0.0;
    rows.clear();
    free_cost(problem, u, 1, 3.0, rows);
    CHECK(rows.cost() == 0.0);
  }
}

TEST_CASE("a free end-effector is kept out of the solids, at their outline and down to twice their thickness") {
  const ddp::Problem problem = workshop();
  const ddp::Layout& at = problem.layout;
  const Writer keep_out = [&](const VectorXd& x, const VectorXd&, Rows& rows) {
    keep_out_cost(problem, x, 1, 3.0, rows);
  };
  check_rows(problem, keep_out, 52, 0.3, 10);
  const auto price = [&](const Vector3d& position_W) {
    VectorXd x = VectorXd::Zero(at.nx());
    x.segment<3>(at.end(1)) = position_W / 0.7;
    return cost(problem, keep_out, x, VectorXd()) / (0.5 * 3.0 * 3.0);
  };
  CHECK(price({0.0, 0.0, 0.01}) == 0.0);
  CHECK(price({0.0, 0.0, -0.07}) == doctest::Approx(0.01));
  CHECK(price({0.0, 0.0, -0.11}) == 0.0);                    // below the solid
  CHECK(price({0.9, 0.0, -0.07}) == 0.0);                    // in the gap
  CHECK(price({0.9, -0.4, 0.43}) == doctest::Approx(0.01));  // a foot in a pad
}

TEST_CASE("a contact change costs a constant per end-effector, except in the paper's form") {
  ddp::Options options = phases(6);
  options.weights.contact_change = 3.0;
  const ddp::Problem ours = workshop(options);
  CHECK(contact_change_cost(ours, {0, 0, -1, -1}, {0, 0, -1, -1}) == 0.0);
  CHECK(contact_change_cost(ours, {0, 0, -1, -1}, {0, -1, 2, -1}) == 9.0);
  CHECK(contact_change_cost(ours, {{0, 0, -1, -1}, {0, -1, -1, -1}, {0, 1, -1, -1}}) == 9.0);
  options.method = ddp::Method::paper;
  CHECK(contact_change_cost(workshop(options), {0, 0, -1, -1}, {0, -1, 2, -1}) == 0.0);
}

TEST_CASE("flight costs a constant, except in the paper's form") {
  ddp::Options options = phases(6);
  options.weights.flight = 3.0;
  const ddp::Problem ours = workshop(options);
  CHECK(flight_cost(ours, {-1, -1, -1, -1}) == 4.5);
  CHECK(flight_cost(ours, {-1, -1, -1, left_pad}) == 0.0);
  options.method = ddp::Method::paper;
  CHECK(flight_cost(workshop(options), {-1, -1, -1, -1}) == 0.0);
}
