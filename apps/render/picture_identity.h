// The identity of a picture: pictures with the same identity are bit-identical, whatever computes them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "apps/run/render_options.h"
#include "core/picture/film/partial_picture.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// A property on which a picture depends. Neither text contains line ends, nor the name "=".
struct PictureFact {
  std::string name;
  std::string value;  ///< "#" and a digest if it would be too long
  bool operator==(const PictureFact&) const = default;
};

/// The differences between another picture's facts and those of `here`, as a part of a sentence: "depth is 5, here 4; other
/// materials". Empty if there are none.
std::string difference_text(const std::vector<PictureFact>& other, const std::vector<PictureFact>& here);

/// The name of the last fact: the scale of the film.
inline constexpr const char* film_scale_fact = "film-scale";

struct PictureIdentity {
  int width = 1, height = 1;
  std::vector<PictureFact> facts;
  core::PictureTerms terms = {};  ///< consequences of the facts for a part of the picture
};

/// `scene` as it is rendered: after scene set-up, before a database is built from it.
PictureIdentity identity_of(const RenderOptions& options, const core::Scene& scene);

/// Identity of a frame: the picture from `view`, in a scene whose own view, on which the sky and lights depend, may differ.
PictureIdentity identity_from(const core::View& view, PictureIdentity own);

/// A digest of what a picture shows of a scene by: equal views give equal texts.
std::string view_text(const core::View& view);

/// What of a scene's identity depends on objects and texels: core::StoredObjects::identity.
std::map<std::string, std::string> stored_identity(const core::Scene& scene);

/// A digest of the whole scene: equal scenes give equal digests, whatever file or name they come from.
std::uint64_t scene_digest(const core::Scene& scene);

}  // namespace dmpc::apps
