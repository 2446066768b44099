#include "apps/load_scene.h"

#include <filesystem>
#include <limits>
#include <system_error>

#include "apps/nff_reader.h"
#include "core/scenes.h"

namespace dmpc::apps {

core::Scene load_scene(const std::string& scene, std::int64_t pixels_max) {
  if (const auto name = core::find_scene_name(scene)) {
    return core::built_in_scene(*name);
  }
  std::error_code error;
  const bool looks_like_name = scene.find_first_of("./") == std::string::npos;
  if (looks_like_name && !std::filesystem::exists(scene, error)) {
    return core::built_in_scene(core::parse_scene_name(scene));  // throws, listing what there is
  }
  return read_nff_file(scene, pixels_max);
}

void add_scene_file(const std::string& scene, std::vector<NamedFile>& inputs) {
  if (!core::find_scene_name(scene)) {
    inputs.push_back({"SCENE", scene});
  }
}

core::Scene load_scene(const PictureOptions& picture) {
  return load_scene(picture.scene, picture.resolution ? std::numeric_limits<std::int64_t>::max() : picture_pixels_max);
}

}  // namespace dmpc::apps
