#include "dataflow/rays/next_stop.h"

#include <bit>
#include <cmath>
#include <limits>

#include "core/trace/bundle_kernel.h"
#include "core/trace/bundle_traversal.h"

namespace dmpc::dataflow {

namespace {

constexpr float never = std::numeric_limits<float>::infinity();

/// As above, in a proxy whose cells are cubes of several voxels. Each of their planes is a plane of voxels and is crossed at the
/// same t, since doubling is exact; the cubes may extend beyond the voxels.
float first_in_cubes(const core::Ray& ray, const core::Passage& passage, const Surroundings& surroundings,
                     core::Operations& operations) {
  core::LocalRecords records = surroundings.records;
  core::DatabaseHeader cubes = surroundings.proxy;
  cubes.frame.finest_cell = std::ldexp(cubes.frame.finest_cell, cubes.directory_doublings);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cubes.frame.resolution[axis] = cubes.directory_size[axis] * core::cells_per_macro;
  }
  cubes.region = {.high = core::grid_size(cubes.frame)};
  core::Passage entered = passage;
  entered.cell = core::doubled(passage.cell, cubes.directory_doublings);
  core::Cursor cursor = core::arrive(entered);
  const core::CellTraversal walk(ray, cubes.frame, cubes.region);
  return core::RayTraversal(ray, cursor, records, operations).first_leaf(walk, cubes);
}

/// Where the ray may first meet anything; it meets nothing in regions before that.
float first_meeting(const core::Ray& ray, const core::CellTraversal& walk, const core::Passage& passage,
                    const Surroundings& surroundings, core::Operations& operations) {
  if (!surroundings.has_proxy()) {
    return static_cast<float>(passage.t_enter);
  }
  core::LocalRecords records = surroundings.records;
  if (surroundings.proxy.directory_doublings > 0) {
    return first_in_cubes(ray, passage, surroundings, operations);
  }
  core::Cursor cursor = core::arrive(passage);
  return core::RayTraversal(ray, cursor, records, operations).first_leaf(walk, surroundings.proxy);
}

}  // namespace

