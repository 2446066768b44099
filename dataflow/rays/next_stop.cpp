#include "dataflow/rays/next_stop.h"

#include <cmath>
#include <limits>

namespace dmpc::dataflow {
namespace {

constexpr float never = std::numeric_limits<float>::infinity();

/// The same in an outline whose cells are cubes of several voxels. Each of their planes is one of the voxels', crossed at the
/// same t, since doubling is exact; beyond the voxels they may go on for a while.
float first_in_cubes(const core::Ray& ray, const core::Passage& passage, const Surroundings& surroundings,
                     core::Operations& operations) {
  core::LocalRecords records = surroundings.records;
  core::DatabaseHeader cubes = surroundings.outline;
  cubes.frame.finest_cell = std::ldexp(cubes.frame.finest_cell, cubes.directory_doublings);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cubes.frame.resolution[axis] = cubes.directory_size[axis] * core::cells_per_top;
  }
  cubes.region = {.high = core::grid_size(cubes.frame)};
  core::Passage entered = passage;
  entered.cell = core::doubled(passage.cell, cubes.directory_doublings);
  core::Cursor cursor = core::arrive(entered);
  const core::Walk walk(ray, cubes.frame, cubes.region);
  return core::RayWalk(ray, cursor, records, operations).first_block(walk, cubes);
}

/// Where the ray may first meet anything; in no region before that.
float first_meeting(const core::Ray& ray, const core::Walk& walk, const core::Passage& passage, const Surroundings& surroundings,
                    core::Operations& operations) {
  if (!surroundings.has_outline()) {
    return static_cast<float>(passage.t_enter);
  }
  core::LocalRecords records = surroundings.records;
  if (surroundings.outline.directory_doublings > 0) {
    return first_in_cubes(ray, passage, surroundings, operations);
  }
  core::Cursor cursor = core::arrive(passage);
  return core::RayWalk(ray, cursor, records, operations).first_block(walk, surroundings.outline);
}

}  // namespace

NextStop next_stop(const core::Ray& ray, const core::Passage& passage, const Surroundings& surroundings,
                   std::optional<nodes::NodeId> here, core::Operations& operations) {
  const Regions& regions = surroundings.regions;
  FoundRegion found = regions.find(passage.cell);
  NextStop stop{.passage = passage, .region = found.index};
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
    walk.move_to(found.box);
    if (!regions.is_empty(stop.region) && static_cast<float>(walk.region_exit().t) >= first) {
      ++operations.cell_steps;
      break;
    }
    core::Passage next = stop.passage;
    const core::Traced traced = core::pass(ray, walk, next, operations);
    if (!regions.is_empty(stop.region) && traced != core::Traced::left) {
      break;
    }
    found = regions.find(next.cell);
    stop = {.traced = traced, .passage = next, .region = found.index};
    ++operations.skipped.empty_regions;
  }
  return stop;
}

}  // namespace dmpc::dataflow
