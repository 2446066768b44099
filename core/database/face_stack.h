// Faces that lie so near to each other that only the file's doubles tell which is before which.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/database/database.h"
#include "core/database/face.h"

namespace dmpc::core {

/// Planes that are one after the other along `up`, or nearly so, and the faces in each.
struct FaceStack {
  /// Of one plane, as far as doubles tell.
  struct Layer {
    KeptPlane plane;
    std::vector<std::uint32_t> ids;  ///< of the faces, ascending
  };
  std::vector<Layer> layers;
  std::vector<CloseFaces> blurred;  ///< that cover each other and are in one layer, in two planes or in one for want of digits
};

/// Sorts faces, as doubles have them, by their planes. The planes face one side; each is in a layer above those that it covers
/// from there, as far as plane_layers_max goes. Planes that cut each other where their faces cover each other may be in one
/// layer. Takes time in proportion to the faces, times their planes where those are few.
FaceStack stack_faces(std::span<const Face> faces);

}  // namespace dmpc::core
