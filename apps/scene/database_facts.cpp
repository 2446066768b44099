#include "apps/scene/database_facts.h"

#include <algorithm>

#include "apps/frontend/line/number_text.h"
#include "apps/scene/load_scene.h"
#include "core/base/expect.h"
#include "core/scene/frame.h"
#include "core/scene/stored_objects.h"

namespace dmpc::apps {
namespace {

template <class T>
std::string text_or_no(const std::optional<T>& value) {
  if constexpr (std::is_same_v<T, double>) {
    return value ? shortest(*value) : "no";
  } else {
    return value ? text_of(*value) : "no";
  }
}

std::string lights_text(const std::vector<core::PointLight>& lights) {
  std::string text;
  for (const core::PointLight& light : lights) {
    text += (text.empty() ? "" : " and ") + text_of(light);
  }
  return text.empty() ? "no" : text;
}

std::string page_size_text(const core::BuildOptions& built) {
  return built.page_size_bytes >= 1024 ? std::to_string(built.page_size_bytes / 1024) + "KiB"
                                       : std::to_string(built.page_size_bytes) + "B";
}

/// A mesh file's own camera, which spans its angle over the picture, decides its lights unless there is another, and some lights
/// depend on where any is.
std::string camera_text(const PictureOptions& picture) {
  const auto& camera = picture.scene_setup.camera;
  const bool moves_light = picture.scene_setup.fill.value_or(0) > 0 || picture.transport.light_radius;
  return camera && moves_light ? text_of(*camera) : camera && is_mesh(picture.scene) ? "another" : "no";
}

std::string resolution_text(const PictureOptions& picture) {
  const auto& size = picture.resolution;
  return size && !picture.scene_setup.camera && is_mesh(picture.scene)
             ? std::to_string(size->width) + "x" + std::to_string(size->height)
             : "no";
}

}  // namespace

bool is_of_building(const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  return name == "--instances" || std::ranges::any_of(database_rows(), [&](const DatabaseRow& row) { return row.name == name; });
}

std::vector<std::string> words_of(const core::BuildOptions& built) {
  std::vector<std::string> words = {"--page-size=" + page_size_text(built),
                                    std::string("--record-order=") + name_of(built.record_order),
                                    std::string("--structure=") + name_of(built.structure),
                                    std::string("--instances=") + (built.keeps_instances ? "keep" : "expand")};
  if (built.structure == core::Structure::voxels) {
    words.push_back("--voxels=" + text_of(built.voxels));
  }
  return words;
}

CommandLine::Standing standing_of_scene() {
  return {"SCENE", [](const std::string& scene, const CommandLine::Standing::Given& given) {
            std::vector<std::string> words;
            if (is_database_path(scene) && given("--vary").empty()) {  // a sweep passes it on
              words = DatabaseFile(scene).origin().words;
              std::erase_if(words, [&](const std::string& word) { return !given("--system").empty() && is_of_building(word); });
            }
            const std::string own = "--transport=paths";  // what goes with it alone says less than that another is asked for
            if (std::ranges::count(words, own) > 0 && !given("--transport").empty() && given("--transport").front() != "paths") {
              std::erase_if(words, [](const std::string& word) { return !is_of_building(word); });
            }
            return words;
          }};
}

DatabaseFacts database_facts(const PictureOptions& picture, const core::BuildOptions& built) {
  const SceneSetup& setup = picture.scene_setup;
  const TransportOptions& transport = picture.transport;
  DatabaseFacts facts = {{"--transport", name_of(transport.kind)},
                         {"--light", lights_text(setup.lights)},
                         {"--fill", text_or_no(setup.fill)},
                         {"--ambient", text_or_no(setup.ambient)},
                         {"--background", text_or_no(setup.background)},
                         {"--sky", text_or_no(transport.sky)},
                         {"--light-radius", text_or_no(transport.light_radius)},
                         {"--emitters", std::to_string(transport.emitters_max())},
                         {"--scale", text_or_no(setup.mesh.scale)},
                         {"--up", text_or_no(setup.mesh.up)},
                         {"--smooth", text_or_no(setup.mesh.smooth_degrees)},
                         {"--missing", setup.mesh.allows_missing ? "plain" : "no"},
                         {"--files", setup.mesh.opens_anywhere ? "anywhere" : "no"},
                         {"--camera", camera_text(picture)},
                         {"--resolution", resolution_text(picture)}};
  for (const std::string& word : words_of(built)) {
    const std::size_t equals = word.find('=');
    facts.emplace_back(word.substr(0, equals), word.substr(equals + 1));
  }
  return facts;
}

std::string difference_of(const DatabaseFacts& asked, const DatabaseFacts& stored) {
  const auto value_in = [](const DatabaseFacts& facts, const std::string& name) {
    const auto found = std::ranges::find_if(facts, [&](const auto& fact) { return fact.first == name; });
    return found == facts.end() ? "no" : found->second;
  };
  const auto said = [](const std::string& name, const std::string& value) {
    return value == "no" ? "no " + name : name + "=" + value;
  };
  for (const DatabaseFacts* const facts : {&stored, &asked}) {
    for (const auto& [name, value] : *facts) {
      const std::string has = value_in(stored, name), wanted = value_in(asked, name);
      if (has != wanted) {
        return "it was built with " + said(name, has) + ", and this needs " + said(name, wanted);
      }
    }
  }
  return "";
}

core::Database stored_database(const core::Scene& scene, const PictureOptions& picture, const core::BuildOptions& built) {
  core::expect(scene.stored != nullptr && picture.stored, "a stored scene has a file");
  const DatabaseFile file(*picture.stored);
  if (const std::string why = difference_of(database_facts(picture, built), file.origin().facts); !why.empty()) {
    file.refuse(why);
  }
  const core::Box& bounds = scene.stored->bounds;
  if (!bounds.empty() && core::eye_distance(scene.view.from, bounds) > scene.stored->eye_distance) {
    file.refuse(
        "it was built for cameras no farther away from the scene; --any-camera builds one for all, --camera for this one");
  }
  core::Database database = file.database();
  if (picture.is_refined && database.primitives().size() != database.header().primitive_count) {
    file.refuse("it has meshes without copies, among which --samples=auto looks for fine detail: build it with --samples=auto");
  }
  return database;
}

}  // namespace dmpc::apps
