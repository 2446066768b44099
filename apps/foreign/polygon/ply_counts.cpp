#include "apps/foreign/polygon/ply_counts.h"

#include <algorithm>

#include "apps/foreign/polygon/indexed_counts.h"
#include "apps/foreign/text/word_count.h"

namespace dmpc::apps {
namespace {

/// In units of the file: words of text, or bytes.
class Room {
 public:
  Room(const PlyHeader& header, std::string_view file)
      : is_text_(header.format == PlyFormat::text),
        units_(is_text_ ? count_words(file.substr(header.bytes)) : file.size() - header.bytes) {}

  std::uint64_t size_of(PlyType type) const { return is_text_ ? 1 : bytes_of(type); }
  /// Of an entry of the element whose lists are empty.
  std::uint64_t least(const PlyElement& element) const {
    std::uint64_t units = 0;
    for (const PlyProperty& property : element.properties) {
      units += size_of(property.count_type.value_or(property.type));
    }
    return std::max<std::uint64_t>(units, 1);
  }
  /// As many entries as it says, or there is room for.
  std::uint64_t count(const PlyElement& element) const { return std::min(element.count, units_ / least(element)); }
  std::uint64_t units() const { return units_; }

 private:
  bool is_text_;
  std::uint64_t units_;
};

/// Of a corner's index, the smallest there is.
std::uint64_t index_units(const PlyHeader& header, const Room& room) {
  std::uint64_t least = sizeof(double);
  for (const PlyElement& element : header.elements) {
    for (const PlyProperty& property : element.properties) {
      least = property.count_type ? std::min(least, room.size_of(property.type)) : least;
    }
  }
  return least;
}

/// What corners may have, by the names of properties.
void add_attributes(const PlyElement& element, MeshCounts& counts) {
  for (const PlyProperty& property : element.properties) {
    counts.has_normals = counts.has_normals || property.name == "nx";
    counts.has_colors = counts.has_colors || property.name == "red" || property.name == "r" || property.name == "diffuse_red";
    for (const char* name : {"s", "u", "tx", "texture_u", "texcoord"}) {
      counts.has_places = counts.has_places || property.name == name;
    }
  }
}

}  // namespace

MeshCounts counts_of_ply(const PlyHeader& header, std::string_view file) {
  const Room room(header, file);
  MeshCounts counts;
  std::uint64_t taken = 0;
  bool has_strips = false;
  for (const PlyElement& element : header.elements) {
    const std::uint64_t count = room.count(element);
    taken += count * room.least(element);
    counts.vertices += element.name == "vertex" ? count : 0;
    counts.faces += element.name == "face" ? count : 0;
    has_strips = has_strips || element.name == "tristrips";
    add_attributes(element, counts);
  }
  counts.triangles_min = counts.faces;
  counts.corners = (room.units() - std::min(room.units(), taken)) / index_units(header, room);
  if (has_strips) {  // each index ends a triangle
    counts.faces += counts.corners;
    counts.corners *= 3;
  }
  return counts_of_indexed(counts, file.size());
}

}  // namespace dmpc::apps
