#include "apps/scene/scene_command.h"

#include <ostream>
#include <string>

#include "apps/formats/landscape/names.h"
#include "apps/formats/landscape/scene.h"
#include "apps/formats/nff_writer.h"
#include "apps/frontend/system/output_file.h"
#include "core/base/expect.h"
#include "core/families/scenes.h"

namespace dmpc::apps {

namespace {

/// Refuses a file extension for which the scene would be read back as another format.
void check_ending(const core::SceneName& name, const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (!ending.empty() && ending != ".nff" && ending != ".NFF") {
    throw core::UsageError("-o " + path.string() + ": " + name.text() +
                           " is written as NFF: expected a name that ends in .nff, or has no ending");
  }
}

void write_file(const core::SceneName& name, const std::filesystem::path& path, Interrupt& interrupt) {
  check_ending(name, path);
  check_output_path(path, "-o");
  if (is_special(path)) {
    interrupt.set_consequence("the output is incomplete");
  }
  const Interrupt::EndAtOnce end_at_once(interrupt);
  write_nff_file(path.string(), [&name](core::SceneSink& sink) { core::generate_scene(name, sink); });
}

void write_output(const core::SceneName& name, Interrupt& interrupt, std::ostream& output) {
  interrupt.set_consequence("the output is incomplete");
  const Interrupt::EndAtOnce end_at_once(interrupt);
  output.exceptions(std::ostream::badbit);  // so that generation stops once nobody reads the output
  try {
    NffWriter writer(output);
    core::generate_scene(name, writer);
    output.flush();
  } catch (const std::ostream::failure&) {
    output.exceptions(std::ostream::goodbit);
  }
  finish_output(output, "the scene");
}

/// NFF has neither textures nor instances.
void check_has_nff(const std::string& scene) {
  if (is_landscape_name(scene)) {
    throw core::UsageError(scene + " is no NFF scene, as it has textures: dmpc render " + scene +
                           " renders it by its name, and dmpc build " + scene + " -o FILE.pages keeps it as a file");
  }
}

}  // namespace

void add_options(OptionSet options, SceneOptions& scene) {
  options.add_argument(
      "SCENE", [&scene](const std::string& text) { scene.name = text; },
      "FAMILY, FAMILY-SIZE, or FAMILY-SIZE-tN for curved surfaces as triangles");
  options.add_path("-o,--output", "FILE [stdout]", scene.output, "Output file");
  options.add_quiet(scene.quiet);
  options.set_examples("Families:\n" + core::describe_scene_families() +
                       "\nExamples:\n"
                       "  dmpc scene teapot-12 -o teapot.nff\n"
                       "  dmpc scene rings-4-t1 | head");
}

int scene_command(const SceneOptions& options, Interrupt& interrupt, std::ostream& output) {
  check_has_nff(options.name);
  const core::SceneName name = core::parse_scene_name(options.name, landscape_families);
  if (options.output) {
    write_file(name, *options.output, interrupt);
  } else {
    write_output(name, interrupt, output);
  }
  return 0;
}

}  // namespace dmpc::apps
