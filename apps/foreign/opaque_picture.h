// A picture's file without what it says of transparency.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace dmpc::apps {

/// OpenImageIO 2.4.7 gives colours of WebP multiplied by alpha, whatever is asked for, and none of a GIF's transparent pixels. Of
/// a file of such a `format` (apps/picture/picture_format.h): the bytes of one that is alike but opaque, all of whose colours are
/// as they are stored; nothing if it says nothing of transparency. What does not hold together stays as it is.
std::optional<std::vector<std::byte>> made_opaque(std::string_view format, std::span<const std::byte> file);

}  // namespace dmpc::apps
