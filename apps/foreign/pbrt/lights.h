// Lights of a pbrt scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/foreign/mesh/count_note.h"
#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/pbrt/camera.h"
#include "apps/foreign/pbrt/parameters.h"

namespace dmpc::apps::pbrt {

/// What shapes shine with that follow an AreaLightSource statement.
struct AreaLight {
  core::Vec3d radiance;
  std::optional<double> power;  ///< the whole shape's; `radiance` is then relative to the power that a white light would need
  bool is_twosided = false;
};

/// Throws core::InputError for a kind that pbrt-v4 does not have. `exposure` is what the film makes of all light.
AreaLight area_light_of(const std::string& kind, const Parameters& parameters, const Exposure& exposure, Notes& notes);
/// What the shape shines with, in these coordinates of the world.
core::Vec3d radiance_of(const AreaLight& light, const PlacedShape& shape, const Transform& world);

/// What lights as an area light does of which nothing is to be seen.
std::vector<FileLight> unseen_lights(const AreaLight& light, const PlacedShape& shape, const Transform& world);

/// Adds what a LightSource statement says to the file's lights, background or skies. `world` is from its coordinates.
void add_light(const std::string& kind, const Parameters& parameters, const Tokens& tokens, const Transform& world,
               const Exposure& exposure, PlacedFile& file, Notes& notes);

}  // namespace dmpc::apps::pbrt
