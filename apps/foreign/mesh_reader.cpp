#include "apps/foreign/mesh_reader.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "apps/edge/line/number_text.h"
#include "apps/foreign/import.h"
#include "apps/foreign/mesh/count_note.h"
#include "apps/foreign/mesh/features.h"
#include "apps/foreign/mesh/geometry.h"
#include "apps/foreign/mesh/lights.h"
#include "apps/foreign/mesh/material.h"
#include "apps/foreign/mesh/placed_mesh.h"
#include "apps/foreign/mesh/placement.h"
#include "apps/foreign/mesh/skin.h"
#include "apps/foreign/mesh/textures.h"
#include "apps/foreign/mesh/without_area.h"
#include "apps/foreign/pbrt/reader.h"
#include "apps/foreign/placed_scene.h"
#include "apps/foreign/polygon_formats.h"
#include "apps/formats/whole_view.h"
#include "core/base/expect.h"
#include "core/base/forget.h"
#include "core/scene/kept_meshes.h"

namespace dmpc::apps {
namespace {

using Placements = std::vector<Placement>;

/// Assimp's and glTF's numbers are floats.
constexpr double float_rounding = 0x1p-25;

/// Which materials some placed mesh has.
std::vector<bool> used_materials(const aiScene& file, const Placements& placements) {
  std::vector<bool> used(file.mNumMaterials);
  for (const Placement& placement : placements) {
    const unsigned material = file.mMeshes[placement.mesh]->mMaterialIndex;
    if (material < used.size()) {
      used[material] = true;
    }
  }
  return used;
}

/// Gives a material its texture of metal and roughness; returns whether that is shown by its mean, as it lies elsewhere than that
/// of the colour, `color`, or there is none.
bool add_facets(const MaterialTextures& known, const std::optional<TextureUse>& color, TextureReader& textures,
                core::Material& material) {
  const auto texture = known.facets && material.microfacets.are_there() ? textures.find_numbers(*known.facets) : std::nullopt;
  if (!texture) {
    return false;
  }
  const bool lies_there = material.texture != core::Material::no_texture && color->coordinates == known.facets->coordinates &&
                          known.color_place == known.facets_place;
  material.microfacets.texture = *texture;
  material.microfacets.use = lies_there ? core::FacetTexture::placed : core::FacetTexture::mean;
  return !lies_there;
}

/// Tells what of textures was not to be had, or was had from elsewhere, or is multiplied by nothing: `black`.
void note_textures(const TextureReader& textures, std::uint64_t black, MeshScene& result, std::vector<std::string>& missing) {
  for (const std::string& texture : textures.missing()) {
    missing.push_back(texture);
  }
  note_other_names(textures.other_names(), result.notes);
  note_count(result.notes, "materials that are black, so that nothing of their texture shows", black);
}

/// With the textures of those that are used, which the scene is given; what cannot be had is added to `missing`.
std::vector<MeshMaterial> materials_of(const ImportedFile& imported, const Placements& placements, SceneFiles& files,
                                       MeshScene& result, std::vector<std::string>& missing) {
  const aiScene& file = *imported.scene;
  TextureReader textures(&file, result.scene.name, files, result.scene.textures);
  const std::vector<bool> used = used_materials(file, placements);
  std::uint64_t black = 0, means = 0;
  std::vector<MeshMaterial> materials;
  for (std::size_t i = 0; i < file.mNumMaterials; ++i) {
    MeshMaterial material{.material = material_of(*file.mMaterials[i]), .is_cut_away = is_cut_away(*file.mMaterials[i])};
    const bool is_shown = used[i] && !material.is_cut_away;
    const MaterialTextures known = i < imported.textures.size() ? imported.textures[i] : MaterialTextures{};
    auto use = is_shown ? colour_texture(*file.mMaterials[i]) : std::nullopt;
    if (use) {
      use->edges.alpha = material.material.alpha != core::AlphaUse::none ? TextureAlpha::kept
                         : says_what_alpha_does(*file.mMaterials[i])     ? TextureAlpha::ignored
                                                                         : TextureAlpha::said;
      use->edges.cutoff = material.material.alpha == core::AlphaUse::cut ? material.material.alpha_cutoff : 0;
    }
    if (const auto texture = use ? textures.find(*use) : std::nullopt) {
      material.material.texture = *texture;
      black += material.material.color == core::Vec3d{} ? 1 : 0;
      material.coordinates = use->coordinates;
      material.place = known.color_place;
    }
    means += is_shown && add_facets(known, use, textures, material.material) ? 1 : 0;
    materials.push_back(material);
  }
  note_textures(textures, black, result, missing);
  note_count(
      result.notes,
      "materials whose texture of metal and roughness is shown by its mean, as it does not lie where that of their colour does",
      means);
  return materials;
}

/// The same of a file that a reader of our own has read.
std::vector<core::Material> materials_of(const PolygonFile& file, SceneFiles& files, MeshScene& result,
                                         std::vector<std::string>& missing) {
  TextureReader textures(nullptr, result.scene.name, files, result.scene.textures);
  std::vector<bool> used(file.materials.size());
  for (const PolygonMesh& mesh : file.meshes) {
    used[mesh.material] = true;
  }
  std::uint64_t black = 0;
  std::vector<core::Material> materials;
  for (std::size_t i = 0; i < used.size(); ++i) {
    core::Material material = file.materials[i].material;
    auto use = file.materials[i].texture;
    if (use) {
      use->edges.alpha = TextureAlpha::said;
    }
    material.texture = used[i] && use ? textures.find(*use).value_or(core::Material::no_texture) : core::Material::no_texture;
    black += material.texture != core::Material::no_texture && material.color == core::Vec3d{} ? 1 : 0;
    materials.push_back(material);
  }
  note_textures(textures, black, result, missing);
  return materials;
}

/// In how many places each mesh stands.
std::vector<std::size_t> count_uses(const aiScene& file, const Placements& placements) {
  std::vector<std::size_t> uses(file.mNumMeshes);
  for (const Placement& placement : placements) {
    ++uses[placement.mesh];
  }
  return uses;
}

/// What placed meshes become, each of them once, in all its places, and as often as the scene has it.
struct PlacedSize {
  GeometrySize once, all, made;
};

/// Says what copies cost.
PlacedSize measure(ImportedFile& file, const Placements& placements, core::Copies copies, std::vector<std::string>& notes) {
  std::vector<GeometrySize> sizes(file.scene->mNumMeshes);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    sizes[i] = size_of(*file.scene->mMeshes[i]);
    sizes[i] += size_of(file.triangles_of(i));
  }
  const std::vector<std::size_t> uses = count_uses(*file.scene, placements);
  std::set<std::size_t> placed;
  PlacedSize size;
  auto& [once, all, made] = size;
  for (const Placement& placement : placements) {
    const GeometrySize& mesh = sizes[placement.mesh];
    const bool is_first = placed.insert(placement.mesh).second;
    const bool is_left_out =
        copies == core::Copies::left_out && uses[placement.mesh] > 1 && mesh.triangles > core::copied_triangles_max;
    all += mesh;
    once += is_first ? mesh : GeometrySize{};
    made += is_first || !is_left_out ? mesh : GeometrySize{};
  }
  if (placed.size() < placements.size() && copies == core::Copies::put) {
    notes.push_back(grouped(placed.size()) + (placed.size() == 1 ? " mesh stands in " : " meshes stand in ") +
                    grouped(placements.size()) + " places: " + grouped(once.triangles) + " triangles become " +
                    grouped(all.triangles));
  }
  return size;
}

/// Frees a mesh that nobody needs any more, long before the file's others.
void forget(aiScene& file, std::size_t mesh) {
  delete file.mMeshes[mesh];
  file.mMeshes[mesh] = nullptr;
}

/// Throws if nothing has an area; says what does not show.
void judge(const GeometryWriter& writer, std::vector<std::string>& notes) {
  if (!writer.has_area()) {
    refuse_without_area("there is no triangle in it that has an area", notes);
  }
  note_count(notes, "meshes whose texture is not shown, since no corner has a place on it", writer.unplaced());
  note_count(notes, "meshes that let all light through, so that nothing of them is seen", writer.unseen());
  note_count(notes, "meshes whose vertex colours are not used, since there is a texture", writer.meshes_without_colors());
}

const MeshMaterial& material_for(const aiMesh& mesh, std::size_t index, const std::vector<MeshMaterial>& materials) {
  if (mesh.mMaterialIndex >= materials.size()) {
    throw core::InputError(name_of(mesh, index) + " has material " + std::to_string(mesh.mMaterialIndex) +
                           ", and there are but " + std::to_string(materials.size()));
  }
  return materials[mesh.mMaterialIndex];
}

/// Places the meshes of a file, each of which is freed after its last place, or as soon as it is shared by several.
class PlacedMeshes {
 public:
  PlacedMeshes(ImportedFile& file, const Placements& placements, const std::vector<MeshMaterial>& materials,
               GeometryWriter& writer)
      : file_(file), materials_(materials), writer_(writer), uses_left_(count_uses(*file.scene, placements)) {}

