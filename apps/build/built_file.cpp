#include "apps/build/built_file.h"

#include <memory>
#include <utility>

#include "apps/info/scene_figures.h"
#include "apps/render/picture_identity.h"
#include "apps/scene/database_facts.h"
#include "apps/scene/load_scene.h"
#include "core/scene/frame.h"
#include "core/scene/stored_objects.h"

namespace dmpc::apps {
namespace {

core::StoredObjects stored_objects_of(const core::Scene& scene) {
  const SceneFigures figures = figures_of(scene);
  return {{.objects = figures.objects,
           .bounds = figures.bounds,
           .eye_distance = figures.bounds.empty() ? 0 : core::eye_distance(scene.view.from, figures.bounds),
           .share = core::instancing_share(scene),
           .meshes = figures.meshes.count,
           .mesh_triangles = figures.meshes.triangles,
           .triangles_in_places = figures.meshes.triangles_in_places},
          stored_identity(scene)};
}

/// Those of building as they were decided.
std::vector<std::string> words_for(std::vector<std::string> given, const core::BuildOptions& built) {
  std::erase_if(given, is_of_building);
  const std::vector<std::string> decided = words_of(built);
  given.insert(given.end(), decided.begin(), decided.end());
  return given;
}

}  // namespace

BuiltFile build_file(const BuildRequest& build, const std::function<void(const OpenedFiles&)>& check) {
  OpenedFiles opened;
  PictureOptions picture = build.picture;
  std::vector<std::string> words = build.words;
  core::Scene scene = load_scene(picture, build.quiet ? LoadNotes::silent : LoadNotes::said, &opened);
  check(opened);
  if (build.for_any_camera && is_mesh(picture.scene) && !picture.scene_setup.camera) {
    picture.scene_setup.camera = camera_of(scene.view);  // one that stands in place of the file's own, as any other will
    words.push_back("--camera=" + text_of(*picture.scene_setup.camera));
    scene = load_scene(picture, LoadNotes::silent);
  }
  core::StoredObjects stored = stored_objects_of(scene);
  const core::View own = scene.view;
  if (build.for_any_camera) {
    put_eye_far_away(scene, stored.bounds);
    stored.eye_distance = 2 * core::far_eye_diagonals;
  }
  Subject subject = build_subject_of(scene, picture, build.database, !build.quiet);
  scene.view = own;
  scene.stored = std::make_shared<const core::StoredObjects>(std::move(stored));
  DatabaseOrigin origin{picture.scene, words_for(std::move(words), subject.built), database_facts(picture, subject.built),
                        source_of(opened)};
  return {std::move(origin), std::move(scene), std::move(subject)};
}

void BuiltFile::write(const std::filesystem::path& path, const OutputFile::Settings& settings) const {
  OutputFile file(path, settings);
  write_database(origin, scene, subject.database, file.stream());
  file.commit();
}

}  // namespace dmpc::apps
