#include "apps/build/command.h"

#include <memory>
#include <ostream>
#include <utility>

#include "apps/database/database_file.h"
#include "apps/frontend/system/output_file.h"
#include "apps/info/scene_figures.h"
#include "apps/render/picture_identity.h"
#include "apps/run/instance_options.h"
#include "apps/scene/database_facts.h"
#include "apps/scene/load_scene.h"
#include "apps/scene/subject.h"
#include "core/base/expect.h"
#include "core/scene/frame.h"
#include "core/scene/stored_objects.h"

namespace dmpc::apps {
namespace {

core::StoredObjects stored_objects_of(const core::Scene& scene) {
  const SceneFigures figures = figures_of(scene);
  return {.objects = figures.objects,
          .bounds = figures.bounds,
          .eye_distance = figures.bounds.empty() ? 0 : core::eye_distance(scene.view.from, figures.bounds),
          .share = core::instancing_share(scene),
          .meshes = figures.meshes.count,
          .mesh_triangles = figures.meshes.triangles,
          .triangles_in_places = figures.meshes.triangles_in_places,
          .identity = stored_identity(scene)};
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
      "database cannot be changed afterwards; --camera, --samples and the like can. Only who wrote it, root or the owner of "
      "dmpc\n"
      "may be able to write it, and only the version of dmpc that wrote it reads it.");
}

int build_command(const BuildRequest& build, Interrupt& interrupt, std::ostream& /*output*/) {
  check_output_path(build.output, "-o");
  const Interrupt::EndAtOnce end_at_once(interrupt);
  core::Scene scene = load_scene_beside(build.picture, {{"-o", build.output}});
  core::StoredObjects stored = stored_objects_of(scene);
  const core::View own = scene.view;
  if (build.for_any_camera) {
    put_eye_far_away(scene, stored.bounds);
    stored.eye_distance = 2 * core::far_eye_diagonals;
  }
  const Subject subject = build_subject_of(scene, build.picture, build.database, !build.quiet);
  say_notes(notes_of(subject));
  scene.view = own;
  scene.stored = std::make_shared<const core::StoredObjects>(std::move(stored));
  DatabaseOrigin origin{build.picture.scene, build.words, database_facts(build.picture, subject.built)};
  std::erase_if(origin.words, is_of_building);
  const std::vector<std::string> built = words_of(subject.built);
  origin.words.insert(origin.words.end(), built.begin(), built.end());
  OutputFile file(build.output, {.option = "-o"});
  write_database(origin, scene, subject.database, file.stream());
  file.commit();
  return 0;
}

}  // namespace dmpc::apps