  void place(const Placement& placement, bool may_share) {
    const bool is_last = --uses_left_[placement.mesh] == 0;
    if (const auto shared = shared_.find(placement.mesh); shared != shared_.end()) {
      put(shared->second, placement.world);
      return;
    }
    const MeshMaterial& material = material_for(*file_.scene->mMeshes[placement.mesh], placement.mesh, materials_);
    if (material.is_cut_away) {
      writer_.leave_out();
    } else if (may_share && !is_last) {
      const auto shared = writer_.add_shared(take(placement.mesh, {}, material, true), material.material);
      shared_.emplace(placement.mesh, shared);
      put(shared, placement.world);
    } else {
      writer_.add(take(placement.mesh, placement.world, material, is_last), material.material);
    }
    if (is_last || shared_.contains(placement.mesh)) {
      forget(*file_.scene, placement.mesh);
    }
  }

 private:
  void put(const std::optional<std::uint32_t>& shared, const Transform& world) {
    if (shared) {
      writer_.place(*shared, world);
    }
  }

  PolygonMesh take(std::size_t mesh, const Transform& world, const MeshMaterial& material, bool is_last) {
    FaceList triangles = is_last ? std::move(file_.triangles_of(mesh)) : file_.triangles_of(mesh);
    return placed_mesh(*file_.scene->mMeshes[mesh], mesh, std::move(triangles), world, material);
  }

