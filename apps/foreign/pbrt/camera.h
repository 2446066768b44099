// The camera and the film of a pbrt scene.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "apps/foreign/mesh/count_note.h"
#include "apps/foreign/mesh/transform.h"
#include "apps/foreign/pbrt/parameters.h"
#include "apps/formats/resolution.h"
#include "core/scene/scene.h"

namespace dmpc::apps::pbrt {

/// The conversion from radiance to film values.
struct Exposure {
  double factor = 1;
  std::array<core::Vec3d, 3> balance = Transform{}.rows;  ///< in linear sRGB, applied before the factor

  core::Vec3d of(const core::Vec3d& light) const;
};

struct Film {
  Resolution size{1280, 720};
  Exposure exposure;  ///< without the camera's shutter
};

/// Throws core::InputError for a film of pbrt-v3, and for more pixels than a picture may have.
Film film_of(const std::string& kind, const Parameters& parameters, Notes& notes);

struct Camera {
  double degrees = 90;      ///< field of view across the shorter side; 0 for cameras without perspective
  Transform from_world;     ///< to camera space: x right, y up, z ahead
  double open_seconds = 1;  ///< shutter time
};
/// Throws core::InputError if the map from the world is singular, or for an invalid angle.
Camera camera_of(const std::string& kind, const Parameters& parameters, const Transform& from_world, Notes& notes);

/// Returns whether the camera's world is left-handed, so that our camera would mirror the picture.
bool sees_left_handed(const Camera& camera);
/// Returns the view in world coordinates after transformation by `turn`. The picture has `size` pixels, or the film's resolution
/// if no size is given. Returns nothing for a camera without perspective.
std::optional<core::View> view_of(const Camera& camera, const Film& film, const std::optional<Resolution>& size,
                                  const Transform& turn);

}  // namespace dmpc::apps::pbrt
