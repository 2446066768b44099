#include "apps/formats/landscape/scene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/formats/bounding_sphere.h"
#include "apps/formats/landscape/grove.h"
#include "apps/formats/landscape/names.h"
#include "apps/formats/landscape/paint.h"
#include "apps/formats/reading_memory.h"
#include "apps/formats/whole_view.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/available_memory.h"
#include "core/base/expect.h"
#include "core/database/parallel.h"
#include "core/scene/texel.h"
#include "core/scene/texture.h"

namespace dmpc::apps {
namespace {

using core::Material;
using core::Vec3d;

/// Numbers of meshes and places are floats.
constexpr double float_rounding = 0x1p-25;
constexpr BoundingSphere around{{0, 0.2, 0}, 1.15};

Vec3d vec(const LandscapeMesh::Point& point) { return {double{point[0]}, double{point[1]}, double{point[2]}}; }

/// That scatters light, to all sides alike.
Material rough(const Vec3d& color) { return {.color = color, .microfacets = {.roughness = 1}}; }

core::Texture ground_texture(int side, const RowsDone& rows_done) {
  const Image picture = ground_picture(side, rows_done);
  const auto width = static_cast<std::uint32_t>(side);
  core::Texture texture{.name = "ground",
                        .format = core::TexelFormat::srgb,
                        .wrap_s = core::TextureWrap::clamp,
                        .wrap_t = core::TextureWrap::clamp,
                        .levels = {{width, width, {}}}};
  std::vector<std::uint32_t>& texels = texture.levels.front().texels;
  texels.resize(std::size_t{width} * width);
  core::Parallel(0).for_each(width, [&](std::size_t row) {
    for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
      const float* const rgb = &picture.rgb[3 * i];
      texels[i] = core::encoded(texture.format, {double{rgb[0]}, double{rgb[1]}, double{rgb[2]}});
    }
  });
  core::add_levels(texture);
  return texture;
}

/// Adds the triangles of meshes.
class TriangleAdder {
 public:
  explicit TriangleAdder(core::Scene& scene) : builder_(scene) {}

  /// Textured where the material is.
  void add(const LandscapeMesh& mesh, const Material& material) {
    builder_.material(material);
    const bool is_textured = material.texture != Material::no_texture;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = mesh.indices[i + k];
        vertices_[k] = vec(mesh.positions[vertex]);
        normals_[k] = vec(mesh.normals[vertex]);
        corners_[k] = {normals_[k], is_textured ? mesh.places[vertex] : std::array<float, 2>{}};
      }
      is_textured ? builder_.textured(vertices_, corners_) : builder_.patch(vertices_, normals_);
    }
  }

 private:
  core::SceneBuilder builder_;
  std::vector<Vec3d> vertices_ = std::vector<Vec3d>(3), normals_ = std::vector<Vec3d>(3);
  std::vector<core::TexturedCorner> corners_ = std::vector<core::TexturedCorner>(3);
};

/// As glTF has it: stretched, then turned about y, then moved.
core::Transform tree_place(const TreePlaces& places, std::size_t i) {
  const double half_sine = double{places.rotations[i][1]}, half_cosine = double{places.rotations[i][3]};
  const double cosine = 1 - 2 * half_sine * half_sine, sine = 2 * half_sine * half_cosine, size = double{places.scales[i][1]};
  return {.rows = {{{cosine * size, 0, sine * size}, {0, size, 0}, {-sine * size, 0, cosine * size}}},
          .shift = vec(places.translations[i])};
}

/// The kinds of trees that stand somewhere, as meshes, and behind all of them their places.
core::Instances add_trees(const Grove& grove, core::Scene& scene) {
  static constexpr std::array<Vec3d, tree_kinds> greens{Vec3d{0.05, 0.14, 0.06}, Vec3d{0.16, 0.27, 0.05}, Vec3d{0.04, 0.1, 0.07},
                                                        Vec3d{0.24, 0.28, 0.06}};
  core::Instances instances;
  for (std::size_t kind = 0; kind < tree_kinds; ++kind) {
    const TreePlaces& places = grove.places[kind];
    if (places.translations.empty()) {
      continue;
    }
    const auto first = static_cast<std::uint32_t>(scene.objects.size());
    TriangleAdder adder(scene);
    adder.add(grove.trees[kind].bark, rough({0.2, 0.13, 0.08}));
    adder.add(grove.trees[kind].leaves, rough(greens[kind]));
    for (std::size_t i = 0; i < places.translations.size(); ++i) {
      instances.places.push_back({tree_place(places, i), static_cast<std::uint32_t>(instances.meshes.size()), 0});
    }
    instances.meshes.push_back({first, static_cast<std::uint32_t>(scene.objects.size())});
  }
  for (core::Instance& tree : instances.places) {
    tree.before = static_cast<std::uint32_t>(scene.objects.size());
  }
  return instances;
}

void check_room(const core::Scene& scene, const core::Instances& instances, core::Copies copies) {
  const core::ExpandedSize size = core::settled_size(scene, instances, copies);
  check_database(size.objects);
  if (const std::uint64_t room = reader_memory_bytes_max(); size.bytes() > room) {
    throw core::CapacityError(
        "with every tree it takes " + bytes_text(size.bytes()) + " of memory, and there are " + bytes_text(room) +
        " for it: take a smaller size" +
        (copies == core::Copies::put ? ", or have dmpc render keep each kind of tree once (--instances=keep)" : ""));
  }
}

/// Flat, and so without normals.
void add_lake(core::Scene& scene) {
  const LandscapeMesh lake = lake_mesh();
  core::SceneBuilder builder(scene);
  builder.material({.color = {0.25, 0.4, 0.5},
                    .diffuse = 0,
                    .shine = 10'000,
                    .tinted_specular = 1,
                    .microfacets = {.roughness = 0, .metallic = 1}});
  for (std::size_t i = 0; i < lake.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return vec(lake.positions[lake.indices[i + k]]); };
    builder.polygon({corner(0), corner(1), corner(2)});
  }
}

void add_ground(core::Scene& scene, int size, const RowsDone& rows_done) {
  TriangleAdder adder(scene);
  adder.add(ground_mesh(size, rows_done), {.color = {1, 1, 1}, .texture = 0, .microfacets = {.roughness = 1}});
  add_lake(scene);
}

}  // namespace

bool is_landscape_name(std::string_view name) { return landscape_size(name) || grove_size(name); }

core::Scene landscape_scene(std::string_view name, core::Copies copies, const RowsDone& rows_done) {
  const auto trees = grove_size(name);
  const int size = trees ? ground_size(*trees) : landscape_size(name).value();
  core::Scene scene{.name = std::string(name), .coordinate_rounding = float_rounding};
  scene.view = {.from = {-0.12, 0.11, 0.52}, .at = {-0.02, 0.12, 0}, .up = {0, 1, 0}, .angle_degrees = 45.8};
  scene.background = plain_background;
  scene.lights = plain_lights(around, scene.view);
  scene.textures.emplace_back();
  core::Instances instances;
  if (trees) {
    instances = add_trees(grove(*trees), scene);
    try {
      check_room(scene, instances, copies);
    } catch (const core::CapacityError& error) {
      throw core::CapacityError(scene.name + ": " + error.what());
    }
  }
  add_ground(scene, size, rows_done);
  scene.textures.front() = ground_texture(ground_picture_side(size), rows_done);
  core::settle(scene, instances, copies);
  return scene;
}

}  // namespace dmpc::apps
