#include "apps/scene_file.h"

#include <filesystem>
#include <iostream>

#include "apps/nff_reader.h"
#include "apps/nff_writer.h"
#include "core/expect.h"
#include "core/scenes.h"

namespace dmpc::apps {

core::Scene open_scene(const std::string& name) {
  if (const auto built_in = core::find_scene_name(name)) {
    return core::built_in_scene(*built_in);
  }
  std::error_code error;
  if (!std::filesystem::exists(name, error) && name.find_first_of("./") == std::string::npos) {
    throw core::InputError("'" + name +
                           "' is neither a file nor a built-in scene; expected the path of an NFF file, or one of\n" +
                           core::describe_scene_families() + "as FAMILY-SIZE[-tTESSELLATION], for example rings-4-t1");
  }
  return read_nff_file(name);
}

void write_built_in_scene(const std::string& name, const std::string& path) {
  const core::SceneName scene = core::parse_scene_name(name);
  if (!path.empty()) {
    return write_nff_file(path, [&scene](core::SceneSink& sink) { core::generate_scene(scene, sink); });
  }
  NffWriter writer(std::cout);
  core::generate_scene(scene, writer);
  if (!std::cout.flush()) {
    throw core::InputError("standard output: could not be written to the end");
  }
}

}  // namespace dmpc::apps
