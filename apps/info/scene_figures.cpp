#include "apps/info/scene_figures.h"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "core/base/ranges.h"
#include "core/database/conversion.h"
#include "core/database/parallel.h"
#include "core/record/texture_layout.h"
#include "core/scene/base_meshes.h"
#include "core/scene/placed_objects.h"
#include "core/scene/stored_objects.h"

namespace dmpc::apps {

namespace {

using ObjectCounts = std::array<std::uint64_t, core::object_kind_count>;

ObjectCounts count_own(const core::Scene& scene) {
  ObjectCounts counts{};
  for (const core::Object& object : scene.objects) {
    ++counts[static_cast<std::size_t>(object.kind)];
  }
  return counts;
}

/// Counts all copies of base meshes, whether the scene stores them or not.
ObjectCounts count_objects(const core::Scene& scene) {
  if (scene.stored != nullptr) {
    return scene.stored->objects;
  }
  ObjectCounts counts = count_own(scene);
  if (leaves_copies_out(scene)) {
    std::vector<ObjectCounts> of_meshes;
    std::transform(scene.kept->meshes.begin(), scene.kept->meshes.end(), std::back_inserter(of_meshes), count_own);
    for (const core::BaseMeshInstance& place : scene.kept->places) {
      for (std::size_t kind = 0; kind < counts.size(); ++kind) {
        counts[kind] += place.has_copy ? 0 : of_meshes[place.mesh][kind];
      }
    }
  }
  return counts;
}

std::uint64_t triangle_count(const core::Scene& mesh) {
  return core::sum_over<std::uint64_t>(mesh.objects,
                                       [&](const core::Object& object) { return object.vertex_count - std::uint64_t{2}; });
}

MeshFigures count_meshes(const core::Scene& scene) {
  const core::InstancingShare share = core::instancing_share(scene);
  MeshFigures figures{.places = share.places};
  if (share.places > 0) {
    figures.stored_share = static_cast<double>(share.stored) / static_cast<double>(share.seen);
  }
  if (scene.stored != nullptr) {
    figures.count = scene.stored->meshes;
    figures.triangles = scene.stored->mesh_triangles;
    figures.triangles_in_places = scene.stored->triangles_in_places;
  } else if (share.places > 0) {
    std::vector<std::uint64_t> triangles;
    std::transform(scene.kept->meshes.begin(), scene.kept->meshes.end(), std::back_inserter(triangles), triangle_count);
    figures.count = triangles.size();
    figures.triangles = std::accumulate(triangles.begin(), triangles.end(), std::uint64_t{0});
    for (const core::BaseMeshInstance& place : scene.kept->places) {
      figures.triangles_in_places += triangles[place.mesh];
    }
  }
  return figures;
}

MaterialCounts count_materials(const core::Scene& scene) {
  MaterialCounts counts{.count = scene.materials.size()};
  for (const core::Material& material : scene.materials) {
    counts.mirroring += material.specular_max() * material.mirror > 0 ? 1 : 0;
    counts.transmitting += material.lets_through() ? 1 : 0;
    counts.textured += material.texture != core::Material::no_texture ? 1 : 0;
  }
  return counts;
}

TextureFigures figures_of(const core::Texture& texture) {
  const core::TextureLevel& finest = texture.levels.front();
  const core::TextureReference reference{.width = static_cast<std::uint16_t>(finest.width),
                                         .height = static_cast<std::uint16_t>(finest.height),
                                         .level_count = static_cast<std::uint8_t>(texture.levels.size())};
  const std::uint64_t tiles = core::tile_count(reference), entries = core::tile_entry_count(reference);
  return {.name = texture.name,
          .width = finest.width,
          .height = finest.height,
          .levels = reference.level_count,
          .format = texture.format,
          .tiles = tiles,
          .tile_bytes = tiles * sizeof(core::TextureTile),
          .entries = entries,
          .table_bytes = entries * sizeof(core::Address)};
}

}  // namespace

const char* name_of(core::ObjectKind kind) {
  constexpr std::array<const char*, core::object_kind_count> names = {"polygon", "patch", "textured", "sphere", "cone"};
  return names[static_cast<std::size_t>(kind)];
}

const char* name_of(core::TexelFormat format) {
  switch (format) {
    case core::TexelFormat::srgb:
      return "srgb";
    case core::TexelFormat::fine_srgb:
      return "srgb of 10 bits";
    case core::TexelFormat::srgb_alpha:
      return "srgb with alpha";
    case core::TexelFormat::linear:
      return "linear";
    case core::TexelFormat::shared_exponent:
      break;
  }
  return "shared exponent";
}

SceneFigures figures_of(const core::Scene& scene) {
  SceneFigures figures{.name = scene.name,
                       .objects = count_objects(scene),
                       .bounds = core::bounds_of(scene, core::Parallel(0)),
                       .view = scene.view,
                       .background = scene.background,
                       .meshes = count_meshes(scene),
                       .materials = count_materials(scene)};
  for (const core::PointLight& light : scene.lights) {
    figures.lights.push_back(light);
    figures.lights.back().color = core::intensity_of(light, scene);
    figures.lights.back().has_color = true;
  }
  for (const core::Texture& texture : scene.textures) {
    figures.textures.push_back(figures_of(texture));
  }
  return figures;
}

}  // namespace dmpc::apps
