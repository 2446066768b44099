// The rays that a hit spawns.
#pragma once

#include <vector>

#include "core/database/database.h"
#include "core/picture/shade.h"
#include "core/record/records.h"

namespace dmpc::apps {

/// Returns all child rays of a hit in the order of shading: shadow rays, the reflected and the refracted one. Returns none for a
/// miss.
inline std::vector<core::Ray> children_of(const core::Database& database, const core::Ray& ray, const core::Hit& hit) {
  const core::LocalRecords records(database.bytes());
  std::vector<core::Ray> children;
  if (!hit.found()) {
    return children;
  }
  core::HitState state = core::begin_shading(ray, hit);
  core::Operations operations;
  const core::ShadeOptions options;
  const core::Skips skips;
  const core::Shader shader(database.header(), options, skips, operations);
  while (state.stage != core::HitState::Stage::finished) {
    const core::Address needed = record_needed(state, database.header());
    core::Ray child;
    const std::byte* record = needed == core::no_address ? nullptr : records.find(needed);
    if (shader.step(state, record, child)) {
      children.push_back(child);
    }
  }
  return children;
}

}  // namespace dmpc::apps
