#include "apps/scene.h"

#include <ostream>

#include "apps/nff_writer.h"
#include "apps/output_file.h"
#include "core/expect.h"
#include "core/scenes.h"

namespace dmpc::apps {

int scene_command(const SceneOptions& options, const Interrupt& interrupt, std::ostream& output) {
  const core::SceneName name = core::parse_scene_name(options.name);
  const auto produce = [&](core::SceneSink& sink) {
    core::generate_scene(name, sink);
    interrupt.check();
  };
  if (options.output) {
    check_output_path(*options.output, "-o");
    write_nff_file(options.output->string(), produce);
    return 0;
  }
  NffWriter writer(output);
  produce(writer);
  if (!output.flush()) {
    throw core::InputError("the scene could not be written to the standard output");
  }
  return 0;
}

}  // namespace dmpc::apps
