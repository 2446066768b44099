// The command that makes what a view shows.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/formats/resolution.h"

namespace dmpc::apps {

/// Of dmpc render, with the options of this line of dmpc view that are a picture's or a computer's, the camera, and the size of
/// the picture.
std::vector<std::string> render_words(std::span<const std::string> view_words, const std::string& camera, const Resolution& size);

}  // namespace dmpc::apps
