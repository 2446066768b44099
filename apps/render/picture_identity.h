// What makes a picture: two with the same identity have the same bits, whatever computes them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/run/render_options.h"
#include "core/picture/film/partial_picture.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// One thing that a picture depends on. Both texts are without line ends, the name without "=".
struct PictureFact {
  std::string name;
  std::string value;  ///< "#" and a digest where it would be too long
  bool operator==(const PictureFact&) const = default;
};

/// How the facts of another picture differ from those of `here`, as a part of a sentence: "depth is 5, here 4; other materials".
/// Empty if they are the same.
std::string difference_text(const std::vector<PictureFact>& other, const std::vector<PictureFact>& here);

/// The name of the fact that is the last: the scale of the film.
inline constexpr const char* film_scale_fact = "film-scale";

struct PictureIdentity {
  int width = 1, height = 1;
  std::vector<PictureFact> facts;
  core::PictureTerms terms = {};  ///< what follows from the facts for a part of the picture
};

/// `scene` as it is rendered: staged, and not yet built from.
PictureIdentity identity_of(const RenderOptions& options, const core::Scene& scene);

/// Identity of a frame: the picture from `view`, in a scene whose own view, on which the sky and lights depend, may differ.
PictureIdentity identity_from(const core::View& view, PictureIdentity own);

/// A digest of all that the scene is: equal scenes, equal digests, whatever file or name they come from.
std::uint64_t scene_digest(const core::Scene& scene);

}  // namespace dmpc::apps
