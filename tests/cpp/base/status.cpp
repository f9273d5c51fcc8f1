#include "mcplan/base/status.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>

using mcplan::Status;

TEST_CASE("every status has a name of its own that leads back to it") {
  std::set<std::string> names;
  for (int i = static_cast<int>(Status::solved); i <= static_cast<int>(Status::numerical_failure); ++i) {
    const auto status = static_cast<Status>(i);
    const std::string name(mcplan::to_string(status));
    CHECK(name != "unknown");
    CHECK(names.insert(name).second);
    REQUIRE(mcplan::status_from_string(name).has_value());
    CHECK(*mcplan::status_from_string(name) == status);
  }
  CHECK(names.size() == 8);
}

TEST_CASE("a name that does not exist is no status") {
  for (const char* name : {"", "Solved", "solved ", "unknown"})
    CHECK_FALSE(mcplan::status_from_string(name).has_value());
}
