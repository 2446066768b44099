// The landscape as files: a large textured scene that anybody can generate, with or without trees.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "apps/formats/landscape/mesh.h"

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

/// A line per family, as in core::describe_scene_families().
std::string describe_landscape();

/// Writes a landscape of 4^size triangles and a lake to `gltf`, and beside it their numbers (FILE.bin) and a picture
/// (FILE-ground.png) of 2^(size + 2) texels a side, at most 4,096; the files are renamed to their names once all are written.
/// Throws core::UsageError unless `gltf` ends in .gltf and its name has only letters, digits, - and _, core::InputError if a file
/// cannot be written.
void write_landscape(int size, const std::filesystem::path& gltf, const RowsDone& rows_done = {});

/// As above with up to 2*4^size trees of 2,048 triangles each (apps/formats/landscape/grove.h); the file has one mesh for each of
/// the four kinds.
void write_grove(int size, const std::filesystem::path& gltf, const RowsDone& rows_done = {});

}  // namespace dmpc::apps
