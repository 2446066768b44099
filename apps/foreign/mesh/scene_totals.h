// The size of a file's scene so far, checked before more memory is allocated.
#pragma once

#include <cstdint>
#include <limits>

#include "apps/foreign/mesh/polygon_mesh.h"
#include "core/base/counts.h"
#include "core/base/expect.h"
#include "core/scene/instances.h"

namespace dmpc::apps {

/// Numbers of faces with three or more corners and of instances beside each mesh's first, and the minimum memory for all of it.
struct GeometrySize {
  std::uint64_t triangles = 0, faces = 0, corners = 0, places = 0, bytes = 0;

  GeometrySize& operator+=(const GeometrySize& other) { return core::add_counts(*this, other); }
};
/// In a scene; `corner_bytes`: a corner's data beside its position.
GeometrySize size_of_faces(std::uint64_t faces, std::uint64_t corners, std::uint64_t corner_bytes = 0);
/// The size of each instance of a mesh in a scene that copies it.
GeometrySize size_of_copy(const PolygonMesh& mesh);
/// size_of_copy() and the mesh itself, which is read before.
GeometrySize size_of(const PolygonMesh& mesh);
GeometrySize size_of_places(std::uint64_t count);

/// One per scene, shared by all of its readers. The totals only grow.
class SceneTotals {
 public:
  /// `copies`: how meshes with several instances are stored.
  explicit SceneTotals(std::uint64_t memory_bytes_max = std::numeric_limits<std::uint64_t>::max(),
                       core::Copies copies = core::Copies::put)
      : memory_bytes_max_(memory_bytes_max), copies_(copies) {}

  /// Throws core::CapacityError if a database, a scene's indices, or memory is too small, with where() in front: "a.pbrt:3:1: ".
  /// Cheap.
  template <class Where>
  void add(const GeometrySize& more, const Where& where) {
    ask(more, where);
    size_ += more;
  }
  /// As above, for geometry that is not added yet.
  template <class Where>
  void ask(const GeometrySize& more, const Where& where) const {
    try {
      ask(more);
    } catch (const core::CapacityError& error) {
      throw core::CapacityError(where() + error.what());
    }
  }
  void ask(const GeometrySize& more) const { check(GeometrySize(size_) += more); }
  /// Size of a further instance of a mesh whose copy has size `copy`.
  GeometrySize size_of_place(const GeometrySize& copy) const;

 private:
  void check(const GeometrySize& size) const;

  std::uint64_t memory_bytes_max_;
  core::Copies copies_;
  GeometrySize size_;
};

}  // namespace dmpc::apps
