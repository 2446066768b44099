// Recognizes the readable picture formats by their first bytes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "apps/frontend/system/descriptor.h"

namespace dmpc::apps {

/// Returns OpenImageIO's name ("png", "jpeg", "openexr", "tiff", "bmp", "hdr", "webp", "gif", "pnm", "dds") by the first bytes of
/// a file; "targa", which has no fixed beginning, if `ending` (of a name, "tga") says so; else nothing.
std::optional<std::string> picture_format(std::string_view beginning, std::string_view ending);
/// Formats whose pictures may be plain (apps/foreign/plain_picture.h).
inline constexpr std::array<std::string_view, 3> plain_formats = {"png", "jpeg", "openexr"};
/// Returns the format of an open file.
std::optional<std::string> picture_format(const Descriptor& file, std::string_view ending);

/// Returns "PNG, JPEG, ...", for messages.
std::string known_picture_formats();

/// Limit of the pixels along a side.
inline constexpr std::uint32_t picture_side_max = 1U << 20U;

/// Returns the decoded size of a picture of that size: up to three channels of `bytes_a_channel` bytes.
std::uint64_t decoded_bytes(std::uint64_t width, std::uint64_t height, std::uint64_t bytes_a_channel);
/// Returns the limit for the decoded size that a file may claim: no format packs more than a few thousand to one, except small
/// pictures.
std::uint64_t decoded_bytes_max(std::uint64_t file_bytes);

}  // namespace dmpc::apps
