// Builds an accepted scene and renders it in a few pixels: this may fail for lack of memory only.
#pragma once

#include <cmath>
#include <cstddef>

#include "core/base/expect.h"
#include "core/database/database.h"
#include "core/picture/camera/camera.h"
#include "core/picture/render.h"
#include "core/scene/scene.h"

namespace dmpc::tests {

/// The invariants of every scene from a file's reader.
inline void check_scene(const core::Scene& scene) {
  using core::expect;
  for (const core::Object& object : scene.objects) {
    if (object.kind == core::ObjectKind::sphere) {
      expect(object.first < scene.spheres.size() && object.material < scene.materials.size(), "a sphere is there");
      continue;
    }
    expect(object.kind <= core::ObjectKind::textured && object.material < scene.materials.size(), "an object is one");
    expect(object.first + std::uint64_t{object.vertex_count} <= scene.vertices.size(), "an object's vertices are there");
  }
  for (const core::Vec3d& vertex : scene.vertices) {
    expect(is_finite(vertex), "every vertex is somewhere");
  }
}

/// In as few pixels as there may be.
inline void render_tiny(const core::Scene& scene) {
  constexpr int picture_side = 4, depth_max = 4;
  const core::Database database = core::build_database(scene, {});
  core::LocalRecords records(database.bytes());
  core::GridTracer tracer(records, database.header(), {});
  const core::Camera camera(scene.view, database.header().frame, picture_side, picture_side, 1);
  core::Operations operations;
  const core::Film film = core::render(tracer, {database.header(), camera, {.depth_max = depth_max}}, operations);
  core::expect(film.pixel_count() == picture_side * picture_side, "every pixel is there");
}

/// Scenes with more lights or objects make an input slow and find nothing new.
inline void render_small(const core::Scene& scene) {
  constexpr std::size_t lights_max = 16, objects_max = 200;
  if (scene.lights.size() > lights_max || scene.objects.size() > objects_max) {
    return;
  }
  try {
    render_tiny(scene);
  } catch (const core::InputError&) {  // a scene without room, or too large to be reckoned with
  }
}

/// Both, with small textures in place of its own.
inline void check_textured(core::Scene& scene) {
  check_scene(scene);
  for (core::Texture& texture : scene.textures) {
    texture.levels = {{2, 2, {0x102030, 0xffffff, 0, 0x808080}}};
    core::add_levels(texture);
  }
  render_small(scene);
}

}  // namespace dmpc::tests
