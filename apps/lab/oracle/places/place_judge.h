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
  std::string worst, where;                 ///< of these: "3.2 pixels off", "pixel (10, 20)"
};

/// `read`: what load_scene() made of the picture's file and of the others that are `opened`; no more is read of them. Nothing is
/// judged of formats but glTF and OBJ, and of what read_gltf_places() refuses. A pixel sees another place if its first hits, both
/// in doubles, lie farther apart than rays within 1/256 of a pixel meet one surface, but for what rounding leaves of doubles. A
/// file without a camera, or where another is asked for, is seen by the picture's.
PlaceFindings judge_places(const core::Scene& read, const PictureOptions& picture, const OpenedFiles& opened);

/// "12 of 4,096 pixels see another place (worst in pixel (10, 20): 3.2 pixels off)", or "not judged: ...".
std::string text_of(const PlaceFindings& findings);

}  // namespace dmpc::apps
