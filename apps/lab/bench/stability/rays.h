// Rays in grid-local coordinates, their targets, and their hits.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/database/database.h"
#include "core/record/directory.h"
#include "core/record/hit.h"
#include "core/record/ray.h"
#include "core/record/records.h"
#include "core/scene/scene.h"
#include "core/trace/traversal.h"

namespace dmpc::apps {

/// Returns a scene whose eye is so far away that the pad covers rays from `distance` extents.
inline core::Scene seen_from(core::Scene scene, double distance) {
  core::Vec3d low{1e300, 1e300, 1e300}, high = -low;
  for (const core::Vec3d& v : scene.vertices) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], v[axis]);
      high[axis] = std::max(high[axis], v[axis]);
    }
  }
  const core::Vec3d size = high - low;
  scene.view.at = (low + high) * 0.5;
  scene.view.from = scene.view.at + core::Vec3d{distance * std::max({size.x, size.y, size.z}), 0, 0};
  return scene;
}

inline core::Ray ray_from(const core::Vec3f& origin, const core::Vec3f& direction) {
  core::Ray ray;
  ray.origin = origin;
  ray.direction = direction;
  return ray;
}

/// In grid-local coordinates; the direction is normalised in double, then rounded.
inline core::Ray ray_through(const core::Vec3d& origin, const core::Vec3d& target) {
  const core::Vec3f start(origin);
  return ray_from(start, core::Vec3f(core::normalize(target - core::Vec3d(start))));
}

/// The records of a database whose directory has no distances: rays leave empty cells one by one.
class CellByCell {
 public:
  explicit CellByCell(const core::Database& database)
      : records_(database.bytes()),
        directory_(database.header().directory),
        end_(core::advance(directory_, core::directory_entry_count(database.header().directory_size) * sizeof(Pair) / 2)) {}

  const std::byte* find(core::Address address) {
    const std::byte* const record = records_.find(address);
    if (address < directory_ || address >= end_) {
      return record;
    }
    entries_ = core::read<Pair>(record);
    for (core::DirectoryEntry& entry : entries_) {
      entry = entry.radius() > 1 && entry.empty() ? core::DirectoryEntry() : entry;
    }
    return reinterpret_cast<const std::byte*>(entries_.data());
  }

 private:
  using Pair = std::array<core::DirectoryEntry, 2>;

  core::LocalRecords records_;
  core::Address directory_, end_;
  Pair entries_;
};

/// Returns the hit of one ray; infinity and no primitive for a miss.
template <core::Records R>
core::Hit shoot(R records, const core::Database& database, const core::Ray& ray) {
  core::Cursor cursor;
  core::Operations operations;
  core::trace(ray, cursor, records, database.header(), {}, operations);
  return cursor.best;
}
inline core::Hit shoot(const core::Database& database, const core::Ray& ray) {
  return shoot(core::LocalRecords(database.bytes()), database, ray);
}

inline bool same_hit(const core::Hit& a, const core::Hit& b) {
  return std::bit_cast<std::uint32_t>(a.t) == std::bit_cast<std::uint32_t>(b.t) && a.primitive == b.primitive;
}

/// Reports each record as absent at its first request, and keeps only that one record. Not thread-safe.
class OneRecord {
 public:
  explicit OneRecord(std::span<const std::byte> database) : all_(database) {}

  const std::byte* find(core::Address address) {
    if (address != held_) {
      return nullptr;
    }
    held_ = core::no_address;
    return all_.find(address);
  }
  void fetch(core::Address address) { held_ = address; }

 private:
  core::LocalRecords all_;
  core::Address held_ = core::no_address;
};

}  // namespace dmpc::apps
