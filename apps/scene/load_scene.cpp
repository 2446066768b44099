#include "apps/scene/load_scene.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <limits>
#include <set>
#include <system_error>

#include "apps/database/database_file.h"
#include "apps/formats/landscape/names.h"
#include "apps/formats/landscape/scene.h"
#include "apps/formats/mesh_file.h"
#include "apps/formats/nff_reader.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/progress.h"
#include "apps/scene/sky_file.h"
#include "core/base/expect.h"
#include "core/database/shading/light_spheres.h"
#include "core/families/scenes.h"
#include "core/scene/placed_objects.h"

namespace dmpc::apps {
namespace {

/// Benchmarks load a scene repeatedly; one message is enough.
void say_once(const std::vector<std::string>& notes) {
  static std::set<std::string> said;
  for (const std::string& note : notes) {
    if (!note.empty() && said.insert(note).second) {
      std::cerr << "dmpc: " << note << '\n';
    }
  }
}

/// Returns whether the sky is not black in some direction.
bool is_below_light(const core::Scene& scene, const SkyChoice& sky) {
  constexpr core::Vec3d black;
  return sky.is_picture() ? scene.sky.brightest > 0 || scene.background != black
                          : sky.horizon != black || sky.zenith.value_or(black) != black;
}

bool has_what_shines(const core::Scene& scene) { return std::ranges::any_of(scene.materials, &core::Material::shines); }

/// With path tracing a sky and emitters also light the scene.
bool is_lit(const core::Scene& scene, const TransportOptions& transport) {
  return !scene.lights.empty() || scene.ambient != core::Vec3d{} || (transport.sky && is_below_light(scene, *transport.sky)) ||
         (transport.is_by_paths() && has_what_shines(scene));
}

/// Returns a note about a scene that is not lit, and may have a sky of its own.
std::string dark_text(const core::Scene& scene, const TransportOptions& transport, bool has_sky) {
  if (has_what_shines(scene)) {
    return "its only lights are emissive surfaces, which light other things with --transport=paths only";
  }
  return std::string("it has no light: what reflects none is black; --light=X,Y,Z adds one") +
         (transport.is_by_paths() ? ", --sky=1 a sky"
          : has_sky               ? ", --transport=paths the sky that its file may have"
                                  : "");
}

/// Warns of pictures that are black, or show only background.
void say_what_is_missing(const core::Scene& scene, const TransportOptions& transport, bool has_sky) {
  if (object_count(scene) == 0) {
    say_once({scene.name + ": the scene is empty: the picture shows the background only"});
  } else if (!is_lit(scene, transport)) {
    say_once({scene.name + ": " + dark_text(scene, transport, has_sky)});
  }
}

/// The data of a mesh file besides its scene.
struct Surroundings {
  std::vector<MeshSky> skies;
  StillScene still;  ///< without its view, if an animation is requested
};

core::Scene load_mesh(const std::string& path, const MeshOptions& options, LoadNotes notes, OpenedFiles& opened,
                      Surroundings& around) {
  const bool says = notes == LoadNotes::said;
  MeshFile file = read_mesh_file(path, options, says && stderr_is_terminal());
  opened.add(file.opened);
  if (says) {
    say_once(file.notes);
  }
  around = {std::move(file.skies), file.still};
  return std::move(file.scene);
}

/// Returns a note about lights that --light-radius leaves unchanged.
std::string points_text(std::uint64_t count) {
  return count == 0
             ? ""
             : counted(count, "light") + (count == 1 ? " stays a point" : " stay points") +
                   ": as spheres of --light-radius they would contain the camera, or be too small or too far away to be seen";
}

/// Returns a note about the bounces in the file, if no option sets others.
std::string bounces_text(const core::Scene& scene, const PictureOptions& picture) {
  const int bounces = depth_of(picture, scene) - 1;
  return bounces == picture.depth - 1 || !scene.bounces
             ? ""
             : "the scene's file sets the number of bounces: " + counted(static_cast<std::uint64_t>(bounces), "bounce") +
                   "; --bounces=" + std::to_string(picture.transport.bounces) + " sets the default of other scenes";
}

constexpr const char* one_path_note = "one path per pixel gives mostly noise; more of them reduce it, such as --samples=256";

constexpr const char* no_points_note = "--light-radius has no effect: there is no point light in the scene";

/// Returns advice about a file that no reader supports.
std::string advice_on(const std::string& path, const std::string& ending) {
  constexpr std::array packed{".gz", ".bz2", ".xz", ".zst", ".zip", ".7z", ".tgz"};
  constexpr std::array foreign{".wrl",  ".vrml", ".x3dv", ".blend", ".usd", ".usda", ".usdc", ".usdz", ".abc", ".3dm", ".dxf",
                               ".step", ".stp",  ".iges", ".igs",   ".max", ".c4d",  ".ma",   ".mb",   ".skp", ".b3d", ".dwg"};
  const auto is_in = [&](const auto& endings) { return std::find(endings.begin(), endings.end(), ending) != endings.end(); };
  return is_in(packed)    ? ": unpack " + path + " first, and render what is in it"
         : is_in(foreign) ? ": convert " + path + " to glTF, OBJ, PLY, STL or OFF"
                          : "";
}

core::Scene load_nff(const std::string& path, std::int64_t pixels_max, LoadNotes notes, OpenedFiles& opened) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (is_database_path(path)) {
    throw core::InputError(path + " is a database, and this builds others: give the scene of which it was built");
  }
  if (!ending.empty() && ending != ".nff" && ending != ".NFF") {
    throw core::InputError(path + ": files that end in " + ending + " are not read" + advice_on(path, ending) +
                           "; expected .nff or one of " + known_mesh_formats());
  }
  Progress progress(std::cerr, notes == LoadNotes::said && stderr_is_terminal(), "Reading " + path + ":", "bytes");
  opened.add(path);
  return read_nff_file(path, pixels_max, [&](std::uint64_t done, std::uint64_t total) { progress.update(done, total); });
}

core::Scene read_any(const std::string& scene, const MeshOptions& mesh, std::int64_t pixels_max, LoadNotes notes,
                     OpenedFiles& opened, Surroundings& around) {
  if (const auto name = core::find_scene_name(scene)) {
    return core::built_in_scene(*name);
  }
  std::error_code error;
  const bool looks_like_name = scene.find_first_of("./") == std::string::npos;
  if (looks_like_name && !std::filesystem::exists(scene, error)) {
    if (is_landscape_name(scene)) {
      Progress progress(std::cerr, notes == LoadNotes::said && stderr_is_terminal(), "Making " + scene + ":", "rows");
      return landscape_scene(scene, mesh.copies, [&](std::uint64_t done, std::uint64_t total) { progress.update(done, total); });
    }
    return core::built_in_scene(core::parse_scene_name(scene, landscape_families));  // throws, with a list of the names
  }
  return is_mesh_path(scene) ? load_mesh(scene, mesh, notes, opened, around) : load_nff(scene, pixels_max, notes, opened);
}

/// The sky stays where it is, whatever view replaces the scene's own.
core::Scene load_any(const std::string& scene, const MeshOptions& mesh, std::int64_t pixels_max, LoadNotes notes,
                     OpenedFiles& opened, Surroundings& around) {
  core::Scene read = read_any(scene, mesh, pixels_max, notes, opened, around);
  read.zenith = zenith_of(read);
  return read;
}

/// Returns a note about unexpected shadows when a light is added to a mesh.
std::string shadow_note(const SceneSetup& scene_setup) {
  const bool is_alone = !scene_setup.lights.empty() && !scene_setup.fill && !scene_setup.ambient;
  return is_alone
             ? "what --light does not reach is black: --fill=0.3 adds a light in the eye, --ambient=0.1 light from everywhere"
             : "";
}

void check_mesh_options(const std::string& scene, const MeshOptions& options) {
  if (options.animation && !(is_mesh(scene) && is_played(scene))) {
    throw core::UsageError("--animation goes with glTF files (.gltf, .glb), and " + scene + " is none");
  }
  if (!is_mesh(scene) &&
      (options.scale || options.up || options.smooth_degrees || options.allows_missing || options.opens_anywhere)) {
    throw core::UsageError("--scale, --up, --smooth, --missing=plain and --files=anywhere go with mesh files (" +
                           known_mesh_formats() + "), and " + scene + " is none");
  }
}

/// With the lights of when it was built.
core::Scene load_stored(const PictureOptions& picture, LoadNotes notes, OpenedFiles* opened) {
  if (picture.scene_setup.mesh.animation) {
    throw core::UsageError("--animation does not go with " + picture.stored->path.string() +
                           ", the database of one moment: give the scene's file");
  }
  core::Scene scene = DatabaseFile(*picture.stored).scene();
  if (opened != nullptr) {
    opened->add(picture.stored->path);
  }
  const SceneSetup camera{.camera = picture.scene_setup.camera, .mesh = picture.scene_setup.mesh};
  const std::string note = apply(camera, scene, is_mesh(picture.scene) ? SceneKind::mesh : SceneKind::own);
  if (notes == LoadNotes::said) {
    say_once({note, picture.is_one_path_unasked ? one_path_note : "", bounces_text(scene, picture)});
    say_what_is_missing(scene, picture.transport, is_below_own_sky(picture.scene));
  }
  return scene;
}

}  // namespace

