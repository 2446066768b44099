// Some of a file's faces, over the vertices that they have.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "apps/foreign/mesh/polygon_mesh.h"
#include "apps/foreign/obj/geometry.h"

namespace dmpc::apps::obj {

struct Part {
  FaceList faces;                       ///< over `vertices`
  std::vector<std::uint32_t> vertices;  ///< of the file, in the order in which the faces have them
};

/// Finds parts one after the other, each in time of its own size.
class PartFinder {
 public:
  explicit PartFinder(std::size_t vertices) : places_(vertices, none) {}

  Part part(const Faces& faces, std::span<const std::uint32_t> list) {
    Part part;
    for (const std::uint32_t face : list) {
      for (std::size_t i = faces.begin_of(face); i < faces.ends[face]; ++i) {
        std::uint32_t& place = places_[faces.vertices[i]];
        if (place == none) {
          place = static_cast<std::uint32_t>(part.vertices.size());
          part.vertices.push_back(faces.vertices[i]);
        }
        part.faces.corners.push_back(place);
      }
      part.faces.ends.push_back(static_cast<std::uint32_t>(part.faces.corners.size()));
    }
    for (const std::uint32_t vertex : part.vertices) {
      places_[vertex] = none;
    }
    return part;
  }

 private:
  std::vector<std::uint32_t> places_;  ///< of each of the file's vertices in the part, while it is made
};

}  // namespace dmpc::apps::obj
