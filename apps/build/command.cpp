#include "apps/build/command.h"

#include <string>

#include "apps/frontend/system/distinct_files.h"
#include "apps/run/instance_options.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// What is the default of a mesh file in some commands is the file's in all.
void add_words_of_mesh(const OptionSet& options, BuildRequest& build) {
  if (build.picture.is_by_paths_unasked) {
    build.words.emplace_back("--transport=paths");
    if (!options.is_given("--sky")) {
      build.words.push_back("--sky=" + text_of(*build.picture.transport.sky));
    }
    if (build.picture.is_refined && !options.is_given("--samples")) {
      build.words.emplace_back("--samples=auto");
    }
  }
}

}  // namespace

void add_options(OptionSet options, BuildRequest& build) {
  build.picture.presents_meshes = true;
  add_options(options, build.picture);
  add_transport_options(options, build.picture);
  options.add_required(
      "-o,--output", "FILE.pages", [&build](const std::string& text) { build.output = text; }, "Output file");
  add_options(options, build.database);
  add_instance_option(options, build.database);
  options.add_flag("--any-camera", build.for_any_camera,
                   "For cameras at any distance, as dmpc view needs it; otherwise for those no farther away than the scene's or "
                   "--camera, with the counters that a render from there has");
  options.add_quiet(build.quiet);
  options.check_in_the_end([options, &build] {
    settle_instances(options, {}, build.database, build.picture.scene_setup.mesh);
    check_voxels(options, build.database.build);
    build.words = options.given_words({"--output", "--quiet", "--any-camera"});
    add_words_of_mesh(options, build);
    if (!is_database_path(build.output.string())) {
      throw core::UsageError("-o " + build.output.string() + ": expected a name that ends in .pages");
    }
    if (build.picture.stored) {
      throw core::UsageError(build.picture.stored->path.string() + " is built already: expected a scene");
    }
  });
  options.set_examples(
      "Examples:\n"
      "  dmpc build landscape-10 -o land.pages\n"
      "  dmpc render land.pages --nodes=64 --runner=pool -o land.png\n"
      "  dmpc build model.glb --sky=noon.hdr --structure=extents --any-camera -o model.pages\n"
      "The file stands for the scene in every command that takes one, with all options given here. Those that decide the\n"
      "database cannot be changed afterwards; --camera, --samples and the like can. Only you, root or the owner of dmpc may be\n"
      "able to write it, and only the version of dmpc that wrote it reads it.");
}

int build_command(const BuildRequest& build, Interrupt& interrupt, std::ostream& /*output*/) {
  check_output_path(build.output, "-o");
  const Interrupt::EndAtOnce end_at_once(interrupt);
  const BuiltFile built = build_file(build, [&](const OpenedFiles& opened) { check_not_read(opened, {{"-o", build.output}}); });
  say_notes(notes_of(built.subject));
  built.write(build.output, {.option = "-o"});
  return 0;
}

}  // namespace dmpc::apps
