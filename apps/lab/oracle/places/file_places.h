// What the oracle itself reads from a scene's file: the positions of the faces, and the camera. It shares nothing with the
// product's readers, so that their effect on positions is judged, too.
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

/// Positions in doubles and world coordinates, unless a file needs more time or memory than a judge has.
struct FilePlaces {
  core::Scene scene;
  std::optional<core::View> view;  ///< the file's own
  core::SceneBuilder builder{scene};
  std::uint64_t steps_left = std::uint64_t{1} << 23U;

  /// Adds a face of at least three corners. Throws core::InputError, which says why a file is not judged, if there are too many.
  void add(const std::vector<core::Vec3d>& corners) {
    spend(2 * corners.size());
    builder.polygon(corners);
  }
  /// Spends steps on vertices, nodes, or whatever else a file may have many of. Throws likewise.
  void spend(std::uint64_t steps) {
    steps_left -= std::min(steps, steps_left);
    if (steps_left == 0) {
      throw core::InputError("it has more than some 700,000 triangles");
    }
  }
};

/// Returns the bytes of a file that the scene's file names.
using BytesOfNamed = std::function<std::string(const std::string& name)>;

/// Reads a .gltf or .glb file: the scene of its nodes, with all coordinates times `scale`, and a picture of `size` pixels. Throws
/// NotJudged for unsupported features (instances, skins, morph targets, compression), and std::exception for invalid files.
void read_gltf_places(const std::string& file, const BytesOfNamed& bytes_of, double scale, const Resolution& size,
                      FilePlaces& places);
/// Reads the faces of an .obj file. Throws likewise.
void read_obj_places(std::string file, double scale, FilePlaces& places);

}  // namespace dmpc::apps