bool is_mesh(const std::string& scene) { return !core::find_scene_name(scene) && is_mesh_path(scene); }

bool is_below_own_sky(const std::string& scene) { return is_mesh(scene) && has_own_sky(scene); }

SkyChoice own_sky(const std::string& scene) { return {.horizon = {}, .zenith = {}, .file = scene}; }

bool is_own_sky(const PictureOptions& picture) {
  return is_below_own_sky(picture.scene) && picture.transport.sky && picture.transport.sky->file == picture.scene;
}

core::Scene load_scene(const std::string& scene, std::int64_t pixels_max) {
  OpenedFiles opened;
  Surroundings around;
  return load_any(scene, {}, pixels_max, LoadNotes::said, opened, around);
}

void add_scene_file(const std::string& scene, std::vector<NamedFile>& inputs) {
  if (!core::find_scene_name(scene)) {
    inputs.push_back({"SCENE", scene});
  }
}

void add_scene_file(const PictureOptions& picture, std::vector<NamedFile>& inputs) {
  add_scene_file(picture.stored ? picture.stored->path.string() : picture.scene, inputs);
}

core::Scene load_scene(const PictureOptions& picture, LoadNotes notes, OpenedFiles* opened, StillScene* still) {
  if (picture.stored) {
    return load_stored(picture, notes, opened);
  }
  check_mesh_options(picture.scene, picture.scene_setup.mesh);
  MeshOptions mesh = picture.scene_setup.mesh;
  mesh.size = picture.resolution;
  mesh.is_seen_otherwise = picture.scene_setup.camera.has_value();
  mesh.is_lit_otherwise = !picture.scene_setup.lights.empty();
  mesh.is_below_sky = picture.transport.sky.has_value();
  mesh.is_below_own_sky = is_own_sky(picture);
  mesh.is_by_paths = picture.transport.is_by_paths();
  OpenedFiles read;
  Surroundings around;
  core::Scene scene =
      load_any(picture.scene, mesh, picture.resolution ? std::numeric_limits<std::int64_t>::max() : picture_pixels_max, notes,
               read, around);
  const SceneKind kind = is_mesh(picture.scene) ? SceneKind::mesh : SceneKind::own;
  const std::string note = apply(picture.scene_setup, scene, kind);
  set_sky(around.skies, scene);
  const bool has_points = !scene.lights.empty();
  std::string sky_note;
  if (picture.transport.sky && picture.transport.sky->is_picture() && !mesh.is_below_own_sky) {
    read.add(picture.transport.sky->file);
    sky_note = read_sky(picture.transport.sky->file, picture.scene_setup.mesh.sandbox, scene);
  }
  if (opened != nullptr) {
    opened->add(read);
  }
  if (still != nullptr) {
    *still = around.still;
    still->view = scene.view;
  }
  const std::uint64_t points_left =
      picture.transport.light_radius ? core::make_lights_spheres(scene, *picture.transport.light_radius) : 0;
  if (notes == LoadNotes::said) {
    const bool may_be_black = kind == SceneKind::mesh && !picture.transport.is_by_paths();
    say_once({note, sky_note, contrast_text(scene.sky), may_be_black ? shadow_note(picture.scene_setup) : "",
              picture.is_one_path_unasked ? one_path_note : "",
              picture.transport.light_radius && !has_points ? no_points_note : "", points_text(points_left),
              bounces_text(scene, picture)});
    say_what_is_missing(scene, picture.transport, is_below_own_sky(picture.scene));
  }
  return scene;
}

core::Scene load_scene_beside(const PictureOptions& picture, const std::vector<NamedFile>& outputs) {
  OpenedFiles opened;
  core::Scene scene = load_scene(picture, LoadNotes::said, &opened);
  check_not_read(opened, outputs);
  return scene;
}

}  // namespace dmpc::apps
