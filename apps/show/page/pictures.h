// Embeds pictures of many colours in a page.
#pragma once

#include <string>

#include "apps/frontend/show/page/page.h"
#include "apps/picture/image_file.h"

namespace dmpc::apps::html {

/// Limit in pixels.
inline constexpr int picture_side_max = 1024;

/// `description` is for readers who cannot see it. Pictures larger than picture_side_max a side are shrunk, and the page says so;
/// the link saves them in full. Smaller pictures are in the page once: a script makes the link.
void add_picture(Page& page, const Image& image, const std::string& description, const std::string& caption);

/// Returns the picture as a PNG in a data URL. Throws core::InputError if no temporary file can be written.
std::string picture_url(const Image& image);

}  // namespace dmpc::apps::html
