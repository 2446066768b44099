#include "apps/load_scene.h"

#include <filesystem>
#include <system_error>

#include "apps/nff_reader.h"
#include "core/scenes.h"

namespace dmpc::apps {

core::Scene load_scene(const std::string& scene) {
  if (const auto name = core::find_scene_name(scene)) {
    return core::built_in_scene(*name);
  }
  std::error_code error;
  const bool looks_like_name = scene.find_first_of("./") == std::string::npos;
  if (looks_like_name && !std::filesystem::exists(scene, error)) {
    return core::built_in_scene(core::parse_scene_name(scene));  // throws, listing what there is
  }
  return read_nff_file(scene);
}

}  // namespace dmpc::apps
