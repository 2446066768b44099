// The camera of a pbrt scene, and the film's pixels.
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

/// What a film makes of light.
struct Exposure {
  double factor = 1;
  std::array<core::Vec3d, 3> balance = Transform{}.rows;  ///< in linear sRGB, before the factor

  core::Vec3d of(const core::Vec3d& light) const;
};

struct Film {
  Resolution size{1280, 720};
  Exposure exposure;  ///< without the camera's shutter
};

/// Throws core::InputError for a film of pbrt-v3, and for more pixels than a picture may have.
Film film_of(const std::string& kind, const Parameters& parameters, Notes& notes);

struct Camera {
  double degrees = 90;      ///< field of view of the shorter side, from edge to edge; 0 without perspective
  Transform from_world;     ///< to where x is right, y up and z ahead
  double open_seconds = 1;  ///< its shutter
};
/// Throws core::InputError if the world is pressed flat before it, or for an angle that none has.
Camera camera_of(const std::string& kind, const Parameters& parameters, const Transform& from_world, Notes& notes);

/// Whether its world is left-handed, so that a camera of ours shows it the wrong way round.
bool sees_left_handed(const Camera& camera);
/// In the coordinates of the world, first turned by `turn`. Over a picture of `size` pixels, the film's if none is given; nothing
/// for a camera without perspective.
std::optional<core::View> view_of(const Camera& camera, const Film& film, const std::optional<Resolution>& size,
                                  const Transform& turn);

}  // namespace dmpc::apps::pbrt
