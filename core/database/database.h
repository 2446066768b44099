// The scene as flat records cut into pages, ready for nodes (built on the host).
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "core/base/forget.h"
#include "core/database/held_array.h"
#include "core/database/meshes/obstacle.h"
#include "core/database/structure.h"
#include "core/record/curved_values.h"
#include "core/record/record.h"
#include "core/scene/scene.h"

namespace dmpc::core {

struct BuildOptions {
  std::size_t page_size_bytes = 1024;  ///< a power of two, 512 B to 64 KiB
  double cells_per_primitive = 0.125;  ///< sets the size of cells, and so of macro cells and of the finest lattice
  RecordOrder record_order = RecordOrder::spatial;
  Structure structure = Structure::grid;  ///< other boxes around the same floats: the picture has the same bits
  VoxelRule voxels = usual_voxels;        ///< for Structure::voxels
  /// The maximum number of emitters for light sampling (core/database/shading/emitters.h). 0: none, as with Whitted's transport.
  std::uint32_t emitters_max = 0;
  bool for_paths = false;  ///< surfaces for pictures by paths: Material::microfacets
  /// Meshes of Scene::kept are stored once, and their copies as InstanceRecords; the film has the bits of copies. Requires
  /// Structure::extents and RecordOrder::spatial.
  bool keeps_instances = false;
  std::uint32_t threads = 0;  ///< that build; 0: one per core. The bytes do not depend on it
  /// Called now and then, by one thread at a time, with the number of references sorted into trees and their total: the longest
  /// part of a build. May be empty.
  std::function<void(std::uint64_t, std::uint64_t)> progress = {};
  double pad_share = 1;  ///< factor of insertion_pad(); less than 1 only to test what the pad would hide
};

/// Where a primitive came from, for messages, the oracle and counting; on the host only.
struct PrimitiveSource {
  std::uint32_t object = 0;  ///< index into Scene::objects; triangles of one polygon share it
};

/// A primitive that is degenerate after rounding to the grid's coordinates.
struct CollapsedPrimitive {
  Vec3f place;     ///< grid-local
  float size = 0;  ///< its extent without rounding, grid-local
};

/// Two faces that cover each other in planes of which neither is before the other everywhere, or next to which too many others
/// lie, or that not even doubles tell apart on a ray: where t is the same for both, the first in the file shows, and where layers
/// move t by more than the distance, the wrong one may show.
struct CloseFaces {
  Vec3f place;                ///< on the smaller one, grid-local
  float size = 0;             ///< its longest edge
  float least = 0, most = 0;  ///< distance of one from the plane of the other
  std::uint32_t layers = 0;   ///< number of layers between them
};

/// A plane that leaves store, and what their headers say of it.
struct PrimitivePlane : FacePlane {
  std::uint8_t stored_as = LeafHeader::shared_plane;  ///< LeafHeader::plane
};

/// One primitive with the values of its records, for the oracle and the referee. Rows as in LeafHeader.
struct PrimitiveValues {
  PrimitiveKind kind{};
  std::array<float, value_count_max> value{};

  /// A vertex, centre or end, by its first row, without rests.
  Vec3d vector(std::size_t row) const { return {double{value[row]}, double{value[row + 1]}, double{value[row + 2]}}; }
  /// The values of a sphere or cone, with rests; must not outlive this.
  CurvedValues curved() const { return {kind, value.data(), 1, 0}; }

  /// The plane() of triangles that have a coordinate in common, which gives their plane.
  static constexpr std::uint32_t level_plane = 0xffffffffU;

  /// For a triangle, the number of the Database::planes() that it shares with others that cover it, from 1 on; 0: none. Stored
  /// after the nine values.
  std::uint32_t plane() const {
    return kind == PrimitiveKind::triangle ? std::bit_cast<std::uint32_t>(value[value_count(kind)]) : 0;
  }
  /// Whether its records have to store its plane.
  bool needs_plane() const { return plane() != 0 && plane() != level_plane; }
  void lie_in(std::uint32_t number) { value[value_count(PrimitiveKind::triangle)] = std::bit_cast<float>(number); }
};
static_assert(value_count(PrimitiveKind::triangle) < value_count_max);

struct UniformRecordCounts {
  std::uint64_t bvh_nodes = 0;
  std::array<std::uint64_t, primitive_kind_count> leaves{};
  std::uint64_t normals = 0;        ///< PatchNormals
  std::uint64_t textured = 0;       ///< TexturedNormals, in all
  std::uint64_t faceted = 0;        ///< textured ones that begin a FacetedNormals
  std::uint64_t texture_tiles = 0;  ///< on all levels
  std::uint64_t sky_tiles = 0;
  std::uint64_t voxel_references = 0;  ///< the lengths of all lists
  std::uint64_t materials = 0;         ///< without the extensions behind them
  std::uint64_t emitters_met = 0;      ///< emitting primitives that are not among the header's emitters
  std::uint64_t emitters_covered = 0;  ///< likewise, and others in their plane may cover them completely
  std::uint64_t instance_leaves = 0, instances = 0;
  std::uint64_t base_meshes = 0;                                   ///< number of meshes with instances
  std::uint64_t base_mesh_triangles = 0, triangles_in_places = 0;  ///< triangles of these meshes; of all instances
};

/// Records of the grid and of shading, by kind.
struct RecordCounts : UniformRecordCounts {
  ObstacleCounts copied;  ///< instances that have copies though meshes were to be kept
};

class Database {
 public:
  const DatabaseHeader& header() const { return header_; }
  Structure structure() const { return structure_; }
  std::size_t page_size() const { return page_size_; }
  std::size_t page_count() const { return page_count_; }
  /// page_count() * page_size() bytes (overread_bytes more are readable); empty after forget_records().
  std::span<const std::byte> bytes() const { return bytes_.items().first(bytes_.items().empty() ? 0 : page_count_ * page_size_); }
  std::span<const std::byte> page(std::size_t index) const { return bytes().subspan(index * page_size_, page_size_); }

