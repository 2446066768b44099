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

/// The emission of shapes that follow an AreaLightSource statement.
struct AreaLight {
  core::Vec3d radiance;
  std::optional<double> power;  ///< of the whole shape; `radiance` is then relative to the power that a white light would need
  bool is_twosided = false;
};

/// Throws core::InputError for a kind that pbrt-v4 does not have. `exposure` is the film's conversion of radiance.
AreaLight area_light_of(const std::string& kind, const Parameters& parameters, const Exposure& exposure, Notes& notes);
/// Returns the shape's emitted radiance; `world` maps to world coordinates.
core::Vec3d radiance_of(const AreaLight& light, const PlacedShape& shape, const Transform& world);

/// Returns lights that replace an area light whose shape is invisible.
std::vector<FileLight> unseen_lights(const AreaLight& light, const PlacedShape& shape, const Transform& world);

/// Adds the light of a LightSource statement to the file's lights, background or skies. `world` maps light to world coordinates.
void add_light(const std::string& kind, const Parameters& parameters, const Tokens& tokens, const Transform& world,
               const Exposure& exposure, PlacedFile& file, Notes& notes);

}  // namespace dmpc::apps::pbrt
