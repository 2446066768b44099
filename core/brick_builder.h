// Builds the bricks below one top cell: which primitives share a block, and which blocks a brick.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/box.h"
#include "core/database.h"
#include "core/record_writer.h"
#include "core/region.h"

namespace dmpc::core {

/// A tree of at most brick_levels_max bricks, by the surface area heuristic: a ray meets a box in proportion to its surface
/// (J. D. MacDonald, K. S. Booth, "Heuristics for Ray Tracing Using Space Subdivision", 1990). Serial; one builder a database.
class BrickBuilder {
 public:
  BrickBuilder(std::span<const PrimitiveValues> primitives, std::span<const ShadingReference> shading, double pad,
               float finest_cell, RecordWriter& writer);

  /// The brick of the top cell at `corner`; `ids`, at least one and ascending, are the primitives that touch it. Throws
  /// InputError for more than 8^8.
  Address build(const Corner& corner, std::span<const std::uint32_t> ids);

  std::span<const Database::Place> places() const { return places_; }
  std::uint64_t references() const { return references_; }

 private:
  /// A primitive and the bounds of what of it lies in the top cell.
  struct Item {
    std::uint32_t id;
    Box bounds;
  };
  /// Primitives of one kind, and their bounds.
  struct Group {
    std::span<Item> items;
    Box bounds;
  };

  std::vector<Item> items_of(const Corner& corner, std::span<const std::uint32_t> ids) const;
  std::vector<Group> by_kind(std::span<Item> items) const;
  Address write_brick(int level, std::vector<Group> groups);
  void set_bounds(Brick& brick, std::span<const Group> groups) const;
  Address write_block(const Group& group);

  std::span<const PrimitiveValues> primitives_;
  std::span<const ShadingReference> shading_;
  double pad_;
  double top_edge_;
  RecordWriter* writer_;
  std::vector<Database::Place> places_;
  std::uint64_t references_ = 0;
};

}  // namespace dmpc::core
