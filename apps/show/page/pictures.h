// Pictures of many colours within a page.
#pragma once

#include <string>

#include "apps/frontend/show/page/page.h"
#include "apps/picture/image_file.h"

namespace dmpc::apps::html {

/// Pixels.
inline constexpr int picture_side_max = 1024;

/// `description`: for those who do not see it. Larger pictures than picture_side_max a side are shrunk, and the page says so; the
/// link saves them whole. Others are in the page once: a script makes the link.
void add_picture(Page& page, const Image& image, const std::string& description, const std::string& caption);

/// The picture as a PNG within its own address. Throws core::InputError if no temporary file can be written.
std::string picture_url(const Image& image);

}  // namespace dmpc::apps::html
