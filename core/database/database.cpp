#include "core/database/database.h"

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/database/database_builder.h"
#include "core/database/meshes/mesh_faces.h"
#include "core/database/meshes/obstacle.h"
#include "core/database/parallel.h"
#include "core/record/directory.h"
#include "core/record/instance.h"
#include "core/record/records.h"
#include "core/scene/base_meshes.h"
#include "core/scene/placed_objects.h"

namespace dmpc::core {
namespace {

/// Calls visit(address, leaf) for each leaf below a BVH node.
template <class Visit>
void for_each_leaf_below(const LocalRecords& records, Address from, const Visit& visit) {
  const auto bvh_node = read<BvhNode>(records.find(from));
  for (std::size_t child = 0; child < bvh_node.child_count; ++child) {
    const Address address = bvh_node.child[child].address();
    bvh_node.child[child].is_leaf() ? visit(address, records.find(address)) : for_each_leaf_below(records, address, visit);
  }
}

/// `first` is the id of the leaf's item 0; `lane_of` makes the lane of a hit on the leaf.
template <class LaneOf>
void add_slots(Address address, const std::byte* leaf, std::uint32_t first, const LaneOf& lane_of,
               std::vector<Database::Place>& places) {
  const auto header = read<LeafHeader>(leaf);
  const std::byte* const ids = ids_of(header, leaf);
  for (std::uint32_t lane = 0; lane < header.count; ++lane) {
    places[first + read<std::uint32_t>(ids + lane * sizeof(std::uint32_t))] = {address, lane_of(lane)};
  }
}

/// Lists the places of a leaf's instances.
void find_places_of_instances(const LocalRecords& records, const std::byte* leaf, std::vector<Database::Place>& places) {
  for (std::size_t i = 0; i < read<LeafHeader>(leaf).count; ++i) {
    const Address address = instance_in(leaf, i);
    const auto instance = read<InstanceRecord>(records.find(address));
    for_each_leaf_below(records, instance.root, [&](Address at, const std::byte* of_mesh) {
      add_slots(
          at, of_mesh, instance.first, [&](std::uint32_t lane) { return lane_in_instance(lane, address); }, places);
    });
  }
}

void find_places_in(const LocalRecords& records, Address address, std::vector<Database::Place>& places) {
  const std::byte* const leaf = records.find(address);
  if (read<LeafHeader>(leaf).kind == PrimitiveKind::instance) {
    return find_places_of_instances(records, leaf, places);
  }
  add_slots(
      address, leaf, 0, [](std::uint32_t lane) { return lane; }, places);
}

/// The number of corners of the copies that a scene leaves out.
std::uint64_t copied_corners(const Scene& scene) { return size_with_copies(scene).vertices - scene.vertices.size(); }

/// The peak memory while a scene with copies for these instances becomes primitives, whose records replace its objects.
std::uint64_t bytes_with_copies(const Scene& scene, const std::vector<bool>& places) {
  constexpr std::uint64_t a_primitive = sizeof(PrimitiveValues) + sizeof(PrimitiveSource) + sizeof(ShadingReference);
  const ExpandedSize size = size_with_copies(scene, places);
  const std::uint64_t triangles = size.vertices - std::min(size.vertices, 2 * size.objects);
  return size.bytes() + std::max(size.objects, triangles) * a_primitive;
}

/// `why` is the reason for the copies, to follow "with a copy in each place".
void put_copies_in(Scene& scene, const std::vector<bool>& places, const CopyLimits& limits, const std::string& why,
                   const char* advice) {
  if (const std::uint64_t bytes = bytes_with_copies(scene, places); bytes > limits.bytes_max) {
    throw CapacityError("with a copy in each place" + why + ", the scene takes " + std::to_string(bytes >> 20U) +
                        " MiB of memory, and there are " + std::to_string(limits.bytes_max >> 20U) + " for it: " + advice);
  }
  put_copies(scene, places);
}

constexpr const char* fewer_slots = "give the scene fewer places, or coarser meshes";

/// Adds the obstacles to the scene and counts them in `copied`.
void put_obstacles_in(Scene& scene, std::span<const Obstacle> obstacles, const CopyLimits& limits, ObstacleCounts& copied) {
  add(obstacles, copied);
  if (any_of(obstacles)) {
    std::vector<bool> places;
    for (const Obstacle obstacle : obstacles) {
      places.push_back(obstacle != Obstacle::none);
    }
    put_copies_in(scene, places, limits, " of what cannot be kept once (" + text_of(scene, obstacles) + ")", fewer_slots);
  }
}

void put_all_in(Scene& scene, const CopyLimits& limits) {
  if (leaves_copies_out(scene)) {
    const bool is_asked_for = *limits.reason != 0;
    put_copies_in(scene, std::vector<bool>(scene.kept->places.size(), true), limits,
                  is_asked_for ? std::string(", ") + limits.reason : "", is_asked_for ? limits.advice : fewer_slots);
  }
}

}  // namespace

std::vector<Database::Place> Database::find_places() const {
  const LocalRecords records(bytes());
  std::vector<Place> places(header_.primitive_count);
  for (std::uint64_t i = 0; i < directory_entry_count(header_.directory_size); ++i) {
    const auto entry = read<DirectoryEntry>(records.find(header_.directory) + i * sizeof(DirectoryEntry));
    if (entry.empty()) {
      continue;
    }
    if (header_.has_voxels()) {
      for_each_listed(records, header_, entry, [&](Address leaf) { find_places_in(records, leaf, places); });
    } else {
      for_each_leaf_below(records, entry.bvh_node(),
                          [&](Address address, const std::byte*) { find_places_in(records, address, places); });
    }
  }
  return places;
}

Database build_database(const Scene& scene, const BuildOptions& options) {
  if (leaves_copies_out(scene)) {
    Scene whole = scene;
    return build_database(std::move(whole), options);
  }
  const std::vector<MeshFaces> meshes = faces_of_meshes(scene, options.cells_per_primitive, Parallel(options.threads));
  const auto builder = DatabaseBuilder::of({scene, options, meshes});
  Database database = builder->build().value();
  return options.record_order == RecordOrder::spatial
             ? std::move(database)
             : DatabaseBuilder::of({scene, options, meshes, builder->scattered()})->build().value();
}

Database build_database(Scene&& scene, const BuildOptions& options) {
  return build_database(std::move(scene), options, CopyLimits{});
}

Database build_database(Scene&& scene, const BuildOptions& options, const CopyLimits& limits) {
  const Parallel parallel(options.threads);
  const std::vector<MeshFaces> meshes = faces_of_meshes(scene, options.cells_per_primitive, parallel);
  const auto builder = [&] { return DatabaseBuilder::of({scene, options, meshes, {}, &scene}); };
  if (options.keeps_instances && copied_corners(scene) > limits.corners_max) {
    ObstacleCounts copied;
    put_obstacles_in(scene, obstacles_of(scene, meshes, parallel), limits, copied);
    while (copied_corners(scene) > limits.corners_max) {
      const auto keeping = builder();
      keeping->set_copied(copied);
      if (auto database = keeping->build()) {
        return std::move(*database);
      }
      put_obstacles_in(scene, keeping->obstacles(), limits, copied);
    }
  }
  put_all_in(scene, limits);
  if (options.record_order == RecordOrder::spatial) {
    return builder()->build().value();
  }
  Database database = build_database(std::as_const(scene), options);
  forget_objects(scene);
  for (Texture& texture : scene.textures) {
    forget_texels(texture);
  }
  return database;
}

}  // namespace dmpc::core
