#include "base/fork.hpp"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

TEST_CASE("a child knows that it was forked, its parent does not") {
  CHECK_FALSE(mcplan::forked());
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) _exit(mcplan::forked() ? 42 : 0);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 42);
  CHECK_FALSE(mcplan::forked());
}
