#include "apps/foreign/gltf/counts.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/base/vec.h"
#include "core/scene/kept_meshes.h"

namespace dmpc::apps::gltf {
namespace {

/// So that no sum overflows.
constexpr std::uint64_t count_max = std::uint64_t{1} << 40U;

/// Adds what is there once, and stands in so many places.
void add_placed(std::uint64_t& sum, std::uint64_t once, std::uint64_t places) {
  sum = std::min(sum + std::min(once, count_max / std::max(places, std::uint64_t{1})) * places, count_max);
}

/// Of a mesh, once.
struct MeshSize {
  std::uint64_t vertices = 0, corners = 0;
  std::uint64_t indices = 0;  ///< of all faces
};

class Counter {
 public:
  explicit Counter(const Document& document) : root_(document.root()), accessors_(root_.list("accessors")) {}

  MeshSize size(const Part& mesh, MeshCounts& counts) const {
    MeshSize size;
    for (const Part& primitive : mesh.list("primitives")) {
      const auto attributes = primitive.find("attributes");
      const std::uint64_t vertices = attributes ? count_of(attributes->find("POSITION")) : 0;
      const auto indices = primitive.find("indices");
      const std::uint64_t places = indices ? count_of(indices) : vertices, mode = primitive.whole("mode", 4);
      size.vertices += vertices;
      size.corners += mode < triangles ? 0 : mode == triangles ? places : 3 * places;
      size.indices += mode > triangles ? 3 * places : places;
      counts.has_normals = counts.has_normals || (attributes && attributes->find("NORMAL"));
      counts.has_places = counts.has_places || (attributes && attributes->find("TEXCOORD_0"));
      counts.has_colors = counts.has_colors || (attributes && attributes->find("COLOR_0"));
    }
    return size;
  }
  /// In how many places each mesh stands.
  std::vector<std::uint64_t> uses(std::size_t meshes) const {
    std::vector<std::uint64_t> uses(meshes);
    for (const Part& node : root_.list("nodes")) {
      if (const auto mesh = node.index("mesh", meshes, "meshes")) {
        const auto instancing = node.extension("EXT_mesh_gpu_instancing");
        uses[*mesh] = std::min(uses[*mesh] + (instancing ? count_of_instances(*instancing) : 1), count_max);
      }
    }
    return uses;
  }

 private:
  static constexpr std::uint64_t triangles = 4;

  std::uint64_t count_of_instances(const Part& instancing) const {
    const Part attributes = instancing.get("attributes");
    std::uint64_t count = 0;
    for (const char* const name : {"TRANSLATION", "ROTATION", "SCALE"}) {
      count = std::max(count, count_of(attributes.find(name)));
    }
    return count;
  }

  std::uint64_t count_of(const std::optional<Part>& place) const {
    return place ? std::min(accessors_.at(place->as_index(accessors_.size(), "accessors")).whole("count", 0), count_max) : 0;
  }

  Part root_;
  std::vector<Part> accessors_;
};

/// A document without a chunk is text, of which the JSON keeps another copy, and has its buffers elsewhere or in that text.
std::uint64_t buffer_bytes(const Document& document, std::uint64_t file_bytes) {
  std::uint64_t bytes = document.chunk ? file_bytes : 2 * file_bytes;
  for (const Part& buffer : document.root().list("buffers")) {
    bytes += document.chunk ? 0 : std::min(buffer.whole("byteLength", 0), count_max);
  }
  return bytes;
}

}  // namespace

MeshCounts counts_of(const Document& document, std::uint64_t file_bytes, core::Copies copies) {
  constexpr std::uint64_t place_bytes = sizeof(std::array<float, 2>), color_bytes = sizeof(core::Vec3d) + sizeof(double);
  const Counter counter(document);
  const std::vector<Part> meshes = document.root().list("meshes");
  const std::vector<std::uint64_t> uses = counter.uses(meshes.size());
  MeshCounts counts;
  MeshSize once;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const MeshSize size = counter.size(meshes[i], counts);
    once.vertices += size.vertices;
    once.indices += size.indices;
    const bool is_left_out = copies == core::Copies::left_out && size.corners > 3 * core::copied_triangles_max;
    const std::uint64_t placed = is_left_out ? std::min<std::uint64_t>(uses[i], 1) : uses[i];
    add_placed(counts.vertices, size.vertices, placed);
    add_placed(counts.corners, size.corners, placed);
    counts.has_instances = counts.has_instances || uses[i] > 1;
    counts.triangles_min += uses[i] > 0 ? size.corners / 3 : 0;
  }
  counts.faces = counts.corners / 3;
  const std::uint64_t of_vertex = sizeof(core::Vec3d) * (counts.has_normals ? 2 : 1) + (counts.has_places ? place_bytes : 0) +
                                  (counts.has_colors ? color_bytes : 0);
  counts.read_bytes = buffer_bytes(document, file_bytes) + of_vertex * once.vertices + sizeof(std::uint32_t) * once.indices;
  return counts;
}

}  // namespace dmpc::apps::gltf
