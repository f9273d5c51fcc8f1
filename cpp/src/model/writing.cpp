#include "writing.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <random>
#include <system_error>

namespace mcplan::model {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, int code) {
  throw fs::filesystem_error("cannot be written", file, std::error_code(code, std::generic_category()));
}

/// Writes all of a text to an open file and closes it; 0, or what went wrong.
int pour(int handle, const std::string& content) {
  if (handle < 0) return errno;
  std::size_t done = 0;
  int wrong = 0;
  while (done < content.size() && wrong == 0) {
    const ssize_t count = write(handle, content.data() + done, content.size() - done);
    if (count >= 0)
      done += static_cast<std::size_t>(count);
    else if (errno != EINTR)
      wrong = errno;
  }
  if (close(handle) != 0 && wrong == 0) wrong = errno;
  return wrong;
}

std::string random_name() {
  std::random_device source;
  return std::to_string(source()) + std::to_string(source());
}

/// Whether what goes by the name of a link such as /dev/stdout would be cut off by a rename.
bool is_special(const fs::path& file, const struct stat& about) {
  const std::string name = fs::absolute(file).lexically_normal().string();
  return !S_ISREG(about.st_mode) || name.rfind("/dev/std", 0) == 0 || name.rfind("/dev/fd/", 0) == 0 ||
         name.rfind("/proc/", 0) == 0;
}

}  // namespace

void write_whole(const std::string& content, const fs::path& file) {
  if (file.empty() || file.native().find('\0') != std::string::npos) fail(file, ENOENT);
  struct stat about {};
  const bool there = stat(file.c_str(), &about) == 0;
  if (!there && errno != ENOENT) fail(file, errno);
  if (there && S_ISDIR(about.st_mode)) fail(file, EISDIR);
  if (there && is_special(file, about)) {
    // Opened for writing alone and not cut: a device has no length.
    if (const int wrong = pour(open(file.c_str(), O_WRONLY | O_CLOEXEC), content)) fail(file, wrong);
    return;
  }
  if (there && access(file.c_str(), W_OK) != 0) fail(file, errno);
  std::error_code failed;
  const fs::path target = fs::weakly_canonical(fs::absolute(file), failed);
  if (failed) fail(file, failed.value());
  const fs::path beside =
      target.parent_path() / ("." + target.stem().string().substr(0, 40) + "." + random_name() + ".part");
  int wrong = pour(open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666), content);
  if (wrong == 0 && there && chmod(beside.c_str(), about.st_mode & 07777) != 0) wrong = errno;
  if (wrong == 0 && std::rename(beside.c_str(), target.c_str()) != 0) wrong = errno;
  if (wrong == 0) return;
  unlink(beside.c_str());
  fail(file, wrong);
}

}  // namespace mcplan::model
