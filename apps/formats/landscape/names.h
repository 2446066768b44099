// The names of landscapes and groves, which say their sizes.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace dmpc::apps {

inline constexpr int landscape_size_max = 11, landscape_size_default = 10;
/// Prefixes of the scenes' names.
inline const std::array<std::string, 2> landscape_families{"landscape", "grove"};

inline constexpr int grove_size_max = 10, grove_size_default = 5;

/// The size in "landscape-10" or "landscape"; nothing for names without this prefix. Throws core::InputError for one with the
/// prefix, but without a size from 1 to landscape_size_max.
std::optional<int> landscape_size(std::string_view name);

/// The size in "grove-5" or "grove".
std::optional<int> grove_size(std::string_view name);

/// Size of the ground below a grove of this size; it has 4^size triangles.
int ground_size(int grove_size);
/// Texels along each side of the picture on a ground of this size.
int ground_picture_side(int size);

}  // namespace dmpc::apps