NextStop next_stop(const core::Ray& ray, const core::Passage& passage, const Surroundings& surroundings,
                   std::optional<nodes::NodeId> here, core::Operations& operations) {
  const Regions& regions = surroundings.regions;
  FoundRegion found = regions.find(passage.cell);
  NextStop stop{.passage = passage, .region = found.index};
  if (regions.owner_at(stop.region) == here || (!surroundings.has_proxy() && !regions.is_empty(stop.region))) {
    return stop;
  }
  core::CellTraversal walk(ray, surroundings.proxy.frame, surroundings.proxy.region);
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

namespace {

using core::RayBundle;
using core::RayMask;
using core::Row;

template <class Visit>
void for_each(RayMask rays, const Visit& visit) {
  for (; rays != 0; rays &= rays - 1) {
    visit(static_cast<std::size_t>(std::countr_zero(rays)));
  }
}

/// The paths of a bundle's rays from region to region.
class Ways {
 public:
  Ways(RayBundle& bundle, const Surroundings& surroundings, nodes::NodeId here, core::Operations& operations,
       Row<std::uint32_t>& region)
      : bundle_(bundle),
        regions_(surroundings.regions),
        surroundings_(surroundings),
        here_(here),
        operations_(operations),
        region_(region) {}

  void find() {
    RayMask on = enter_regions(bundle_.left);
    if (!surroundings_.has_proxy()) {
      on &= empty_;
    }
    if (on == 0) {
      return;
    }
    on &= find_first_meetings(on);
    while (on != 0) {
      on = enter_regions(pass_regions(on));
    }
  }

 private:
  /// Finds the regions that the rays have reached. Returns the rays whose region is not this node's.
  RayMask enter_regions(RayMask rays) {
    RayMask elsewhere = 0;
    for_each(rays, [&](std::size_t ray) {
      const core::Corner cell{bundle_.arrival[0][ray], bundle_.arrival[1][ray], bundle_.arrival[2][ray]};
      if (!found_.box.contains(cell)) {  // most rays go where the previous one goes
        found_ = regions_.find(cell);
      }
      region_[ray] = found_.index;
      const RayMask bit = RayMask{1} << ray;
      empty_ = (empty_ & ~bit) | (regions_.is_empty(found_.index) ? bit : 0);
      elsewhere |= regions_.owner_at(found_.index) != here_ ? bit : 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool is_forward = (bundle_.forward[axis] & bit) != 0;
        planes_[axis][ray] = is_forward ? found_.box.high[axis] : found_.box.low[axis];
      }
    });
    return elsewhere;
  }

  /// Finds where rays may first meet anything: returns those of `rays` that may. The paths of the others end.
  RayMask find_first_meetings(RayMask rays) {
    if (!surroundings_.has_proxy()) {
      for_each(rays, [&](std::size_t ray) { first_[ray] = static_cast<float>(bundle_.t_enter[ray]); });
      return rays;
    }
    const Row<double> t_enter = bundle_.t_enter;
    const Row<float> best_t = bundle_.best.t;
    core::LocalRecords records = surroundings_.records;
    const RayMask met =
        core::BundleTraversal<core::LocalRecords>(bundle_, records, surroundings_.proxy, surroundings_.skips, operations_)
            .find_first_leaves(rays);
    first_ = bundle_.best.t;
    bundle_.best.t = best_t;
    bundle_.t_enter = t_enter;
    bundle_.left &= ~(rays & ~met);
    return met;
  }

  /// Moves rays through regions where they meet nothing. Returns those that have reached others.
  RayMask pass_regions(RayMask rays) {
    const core::BundleSteps& steps = core::fastest_bundle_steps;
    steps.find_box_exits(bundle_, rays, planes_);
    RayMask stop = 0;
    for_each(rays & ~empty_, [&](std::size_t ray) {
      stop |= (static_cast<float>(bundle_.t_exit[ray]) >= first_[ray] ? RayMask{1} : RayMask{0}) << ray;
    });
    operations_.cell_steps += core::count_of(rays);
    rays &= ~stop;
    const RayMask on = steps.pass_boxes(bundle_, rays, planes_), ended = rays & ~on & empty_;
    operations_.skipped.empty_regions += core::count_of(on | ended);
    bundle_.left &= ~ended;
    return on;
  }

  RayBundle& bundle_;
  const Regions& regions_;
  const Surroundings& surroundings_;
  nodes::NodeId here_;
  core::Operations& operations_;
  Row<std::uint32_t>& region_;
  FoundRegion found_;                     ///< that of the last ray
  RayMask empty_ = 0;                     ///< rays whose regions are empty
  alignas(64) core::PlaneRows planes_{};  ///< where rays may leave their regions
  Row<float> first_{};                    ///< a ray meets nothing in regions before that
};

/// A proxy of cubes has a different grid from the bundle.
void find_next_stops_alone(RayBundle& bundle, const Surroundings& surroundings, nodes::NodeId here, core::Operations& operations,
                           Row<std::uint32_t>& region) {
  for_each(bundle.left, [&](std::size_t ray) {
    const NextStop stop = next_stop(bundle.rays[ray], bundle.passage(ray), surroundings, here, operations);
    region[ray] = stop.region;
    bundle.left &= ~(stop.traced == core::Traced::left ? RayMask{0} : RayMask{1} << ray);
    bundle.t_enter[ray] = stop.passage.t_enter;
    bundle.entry_axis[ray] = stop.passage.entry_axis;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bundle.arrival[axis][ray] = stop.passage.cell[axis];
    }
  });
}

}  // namespace

void find_next_stops(RayBundle& bundle, const Surroundings& surroundings, nodes::NodeId here, core::Operations& operations,
                     Row<std::uint32_t>& region) {
  if (surroundings.proxy.directory_doublings > 0) {
    find_next_stops_alone(bundle, surroundings, here, operations, region);
  } else {
    Ways(bundle, surroundings, here, operations, region).find();
  }
}

}  // namespace dmpc::dataflow
