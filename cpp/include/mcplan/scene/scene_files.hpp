#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mcplan/base/suspicion.hpp"
#include "mcplan/model/data.hpp"  // which tells where the built-in scenes lie
#include "mcplan/scene/scene.hpp"

namespace mcplan {

/// The scene of a built-in name ("stairs_broad"; built_in("scenes") lists them) or of a TOML file; a built-in name
/// means the built-in scene. Throws UnknownScene, which lists the names that exist, and InvalidScene with all that is
/// wrong.
Scene load_scene(const std::string& name_or_path);

/// The scene of a TOML file. Throws InvalidScene.
Scene read_scene(const std::filesystem::path& file);

/// Throws InvalidScene where a scene is not valid, or its start or goal hangs in the air, lies under its ground, or
/// lies far beside all surfaces that it names. load_scene() asks for it, too.
void require_ground(const Scene& scene);

/// What of a scene can hardly be meant: lengths that look like millimetres, ground that faces down, a gravity that
/// contradicts the lengths. Loading says nothing of it. Throws InvalidScene.
std::vector<Suspicion> suspicious_geometry(const Scene& scene);

/// Writes a TOML file, which is complete or not there at all. Throws InvalidScene, std::filesystem::filesystem_error.
void save_scene(const Scene& scene, const std::filesystem::path& file);

/// Whether two scenes are the same, number by number.
bool operator==(const Scene& a, const Scene& b);
inline bool operator!=(const Scene& a, const Scene& b) { return !(a == b); }

}  // namespace mcplan
