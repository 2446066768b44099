#include "apps/formats/mesh_file.h"

#include <algorithm>
#include <filesystem>

#include "apps/formats/mesh_session.h"
#include "apps/formats/other_formats.h"
#include "apps/frontend/line/small_letters.h"
#include "apps/frontend/line/words.h"
#include "apps/reader/budget.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace fs = std::filesystem;

namespace {

/// Some name the line, too.
std::string with_path(const std::string& path, const std::string& text) {
  return text.starts_with(path + ":") ? text : path + ": " + text;
}

}  // namespace

const std::vector<std::string>& mesh_extensions() {
  static const std::vector<std::string> extensions = {"obj", "ply", "stl", "off", "gltf", "glb", "pbrt", "pbrt.gz"};
  return extensions;
}

bool is_mesh_path(const std::string& path) {
  const std::string ending = ending_of(path);
  const auto& known = mesh_extensions();
  return std::find(known.begin(), known.end(), ending) != known.end() || has_own_sky(path) || is_other_format(path);
}

bool has_own_sky(const std::string& path) {
  return ending_of(path) == "pbrt" || (ending_of(path) == "gz" && ending_of(fs::path(path).stem()) == "pbrt");
}

bool is_played(const std::string& path) { return ending_of(path) == "gltf" || ending_of(path) == "glb"; }

std::string known_mesh_formats() { return joined(mesh_extensions(), ", "); }

MeshFile read_mesh_file(const std::string& path, const MeshOptions& options, bool shows_progress) {
  return read_mesh_file(path, options, shows_progress, ReaderLimits{});
}

MeshFile read_mesh_file(const std::string& path, const MeshOptions& options, bool shows_progress, const ReaderLimits& limits) {
  try {
    core::expect(!options.animation || is_played(path), "animations are asked for of glTF alone");
    if (is_other_format(path)) {
      throw core::InputError(how_to_convert(path));
    }
    return read_in_session(path, options, shows_progress, limits);
  } catch (const core::CapacityError& error) {
    throw core::CapacityError(with_path(path, error.what()));
  } catch (const core::InputError& error) {
    throw core::InputError(with_path(path, error.what()));
  }
}

}  // namespace dmpc::apps
