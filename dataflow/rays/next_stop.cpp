#include "dataflow/rays/next_stop.h"

#include <limits>

namespace dmpc::dataflow {
namespace {

constexpr float never = std::numeric_limits<float>::infinity();

/// Where the ray may first meet anything; in no region before that.
float first_meeting(const core::Ray& ray, const core::Walk& walk, const core::Passage& passage, const Surroundings& surroundings,
                    core::Operations& operations) {
  if (!surroundings.has_outline()) {
    return static_cast<float>(passage.t_enter);
  }
  core::LocalRecords records = surroundings.records;
  core::Cursor cursor = core::arrive(passage);
  return core::RayWalk(ray, cursor, records, operations).first_block(walk, surroundings.outline, surroundings.skips);
}

}  // namespace

NextStop next_stop(const core::Ray& ray, const core::Passage& passage, const Surroundings& surroundings,
                   std::optional<nodes::NodeId> here, core::Operations& operations) {
  const Regions& regions = surroundings.regions;
  NextStop stop{.passage = passage, .region = regions.region_index_of(passage.cell)};
  if (regions.owner_at(stop.region) == here || (!surroundings.has_outline() && !regions.is_empty(stop.region))) {
    return stop;
  }
  core::Walk walk(ray, surroundings.outline.frame, surroundings.outline.region);
  const float first = first_meeting(ray, walk, passage, surroundings, operations);
  if (first == never) {
    stop.traced = passage.best.found() ? core::Traced::hit : core::Traced::miss;
    return stop;
  }
  while (stop.traced == core::Traced::left && regions.owner_at(stop.region) != here) {
    walk.move_to(regions.region_at(stop.region));
    if (!regions.is_empty(stop.region) && static_cast<float>(walk.region_exit().t) >= first) {
      ++operations.cell_steps;
      break;
    }
    core::Passage next = stop.passage;
    const core::Traced traced = core::pass(ray, walk, next, operations);
    if (!regions.is_empty(stop.region) && traced != core::Traced::left) {
      break;
    }
    stop = {.traced = traced, .passage = next, .region = regions.region_index_of(next.cell)};
    ++operations.skipped.empty_regions;
  }
  return stop;
}

}  // namespace dmpc::dataflow
