// The command that makes what a view shows.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/formats/resolution.h"

namespace dmpc::apps {

/// Arguments for dmpc render from this line of dmpc view: its options of a picture or a computer, the camera, and the size of the
/// picture, which is written to `picture`.
std::vector<std::string> render_words(std::span<const std::string> view_words, const std::string& camera, const Resolution& size,
                                      const std::string& picture = "view.png");

}  // namespace dmpc::apps
