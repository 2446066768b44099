#include "apps/formats/mesh_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "apps/formats/mesh_session.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace fs = std::filesystem;

namespace {

/// Of formats that are known and not read, since the library that reads them makes wrong pictures of them without a word.
struct RefusedFormat {
  std::string_view ending;
  const char* why;
};
constexpr std::array refused_formats{
    RefusedFormat{"3mf",
                  "3MF is not read: Assimp gives all triangles of an object the material of the last, what has none that of "
                  "another, and leaves out parts that lie in files of their own"},
    RefusedFormat{"x3d",
                  "X3D is not read: Assimp gives a shape without an appearance that of another, reads numbers up to their "
                  "first letter and no commas, and takes no viewpoint"},
};

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  ending.erase(0, 1);
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

void check_is_read(const std::string& path) {
  for (const RefusedFormat& format : refused_formats) {
    if (ending_of(path) == format.ending) {
      throw core::InputError(std::string(format.why) + "; convert the file to glTF, OBJ, PLY, STL or OFF");
    }
  }
}

}  // namespace

const std::vector<std::string>& mesh_extensions() {
  static const std::vector<std::string> extensions = {"obj", "ply", "stl", "gltf", "glb", "3ds",  "ac",      "amf", "ase",
                                                      "dae", "fbx", "lwo", "ms3d", "off", "pbrt", "pbrt.gz", "x"};
  return extensions;
}

bool is_mesh_path(const std::string& path) {
  const std::string ending = ending_of(path);
  const auto& known = mesh_extensions();
  return std::find(known.begin(), known.end(), ending) != known.end() || has_own_sky(path) ||
         std::any_of(refused_formats.begin(), refused_formats.end(), [&](const auto& format) { return format.ending == ending; });
}

bool has_own_sky(const std::string& path) {
  return ending_of(path) == "pbrt" || (ending_of(path) == "gz" && ending_of(fs::path(path).stem().string()) == "pbrt");
}

bool is_played(const std::string& path) { return ending_of(path) == "gltf" || ending_of(path) == "glb"; }

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
    core::expect(!options.animation || is_played(path), "animations are asked for of glTF alone");
    check_is_read(path);
    return MeshSession(path, options, shows_progress, limits).read();
  } catch (const core::RoomError& error) {
    throw core::RoomError(path + ": " + error.what());
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    throw text.starts_with(path + ":") ? error : core::InputError(path + ": " + text);  // one that names the line, too
  }
}

}  // namespace dmpc::apps
