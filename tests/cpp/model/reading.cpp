#include "model/reading.hpp"

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "mcplan/base/error.hpp"

using namespace mcplan;
namespace fs = std::filesystem;

namespace {

/// A folder of its own, removed at the end.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("mcplan_reading_" + std::to_string(getpid()));
  Folder() { fs::create_directories(path / "inner"); }
  ~Folder() { fs::remove_all(path); }
};

std::string error_of(const std::string& path, std::size_t max_bytes = 1000) {
  try {
    model::read_file(path, max_bytes, "", path);
  } catch (const InvalidInput& found) {
    return found.rule();
  }
  return "";
}

}  // namespace

TEST_CASE("regular files of a bounded size alone are read") {
  const Folder folder;
  const std::string file = (folder.path / "a").string();
  std::ofstream(file) << std::string(1000, 'x');
  CHECK(model::read_file(file, 1000, "", file) == std::string(1000, 'x'));
  CHECK(error_of(file, 999) == "may have 0 KiB at most");
  fs::resize_file(file, 1'000'000'000'000);  // a hole: it takes no place on the disk
  CHECK(error_of(file, 2 * model::mib) == "may have 2 MiB at most");
  CHECK(error_of((folder.path / "none").string()) == "cannot be read: No such file or directory");
  CHECK(error_of(folder.path.string()) == "cannot be read: Is a directory");
  CHECK(error_of("/dev/zero") == "must be a regular file");
  CHECK(error_of("/proc/kallsyms", 1024) == "may have 1 KiB at most");  // says nothing of its size
  CHECK(error_of(std::string("a\0b", 3)) == "cannot be read: no name that a file can have");
  const std::string pipe = (folder.path / "pipe").string();
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(error_of(pipe) == "must be a regular file");  // and does not wait for a writer
}

TEST_CASE("a file names others beside it or below alone") {
  const Folder folder;
  const fs::path inner = folder.path / "inner";
  fs::create_symlink(folder.path / "outside", inner / "link");
  fs::create_symlink(inner / "loop", inner / "loop");
  CHECK(model::referenced(inner, "x.json", "file", "") == fs::weakly_canonical(inner / "x.json"));
  CHECK(model::referenced(inner, "../inner/x.json", "file", "") == fs::weakly_canonical(inner / "x.json"));
  CHECK(model::referenced("", "x.json", "file", "") == fs::weakly_canonical(fs::current_path() / "x.json"));
  for (const char* name : {"../x.json", "/etc/passwd", "link", "loop", "sub/../../x"}) {
    CAPTURE(name);
    CHECK_THROWS_AS(model::referenced(inner, name, "file", ""), InvalidInput);
  }
}
