#include "check_rows.hpp"

namespace {

using namespace support;

}  // namespace

TEST_CASE("flight costs a constant, except in the paper's form") {
  ddp::Options options = phases(6);
  options.weights.own["flight"] = 3.0;
  const ddp::Problem ours = workshop(options);
  CHECK(state_cost(ours, {-1, -1, -1, -1}) == 4.5);
  CHECK(state_cost(ours, {-1, -1, -1, 3}) == 0.0);
  options.weights.own.clear();  // which the paper's form refuses
  options.method = ddp::Method::paper;
  CHECK(state_cost(workshop(options), {-1, -1, -1, -1}) == 0.0);
}
