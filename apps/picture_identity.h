// What makes a picture: two with the same identity have the same bits, whatever computes them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/render_options.h"
#include "core/partial_picture.h"
#include "core/scene.h"

namespace dmpc::apps {

/// One thing that a picture depends on. Both texts are without line ends, the name without "=".
struct PictureFact {
  std::string name;
  std::string value;  ///< "#" and a digest where it would be too long
  bool operator==(const PictureFact&) const = default;
};

struct PictureIdentity {
  int width = 1, height = 1;
  std::vector<PictureFact> facts;
  core::PictureTerms terms = {};  ///< what follows from the facts for a part of the picture
};

/// `scene` as it is rendered: staged, and not yet built from.
PictureIdentity identity_of(const RenderOptions& options, const core::Scene& scene);

/// Of all that the scene is: equal scenes, equal digests, whatever file or name they come from.
std::uint64_t scene_digest(const core::Scene& scene);

/// How the facts of another picture differ from those of `here`, as a part of a sentence: "depth is 5, here 4; other materials".
/// Empty if they are the same.
std::string difference_text(const std::vector<PictureFact>& other, const std::vector<PictureFact>& here);

}  // namespace dmpc::apps
