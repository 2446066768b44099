#include "apps/formats/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "apps/formats/mesh_session.h"
#include "core/base/expect.h"

namespace dmpc::apps {

const std::vector<std::string>& mesh_extensions() {
  static const std::vector<std::string> extensions = {"obj", "ply", "stl", "gltf", "glb",  "3ds", "3mf", "ac", "amf",
                                                      "ase", "dae", "fbx", "lwo",  "ms3d", "off", "x",   "x3d"};
  return extensions;
}

bool is_mesh_path(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto& known = mesh_extensions();
  return !extension.empty() && std::find(known.begin(), known.end(), extension.substr(1)) != known.end();
}

std::string known_mesh_formats() {
  std::string text;
  for (const std::string& extension : mesh_extensions()) {
    text += (text.empty() ? "" : ", ") + extension;
  }
  return text;
}

MeshFile read_mesh_file(const std::string& path, const MeshOptions& options, bool shows_progress) {
  return read_mesh_file(path, options, shows_progress, ReaderLimits{});
}

MeshFile read_mesh_file(const std::string& path, const MeshOptions& options, bool shows_progress, const ReaderLimits& limits) {
  try {
    return MeshSession(path, options, shows_progress, limits).read();
  } catch (const core::RoomError& error) {
    throw core::RoomError(path + ": " + error.what());
  } catch (const core::InputError& error) {
    throw core::InputError(path + ": " + error.what());
  }
}

}  // namespace dmpc::apps
