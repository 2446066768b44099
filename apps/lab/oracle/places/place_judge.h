// Holds where a scene's faces and its camera came to stand, when it was read, against what its file says.
#pragma once

#include <cstdint>
#include <string>

#include "apps/frontend/system/opened_files.h"
#include "apps/scene/picture_options.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

struct PlaceFindings {
  std::string not_judged = {};              ///< why the file was not; empty: it was
  std::uint64_t pixels = 0, elsewhere = 0;  ///< elsewhere: which see another place than the file has there
  std::string worst, where;                 ///< worst case: "3.2 pixels off", "pixel (10, 20)"
};

/// `read`: the result of load_scene() for the picture's file and the others in `opened`; only these are read. Only glTF and OBJ
/// are judged, unless read_gltf_places() refuses them. A pixel sees another place if the first hits, both in doubles, lie farther
/// apart than rays within 1/256 of a pixel meet one surface, plus rounding of doubles. A file without a camera, or if another one
/// is asked for, is seen by the picture's.
PlaceFindings judge_places(const core::Scene& read, const PictureOptions& picture, const OpenedFiles& opened);

/// "12 of 4,096 pixels see another place (worst in pixel (10, 20): 3.2 pixels off)", or "not judged: ...".
std::string text_of(const PlaceFindings& findings);

}  // namespace dmpc::apps