  ImportedFile& file_;
  const std::vector<MeshMaterial>& materials_;
  GeometryWriter& writer_;
  std::vector<std::size_t> uses_left_;
  std::map<std::size_t, std::optional<std::uint32_t>> shared_;  ///< nothing of a mesh without faces
};

void add_geometry(MeshScene& result, ImportedFile& imported, const Placements& placements,
                  const std::vector<MeshMaterial>& materials, const MeshOptions& options) {
  GeometryWriter writer(result.scene, result.vertices, options.smooth_degrees);
  PlacedMeshes meshes(imported, placements, materials, writer);
  for (const Placement& placement : placements) {
    meshes.place(placement, !options.smooth_degrees);
  }
  judge(writer, result.notes);
  result.instances = writer.instances();
}

/// Takes the meshes of a file that a reader of our own has read, and frees each at once.
void add_geometry(MeshScene& result, std::vector<PolygonMesh> meshes, const std::vector<core::Material>& materials,
                  const MeshOptions& options) {
  GeometryWriter writer(result.scene, result.vertices, options.smooth_degrees);
  const double scale = options.scale.value_or(1);
  for (PolygonMesh& mesh : meshes) {
    for (core::Vec3d& vertex : mesh.vertices) {
      vertex = vertex * scale;
    }
    const core::Material& material = materials[mesh.material];
    writer.add(std::exchange(mesh, {}), material);
  }
  judge(writer, result.notes);
}

std::string text_of(const core::Vec3d& point) { return shortest(point.x) + "," + shortest(point.y) + "," + shortest(point.z); }

/// The whole in view; says how, to the last bit, as a start for a camera of one's own.
core::View plain_view(const BoundingSphere& bounds, const UpAxis& up, const MeshOptions& options,
                      std::vector<std::string>& notes) {
  const core::View view = whole_view(bounds, up);
  if (options.is_seen_otherwise) {
    return view;
  }
  notes.push_back("the whole is in view, as by --camera=" + text_of(view.from) + "/" + text_of(view.at) + "/" + text_of(view.up));
  return view;
}

/// By a sky, or, by paths, by what shines in it: other transports show that, but not what it lights.
bool is_lit_without_lights(const core::Scene& scene, const MeshOptions& options) {
  return options.is_below_sky || (options.is_by_paths && std::ranges::any_of(scene.materials, &core::Material::shines));
}

/// A film goes on as it began: whoever was seen by the file's camera at first is not to be seen by another one later on.
void check_still_seen(const StillScene& still, const UpAxis& up) {
  if (still.view.from != whole_view(still.bounds, up).from) {
    throw core::InputError(
        "the animation takes the camera beyond 1e30, or presses it flat, so that it sees nothing: show other frames, or give a "
        "camera by --camera or --camera-path");
  }
}

/// `file` may have cameras and lights, if it is there.
void add_surroundings(MeshScene& result, const aiScene* file, const MeshOptions& options) {
  core::Scene& scene = result.scene;
  std::vector<std::string>& notes = result.notes;
  const double scale = options.scale.value_or(1);
  result.bounds = sphere_around(result.vertices, scene.objects, result.instances);
  const StillScene* const still = options.animation && options.animation->still ? &*options.animation->still : nullptr;
  const BoundingSphere bounds = still != nullptr ? still->bounds : result.bounds;
  scene.background = plain_background;
  // What is said of a view or of lights that others are put in place of would be untrue.
  std::vector<std::string> unsaid;
  const bool has_camera = file != nullptr && !options.is_seen_otherwise;
  const auto camera = has_camera ? camera_of(*file, options.size, scale, notes) : std::nullopt;
  const UpAxis up = options.up.value_or(UpAxis{});
  if (still != nullptr && has_camera && !camera) {
    check_still_seen(*still, up);
  }
  scene.view = camera ? *camera : plain_view(bounds, up, options, notes);
  scene.zenith = axes_of(up).up;
  const bool is_lit_else = is_lit_without_lights(scene, options);
  if (file != nullptr) {
    scene.lights = lights_of(*file, bounds, scale, is_lit_else, options.is_lit_otherwise ? unsaid : notes);
  }
  if (scene.lights.empty() && !is_lit_else) {
    scene.lights = plain_lights(bounds, still != nullptr && camera ? still->view : scene.view);
  }
}

/// What nobody shows need not be there, nor be decoded.
void leave_out_facets(std::vector<MaterialTextures>& textures) {
  for (MaterialTextures& of_material : textures) {
    of_material.facets.reset();
  }
}

/// What Assimp's types hold: nodes place meshes.
MeshScene scene_of(ImportedFile file, const std::string& path, const MeshOptions& options, SceneFiles& files) {
  MeshScene result{.scene = {.name = path, .coordinate_rounding = float_rounding}, .notes = {}};
  pose_skins(file, result.notes);
  if (!options.is_by_paths) {
    leave_out_facets(file.textures);
  }
  std::vector<std::string> missing = file.missing;
  const Placements placements = find_placements(*file.scene, file.instances, options.scale.value_or(1));
  const PlacedSize size = measure(file, placements, options.copies, result.notes);
  check_size(size.made);
  result.scene.objects.reserve(options.smooth_degrees ? size.all.faces : size.once.faces);
  note_features(*file.scene, placements, result.notes);
  result.notes.insert(result.notes.end(), file.notes.begin(), file.notes.end());
  const std::vector<MeshMaterial> materials = materials_of(file, placements, files, result, missing);
  judge_missing(missing, options, result.notes);
  add_geometry(result, file, placements, materials, options);
  add_surroundings(result, file.scene.get(), options);
  return result;
}

/// What a reader of our own has read stands where it is.
MeshScene scene_of(PolygonFile file, const std::string& path, const MeshOptions& options, SceneFiles& files) {
  MeshScene result{.scene = {.name = path, .coordinate_rounding = file.coordinate_rounding}, .notes = std::move(file.notes)};
  std::vector<std::string> missing = std::move(file.missing);
  GeometrySize size;
  for (const PolygonMesh& mesh : file.meshes) {
    size += size_of(mesh.faces);
  }
  check_size(size);
  result.scene.objects.reserve(size.faces);
  const std::vector<core::Material> materials = materials_of(file, files, result, missing);
  judge_missing(missing, options, result.notes);
  add_geometry(result, std::move(file.meshes), materials, options);
  add_surroundings(result, nullptr, options);
  return result;
}

MeshScene read(const std::string& path, const MeshOptions& options, SceneFiles& files) {
  if (pbrt::is_pbrt_path(path)) {
    return placed_scene(pbrt::read_pbrt(path, options.size, files, options.copies), path, options, files);
  }
  if (auto file = read_polygon_file(path, files)) {
    return scene_of(*std::move(file), path, options, files);
  }
  return scene_of(import_gltf(path, files, options.animation, options.copies), path, options, files);
}

}  // namespace

