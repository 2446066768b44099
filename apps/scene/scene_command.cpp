#include "apps/scene/scene_command.h"

#include <iostream>
#include <ostream>

#include "apps/formats/landscape/files.h"
#include "apps/formats/nff_writer.h"
#include "apps/frontend/system/output_file.h"
#include "apps/frontend/system/progress.h"
#include "core/base/expect.h"
#include "core/families/scenes.h"

namespace dmpc::apps {

namespace {

/// Refuses a file extension for which the scene would be read back as another format.
void check_ending(const core::SceneName& name, const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (!ending.empty() && ending != ".nff" && ending != ".NFF") {
    throw core::UsageError(
        "-o " + path.string() + ": " + name.text() +
        " is written as NFF: expected a name that ends in .nff, or has no ending (only landscapes and groves are " +
        "written as .gltf: dmpc scene landscape-10 -o land.gltf)");
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

using WriteFiles = void (*)(int size, const std::filesystem::path& gltf, const RowsDone& rows_done);

void write_files(WriteFiles write, int size, const SceneOptions& options, Interrupt& interrupt) {
  const auto& path = options.output;
  if (!path) {
    throw core::UsageError(options.name + " is several files: give -o FILE.gltf");
  }
  check_output_path(*path, "-o");
  const Interrupt::EndAtOnce end_at_once(interrupt);
  Progress progress(std::cerr, !options.quiet && stderr_is_terminal(), "Making " + options.name + ":", "rows");
  write(size, *path, [&progress](std::uint64_t done, std::uint64_t total) { progress.update(done, total); });
}

}  // namespace

void add_options(OptionSet options, SceneOptions& scene) {
  options.add_argument(
      "SCENE", [&scene](const std::string& text) { scene.name = text; },
      "FAMILY, FAMILY-SIZE, or FAMILY-SIZE-tN for curved surfaces as triangles");
  options.add_path("-o,--output", "FILE [stdout]", scene.output, "Output file");
  options.add_quiet(scene.quiet);
  options.set_examples("Families:\n" + core::describe_scene_families() + describe_landscape() +
                       "\nExamples:\n"
                       "  dmpc scene teapot-12 -o teapot.nff\n"
                       "  dmpc scene rings-4-t1 | head\n"
                       "  dmpc scene landscape-10 -o land.gltf");
}

int scene_command(const SceneOptions& options, Interrupt& interrupt, std::ostream& output) {
  if (const auto size = landscape_size(options.name)) {
    write_files(write_landscape, *size, options, interrupt);
    return 0;
  }
  if (const auto size = grove_size(options.name)) {
    write_files(write_grove, *size, options, interrupt);
    return 0;
  }
  const core::SceneName name = core::parse_scene_name(options.name, landscape_families);
  if (options.output) {
    write_file(name, *options.output, interrupt);
  } else {
    write_output(name, interrupt, output);
  }
  return 0;
}

}  // namespace dmpc::apps
