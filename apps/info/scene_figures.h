// Statistics of a scene: objects, bounds, view, lights, materials, textures.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/box.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// "polygon", "patch", ...
const char* name_of(core::ObjectKind kind);

/// Number of materials, and how many of them mirror, transmit, or have a texture. A material may be several of these, or none.
struct MaterialCounts {
  std::uint64_t count = 0, mirroring = 0, transmitting = 0, textured = 0;
};

/// A texture as stored in its records.
struct TextureFigures {
  std::string name;
  std::uint32_t width = 1, height = 1, levels = 1;
  core::TexelFormat format{};
  std::uint64_t tiles = 0, tile_bytes = 0;
  std::uint64_t entries = 0, table_bytes = 0;  ///< table of tiles
};
/// "srgb", "srgb of 10 bits", "srgb with alpha" or "shared exponent".
const char* name_of(core::TexelFormat format);

/// Meshes of a scene with several instances (core/scene/base_meshes.h).
struct MeshFigures {
  std::uint64_t count = 0, places = 0;
  std::uint64_t triangles = 0, triangles_in_places = 0;  ///< with each mesh once; over all instances
  double stored_share = 1;  ///< share of the scene's corners that is stored with each mesh once (core/scene/base_meshes.h)
};

struct SceneFigures {
  std::string name;
  std::array<std::uint64_t, core::object_kind_count> objects{};  ///< by core::ObjectKind
  core::Box bounds;  ///< bounds of finite objects, in the world; empty if there are none
  core::View view;
  core::Vec3d background;
  std::vector<core::PointLight> lights;  ///< with their effective colours
  MeshFigures meshes;
  MaterialCounts materials;
  std::vector<TextureFigures> textures;
};

SceneFigures figures_of(const core::Scene& scene);

}  // namespace dmpc::apps
