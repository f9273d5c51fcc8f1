#include <doctest/doctest.h>

#include <cmath>

#include "planar/sip/constraints.hpp"
#include "planar/sip/interval.hpp"

using namespace mcplan::sip;
using mcplan::PlanarTask;

namespace {

Options with(ContactMode mode, FreeFlyer free_flyer = FreeFlyer::computed) {
  Options options;
  options.contact = mode;
  options.free_flyer = free_flyer;
  options.tube_m = 4e-3;
  options.tube_rad = 0.02;
  options.neq = 1;
  return options;
}

std::vector<Limited> rows_of(IntervalAt& interval) {
  std::vector<Limited> out;
  hold_contacts(interval.motion, out);
  interval.evaluate();
  return out;
}

}  // namespace

TEST_CASE("the tube holds the exact error of every contact, less the solver's tolerance") {
  const PlanarTask task = planar_tasks::climbing();
  const Options options = with(ContactMode::tube);
  for (int k : {0, 5, 8, 33}) {
    Eigen::VectorXd x = random_parameters(task, options, 3);
    x.head(Layout(task, options).first_duration) *= 0.3;
    IntervalAt interval(task, options, k, x);
    const std::vector<Limited> rows = rows_of(interval);
    const auto& contacts = task.phases[task.phase_of(k)].contacts;
    REQUIRE(rows.size() == 3 * contacts.size());
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const double tube = r % 3 == 2 ? options.tube_rad : options.tube_m;
      CHECK(rows[r].name == (r % 3 == 2 ? "drift_angle of " : "drift of ") +
                                task.robot.end_effectors[contacts[r / 3].end_effector].name);
      CHECK(rows[r].when == Limited::When::always);
      CHECK(rows[r].lower == -rows[r].upper);
      // Rows within the solver's tolerance are within the tube, and the tube is used but for a thousandth.
      CHECK(rows[r].upper + options.constraint_tolerance / rows[r].scale <= tube * (1.0 + 1e-12));
      CHECK(rows[r].upper >= 0.999 * tube);
      for (double s : kPlaces)
        CHECK(std::abs(interval.at(rows[r].node, s) - interval.exact(s).contact_error[r / 3][r % 3]) < 1e-6);
    }
  }
}

TEST_CASE("rows of narrow tubes are scaled to the size of those of wide ones") {
  const PlanarTask task = planar_tasks::cartwheel();
  Options narrow = with(ContactMode::tube), wide = narrow;
  narrow.tube_m = 1e-4;
  wide.tube_m = 1e-2;
  IntervalAt a(task, narrow, 0, random_parameters(task, narrow, 1));
  IntervalAt b(task, wide, 0, random_parameters(task, wide, 1));
  const Limited of_narrow = rows_of(a)[0], of_wide = rows_of(b)[0];
  CHECK(of_narrow.scale * of_narrow.upper == doctest::Approx(of_wide.scale * of_wide.upper));
}

TEST_CASE("the band holds coefficients, the strict form makes them zero and leaves the last contact out") {
  const PlanarTask task = planar_tasks::climbing();
  for (ContactMode mode : {ContactMode::band, ContactMode::strict})
    for (FreeFlyer free_flyer : {FreeFlyer::computed, FreeFlyer::parameterised}) {
      const Options options = with(mode, free_flyer);
      IntervalAt interval(task, options, 0, random_parameters(task, options, 4));
      const std::vector<Limited> rows = rows_of(interval);
      // The errors of all contacts of a computed base add to zero: the last one's rows follow from the others'.
      const bool left_out = mode == ContactMode::strict && free_flyer == FreeFlyer::computed;
      REQUIRE(rows.size() == (left_out ? 6 : 9));
      for (const Limited& row : rows) {
        CHECK(row.when == Limited::When::coefficients);
        CHECK(row.highest == options.neq);
        if (mode == ContactMode::strict) {
          CHECK(row.lower == 0.0);
          CHECK(row.upper == 0.0);
        } else {
          CHECK(row.lower < 0.0);
          CHECK(row.upper > 0.0);
        }
      }
    }
}

TEST_CASE("errors of a computed base add to zero") {
  const PlanarTask task = planar_tasks::climbing();
  const Options options = with(ContactMode::tube);
  IntervalAt interval(task, options, 0, random_parameters(task, options, 5));
  const std::vector<Limited> rows = rows_of(interval);
  for (int component = 0; component < 3; ++component)
    for (double s : kPlaces) {
      double sum = 0.0;
      for (int contact = 0; contact < 3; ++contact) sum += interval.at(rows[3 * contact + component].node, s);
      CHECK(std::abs(sum) < 1e-12);
    }
}

TEST_CASE("a contact alone is held by a base of its own, and needs no rows where the base follows from it") {
  const PlanarTask task = planar_tasks::walking();
  for (FreeFlyer free_flyer : {FreeFlyer::computed, FreeFlyer::parameterised}) {
    const Options options = with(ContactMode::tube, free_flyer);
    IntervalAt interval(task, options, 4, random_parameters(task, options, 6));
    CHECK(rows_of(interval).size() == (free_flyer == FreeFlyer::computed ? 0 : 3));
  }
}
