#include "reading.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "mcplan/base/error.hpp"
#include "mcplan/model/data.hpp"
#include "text.hpp"

namespace mcplan::model {
namespace {

/// What messages say of one file.
struct Named {
  const std::string &path, &field, &source;

  std::string value() const { return field.empty() ? "" : shown(path); }
  InvalidInput error(const std::string& rule, const std::string& got) const { return {field, rule, got, source}; }
  InvalidInput cannot(int code) const {
    return error("cannot be read: " + std::generic_category().message(code), value());
  }
};

/// Closes what it holds.
struct Handle {
  int number;
  ~Handle() { close(number); }
};

const char* kind_text(mode_t mode) {
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "a device";
  return S_ISSOCK(mode) ? "a socket" : "none";
}

void require_regular(const struct stat& about, const Named& named) {
  if (S_ISDIR(about.st_mode)) throw named.error("cannot be read: Is a directory", named.value());
  if (!S_ISREG(about.st_mode)) throw named.error("must be a regular file", kind_text(about.st_mode));
}

/// Whether a path lies in a folder or below; both without links.
bool lies_in(const std::filesystem::path& path, const std::filesystem::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

std::string size_text(std::size_t bytes) {
  return bytes % mib == 0 ? std::to_string(bytes / mib) + " MiB" : std::to_string(bytes / kib) + " KiB";
}

std::string read_file(const std::string& path, std::size_t max_bytes, const std::string& field,
                      const std::string& source) {
  const Named named{path, field, source};
  const std::string limit = "may have " + size_text(max_bytes) + " at most";
  if (path.find('\0') != path.npos) throw named.error("cannot be read: no name that a file can have", named.value());
  struct stat about {};
  if (stat(path.c_str(), &about) != 0) throw named.cannot(errno);  // devices may act when they are but opened
  require_regular(about, named);
  // Neither waits for the other end of a pipe nor makes a terminal that of this process.
  const Handle handle{open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)};
  if (handle.number < 0 || fstat(handle.number, &about) != 0) throw named.cannot(errno);
  require_regular(about, named);
  if (static_cast<std::size_t>(about.st_size) > max_bytes)
    throw named.error(limit, std::to_string(about.st_size) + " bytes");
  std::string data;
  while (data.size() <= max_bytes) {
    const std::size_t begin = data.size(), expected = static_cast<std::size_t>(about.st_size);
    // Of the size that the file says it has, and a byte more to see its end; those of /proc say nothing.
    const std::size_t part = std::min(begin <= expected ? expected + 1 - begin : 64 * kib, max_bytes + 1 - begin);
    data.resize(begin + std::max<std::size_t>(part, 1));
    const ssize_t got = read(handle.number, data.data() + begin, data.size() - begin);
    if (got < 0 && errno != EINTR) throw named.cannot(errno);
    data.resize(begin + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got == 0) break;
  }
  if (data.size() > max_bytes) throw named.error(limit, "more");
  return data;
}

std::filesystem::path referenced(const std::filesystem::path& folder, const std::string& name, const std::string& field,
                                 const std::string& source) {
  const Named named{name, field, source};
  std::error_code failed, failed_root, ignored;
  const auto canonical = [](const std::filesystem::path& path, std::error_code& error) {
    const auto absolute = std::filesystem::absolute(path, error);
    return error ? absolute : std::filesystem::weakly_canonical(absolute, error);
  };
  const std::filesystem::path here = folder.empty() ? "." : folder;  // of a file named without one
  const auto path = canonical(here / name, failed), root = canonical(here, failed_root);
  // What is still a link points to nothing: where it would lead to, nobody has looked at.
  const bool dangles = std::filesystem::is_symlink(std::filesystem::symlink_status(path, ignored));
  if (failed || failed_root || dangles || name.find('\0') != name.npos)
    throw named.error("cannot be read: no name that a file can have", shown(name));
  const auto data = data_folder();
  const bool ours = !data.empty() && lies_in(root, std::filesystem::weakly_canonical(data, ignored));
  if (!lies_in(path, root) && !ours)
    throw named.error("must lie in the folder of the file that names it, or below", shown(name));
  return path;
}

}  // namespace mcplan::model
