// A scene without its objects and texels, which its database has, in parts that can be stored.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "core/scene/scene.h"
#include "core/scene/stored_objects.h"

namespace dmpc::apps {

/// A texture without its texels.
struct StoredTexture {
  core::TexelFormat format{};
  core::TextureWrap wrap_s{}, wrap_t{};
  double brightest = 0;
  core::Color darkest;
  std::uint32_t width = 1, height = 1;
};

/// What is left of a scene that has become a database, with Scene::stored.
struct StoredScene {
  /// Everything of one size.
  struct Summary {
    core::View view;
    core::Vec3d background, ambient, zenith;
    double coordinate_rounding = 0, sky_scale = 1, sky_brightest = 0;
    std::uint64_t sky_coarse = 0;
    std::uint32_t sky_width = 0, sky_height = 0;
    std::int32_t bounces = -1;  ///< below 0: the scene does not say
    core::StoredCounts objects;
  };
  static_assert(std::is_trivially_copyable_v<Summary>);

  Summary summary;
  std::vector<core::PointLight> lights;
  std::vector<core::Material> materials;
  std::vector<StoredTexture> textures;
  std::vector<std::string> names;               ///< the scene's, its sky's, and the textures'
  std::map<std::string, std::string> identity;  ///< core::StoredObjects::identity

  static StoredScene of(const core::Scene& scene);
  /// Throws core::InputError for a view that shows nothing, an index of nothing, or another number out of its range.
  core::Scene scene() const;
};

}  // namespace dmpc::apps