  /// All primitives, by id: grid-local, the floats of the records. Ids follow the file's order, except that of faces that share a
  /// plane emitters come first, and transparent ones last (core/database/faces/coplanar.h).
  std::span<const PrimitiveValues> primitives() const { return primitives_.items(); }
  std::span<const PrimitiveSource> sources() const { return sources_.items(); }
  /// By PrimitiveValues::plane() - 1.
  std::span<const PrimitivePlane> planes() const { return planes_.items(); }
  /// The location of a copy of primitive `id`: possible values of Hit::leaf and Hit::lane of a hit on it. For a base mesh's
  /// triangle the lane includes the instance.
  struct Place {
    Address leaf = no_address;
    std::uint32_t lane = 0;
  };
  /// Places by id; scans all records, so call it once.
  std::vector<Place> find_places() const;

  /// Frees the bytes, when the nodes have them. All counts stay.
  void forget_records() {
    bytes_ = {};
    give_back_freed();
  }
  /// The primitives of dropped() that are not degenerate in the scene.
  std::span<const CollapsedPrimitive> collapsed() const { return collapsed_.items(); }
  std::span<const CloseFaces> close_faces() const { return close_faces_.items(); }

  /// Frees primitives(), sources() and planes(), when no oracle, referee or message needs them.
  void forget_primitives() {
    primitives_ = {};
    sources_ = {};
    planes_ = {};
  }

  /// Number of degenerate primitives (zero area or length, radius 0, not finite) that were left out.
  std::uint32_t dropped() const { return dropped_; }
  /// Number of triangles that were left out because others have the same corners.
  std::uint32_t duplicates() const { return duplicates_; }
  /// Planes in which several triangles cover each other.
  std::uint32_t shared_planes() const { return shared_planes_; }
  /// Copies of primitives in leaves, at least one each.
  std::uint64_t references() const { return references_; }
  const RecordCounts& records() const { return records_; }
  /// Number of pages of one tree in spatial order before the first subtree: tables and the upper BVH nodes, including those of
  /// base meshes. A page after these and the open ones holds, for each part of a tree in it, everything below. 0 for any other
  /// database.
  std::size_t forest_page_count() const { return forest_page_count_; }
  /// Number of open pages after those, where meshes are stored once: their part of the tree, and its InstanceRecords, leads into
  /// meshes, which lie elsewhere. 0 for any other database.
  std::size_t open_page_count() const { return open_page_count_; }
  /// Half the width of the slab within which a primitive counts as touching a cell, grid-local.
  double pad() const { return pad_; }

 private:
  friend class DatabaseBuilder;
  friend struct DatabaseParts;
  DatabaseHeader header_;
  Structure structure_ = Structure::grid;
  std::size_t page_size_ = 0, page_count_ = 0, forest_page_count_ = 0, open_page_count_ = 0;
  HeldArray<std::byte> bytes_;
  HeldArray<PrimitiveValues> primitives_;
  HeldArray<PrimitiveSource> sources_;
  HeldArray<CollapsedPrimitive> collapsed_;
  HeldArray<CloseFaces> close_faces_;
  HeldArray<PrimitivePlane> planes_;
  std::uint32_t dropped_ = 0, duplicates_ = 0, shared_planes_ = 0;
  std::uint64_t references_ = 0;
  RecordCounts records_;
  double pad_ = 0;
};

/// Copies that the scene leaves out are added. Throws CapacityError if the database would exceed 16 GiB.
Database build_database(const Scene& scene, const BuildOptions& options);
/// Builds like the other overload, but frees the scene's objects on the way: they are never in memory together with the records.
/// View, lights, materials and background stay, and textures without their texels.
Database build_database(Scene&& scene, const BuildOptions& options);

/// For a scene without copies whose instances are to be kept (BuildOptions::keeps_instances).
struct CopyLimits {
  /// The maximum number of corners of copies to be added during the build: then everything is checked as for other primitives.
  /// With more corners there are only instances (core/database/meshes/uncopied_instances.h), and the effects of rounding on
  /// copies are not checked.
  std::uint64_t corners_max = std::uint64_t{3} << 21U;
  /// The maximum size of the scene, with the added copies, during conversion.
  std::uint64_t bytes_max = std::numeric_limits<std::uint64_t>::max();
  /// Why all copies are wanted, if so, and what to do if there is not enough memory.
  const char *reason = "", *advice = "";
};

/// build_database() within other limits. If there are more copies than these allow, only necessary ones are added: those whose
/// mesh or instance cannot be kept (core/database/meshes/obstacle.h). Throws CapacityError, too, if there is not enough memory
/// for them.
Database build_database(Scene&& scene, const BuildOptions& options, const CopyLimits& limits);

}  // namespace dmpc::core
