#include "check_rows.hpp"

namespace {

using namespace support;

}  // namespace

TEST_CASE("a contact change costs a constant per end-effector, except in the paper's form") {
  ddp::Options options = phases(6);
  options.weights.own["contact_change"] = 3.0;
  const ddp::Problem ours = workshop(options);
  CHECK(change_cost(ours, {0, 0, -1, -1}, {0, 0, -1, -1}) == 0.0);
  CHECK(change_cost(ours, {0, 0, -1, -1}, {0, -1, 2, -1}) == 9.0);
  CHECK(change_cost(ours, {{0, 0, -1, -1}, {0, -1, -1, -1}, {0, 1, -1, -1}}) == 9.0);
  options.weights.own.clear();  // which the paper's form refuses
  options.method = ddp::Method::paper;
  CHECK(change_cost(workshop(options), {0, 0, -1, -1}, {0, -1, 2, -1}) == 0.0);
}
