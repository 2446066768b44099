// Compares the positions that a scene's faces and its camera got by reading with those in its file.
#pragma once

#include <cstdint>
#include <string>

#include "apps/frontend/system/opened_files.h"
#include "apps/scene/picture_options.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

struct PlaceFindings {
  std::string not_judged = {};              ///< why the file was not judged; empty: it was
  std::uint64_t pixels = 0, elsewhere = 0;  ///< `elsewhere`: pixels that see another position than the file has there
  std::string worst, where;                 ///< worst case: "3.2 pixels off", "pixel (10, 20)"
};

/// `read`: the result of load_scene() for the picture's file and the others in `opened`; only these are read. Only glTF and OBJ
/// are judged, unless read_gltf_places() refuses them. A pixel sees another position if the first hits, both in doubles, lie
/// farther apart than rays within 1/256 of a pixel meet one surface, plus rounding of doubles. If a file has no camera, or
/// another one is requested, the picture's camera is used.
PlaceFindings judge_places(const core::Scene& read, const PictureOptions& picture, const OpenedFiles& opened);

/// Returns "12 of 4,096 pixels see another place (worst in pixel (10, 20): 3.2 pixels off)", or "not judged: ...".
std::string text_of(const PlaceFindings& findings);

}  // namespace dmpc::apps
