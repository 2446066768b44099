// The header of a PLY file (G. Turk, "The PLY Polygon File Format", 1994).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dmpc::apps {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t bytes_of(PlyType type);
bool is_whole(PlyType type);
/// The smallest and largest values of an integer type.
double least_of(PlyType type);
double most_of(PlyType type);

struct PlyProperty {
  std::string_view name;
  PlyType type{};
  std::optional<PlyType> count_type;  ///< type of a list's length
};

struct PlyElement {
  std::string_view name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyFormat : std::uint8_t { text, little_endian, big_endian };

/// Names are views into the file.
struct PlyHeader {
  PlyFormat format{};
  std::vector<PlyElement> elements;
  std::vector<std::string> textures;  ///< from `comment TextureFile NAME`, in order
  std::vector<std::string> notes;
  std::size_t bytes = 0, lines = 0;  ///< of the header
};

/// Throws core::InputError, with the line, for an invalid or unterminated header.
PlyHeader read_ply_header(std::string_view file);

}  // namespace dmpc::apps