void note_other_names(const std::vector<std::string>& names, std::vector<std::string>& notes) {
  constexpr std::size_t shown = 4;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), shown); ++i) {
    list += (i > 0 ? ", " : "") + names[i];
  }
  if (!names.empty()) {
    notes.push_back(grouped(names.size()) + (names.size() == 1 ? " texture was" : " textures were") +
                    " found under other names: " + list +
                    (names.size() > shown ? " and " + grouped(names.size() - shown) + " more" : ""));
  }
}

/// A picture without them would be another, so that has to be asked for.
void judge_missing(const std::vector<std::string>& missing, const MeshOptions& options, std::vector<std::string>& notes) {
  std::string list;
  for (const std::string& one : missing) {
    list += "\n  " + one;
    notes.push_back(one + "; what it covers has its plain colour");
  }
  if (!missing.empty() && !options.allows_missing) {
    throw core::InputError("what it refers to cannot be had:" + list +
                           "\nPut these files where they are looked for, or show what they cover in its plain colour by " +
                           "--missing=plain");
  }
}

MeshScene read_mesh(const std::string& path, const MeshOptions& options, SceneFiles& files) {
  MeshScene mesh = read(path, options, files);
  core::give_back_freed();  // Assimp's faces are many small pieces
  return mesh;
}

}  // namespace dmpc::apps
