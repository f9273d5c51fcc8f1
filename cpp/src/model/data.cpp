#include "mcplan/model/data.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>

#include "find.hpp"
#include "text.hpp"

namespace mcplan {
namespace {

namespace fs = std::filesystem;

std::string& told_folder() {
  static std::string folder;
  return folder;
}

/// Whether the built-in scenes lie in a folder.
bool has_data(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder / "scenes", ignored);
}

}  // namespace

bool tell_data_folder(const char* folder) {
  told_folder() = folder;
  return true;
}

fs::path data_folder() {
  if (const char* const set = std::getenv("MCPLAN_DATA"); set && *set) return set;
  Dl_info about{};
  if (dladdr(reinterpret_cast<const void*>(&data_folder), &about) && about.dli_fname) {
    std::error_code ignored;
    const fs::path beside = fs::absolute(about.dli_fname, ignored).parent_path();
    for (const char* const candidate : {"data", "../share/mcplan", "../../share/mcplan"})
      if (has_data(beside / candidate)) return beside / candidate;
  }
  if (!told_folder().empty() && has_data(told_folder())) return told_folder();
  return {};
}

std::vector<std::string> built_in(const std::string& kind) {
  std::vector<std::string> names;
  const fs::path folder = data_folder();
  std::error_code failed;
  if (!folder.empty())
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / kind, failed))
      if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

namespace model {

bool is_there(const std::string& path) {
  std::error_code failed;
  return !path.empty() && path.find('\0') == path.npos && fs::exists(path, failed) && !failed;
}

fs::path find(const std::string& source, const std::string& kind, const std::string& word, Unknown unknown) {
  if (source.find_first_of(std::string("/\0", 2)) == source.npos && !source.empty()) {
    const fs::path inside = data_folder() / kind / (source + ".toml");
    if (is_there(inside.string()) && !data_folder().empty()) return inside;
  }
  if (is_there(source)) return source;
  const std::vector<std::string> legal = built_in(kind);
  std::string hint = did_you_mean(source, legal);
  if (kind == "robots") {
    const std::vector<std::string> planar = built_in("planar_robots");
    if (std::find(planar.begin(), planar.end(), source) != planar.end())
      hint = source + " is a planar robot: it comes with its planar tasks, for mcplan sip. ";
  }
  const std::string what = source.empty() ? "a " + word + " must have a name or a path that is not empty. "
                                          : "no " + word + " " + quote(source) + " and no file of that name. " + hint;
  unknown(what + "Built-in: " + joined(legal), source, legal);
  return {};
}

}  // namespace model
}  // namespace mcplan
