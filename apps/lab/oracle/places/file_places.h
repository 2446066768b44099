// What the oracle reads of a scene's file by itself: where the faces stand, and the camera. Nothing of it is the product's
// readers', so that what these do to positions is judged, too.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/formats/resolution.h"
#include "core/base/expect.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// In doubles and world coordinates, as far as a file asks for no more than a judge has time and room for.
struct FilePlaces {
  core::Scene scene;
  std::optional<core::View> view;  ///< the file's own
  core::SceneBuilder builder{scene};
  std::uint64_t steps_left = std::uint64_t{1} << 23U;

  /// One face of at least three corners. Throws core::InputError, why a file is not judged, if there are too many.
  void add(const std::vector<core::Vec3d>& corners) {
    spend(2 * corners.size());
    builder.polygon(corners);
  }
  /// On vertices, nodes, whatever a file may have many of. Throws likewise.
  void spend(std::uint64_t steps) {
    steps_left -= std::min(steps, steps_left);
    if (steps_left == 0) {
      throw core::InputError("it has more than some 700,000 triangles");
    }
  }
};

/// The bytes of what a file names beside itself.
using BytesOfNamed = std::function<std::string(const std::string& name)>;

/// Of a .gltf or .glb: its scene as its nodes have it, all coordinates times `scale`, seen over a picture of `size` pixels.
/// Throws NotJudged for what it does not know (instances, skins, morph targets, what is packed), and std::exception for what is
/// none.
void read_gltf_places(const std::string& file, const BytesOfNamed& bytes_of, double scale, const Resolution& size,
                      FilePlaces& places);
/// Of an .obj: its faces. Throws likewise.
void read_obj_places(std::string file, double scale, FilePlaces& places);

}  // namespace dmpc::apps
