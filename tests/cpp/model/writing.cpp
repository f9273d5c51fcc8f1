#include "model/writing.hpp"

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

using namespace mcplan;
namespace fs = std::filesystem;

namespace {

std::string content(const fs::path& file) {
  std::ostringstream out;
  out << std::ifstream(file).rdbuf();
  return out.str();
}

}  // namespace

TEST_CASE("a file is replaced as a whole, links and modes stay") {
  const fs::path folder = fs::temp_directory_path() / ("mcplan_writing_" + std::to_string(getpid()));
  fs::create_directories(folder);
  model::write_whole("old", folder / "a");
  chmod((folder / "a").c_str(), 0640);
  fs::create_symlink(folder / "a", folder / "link");
  model::write_whole("new", folder / "link");
  CHECK(content(folder / "a") == "new");
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(fs::status(folder / "a").permissions() == static_cast<fs::perms>(0640));
  CHECK(std::distance(fs::directory_iterator(folder), {}) == 2);  // nothing is left beside them
  model::write_whole("x", "/dev/null");
  CHECK(fs::is_character_file("/dev/null"));
  CHECK_THROWS_AS(model::write_whole("x", folder), fs::filesystem_error);
  CHECK_THROWS_AS(model::write_whole("x", folder / "none" / "a"), fs::filesystem_error);
  CHECK_THROWS_AS(model::write_whole("x", ""), fs::filesystem_error);
  fs::remove_all(folder);
}
