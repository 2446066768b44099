// The landscape as files: a large textured scene that anybody can make, with or without trees.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "apps/formats/landscape/mesh.h"

namespace dmpc::apps {

inline constexpr int landscape_size_max = 11, landscape_size_default = 10;
/// Names of scenes begin so.
inline const std::array<std::string, 2> landscape_families{"landscape", "grove"};

inline constexpr int grove_size_max = 10, grove_size_default = 5;

/// The size that "landscape-10" or "landscape" names; nothing for names that do not begin so. Throws core::InputError for one
/// that begins so, but has no size from 1 to landscape_size_max.
std::optional<int> landscape_size(std::string_view name);

/// The size in "grove-5" or "grove".
std::optional<int> grove_size(std::string_view name);

/// Size of the ground below a grove of this size; it has 4^size triangles.
int ground_size(int grove_size);
/// Texels along each side of the picture on a ground of this size.
int ground_picture_side(int size);

/// A line about each, as core::describe_scene_families() has them.
std::string describe_landscape();

/// Writes a landscape of 4^size triangles and a lake to `gltf`, and beside it their numbers (FILE.bin) and a
/// picture (FILE-ground.png) of 2^(size + 2) texels a side, at most 4,096; none of them gets its name before all are written.
/// Throws core::UsageError unless `gltf` ends in .gltf and its name has letters, digits, - and _ alone, core::InputError if a
/// file cannot be written.
void write_landscape(int size, const std::filesystem::path& gltf, const RowsDone& rows_done = {});

/// Likewise a landscape with up to 2*4^size trees of 2,048 triangles each (apps/formats/landscape/grove.h), which the file has
/// but once for each of four kinds.
void write_grove(int size, const std::filesystem::path& gltf, const RowsDone& rows_done = {});

}  // namespace dmpc::apps
