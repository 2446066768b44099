// trace(bundle, records): all rays' hits or exits, or absent record r; resumable at every record, with the bits of single rays.
#pragma once

#include <algorithm>
#include <bit>
#include <optional>
#include <type_traits>
#include <variant>

#include "core/base/expect.h"
#include "core/record/directory.h"
#include "core/record/records.h"
#include "core/trace/bundle.h"
#include "core/trace/bundle_kernel.h"
#include "core/trace/curved_lanes.h"
#include "core/trace/instance_bundle.h"
#include "core/trace/kernel.h"
#include "core/trace/operations.h"
#include "core/trace/placed_leaf.h"
#include "core/trace/skips.h"

namespace dmpc::core {

/// Traverses with bundles over one kind of records. The constructor's arguments outlive it. Not thread-safe; costs nothing to
/// make. `Bundle`: RayBundle, or InstanceBundle for a database with instances.
template <Records R, class Bundle = RayBundle>
class BundleTraversal {
 public:
  BundleTraversal(Bundle& bundle, R& records, const DatabaseHeader& header, const Skips& skips, Operations& operations,
                  const BundleSteps& steps = fastest_bundle_steps,
                  const BundleIntersectors& intersectors = fastest_bundle_intersectors)
      : bundle_(bundle),
        records_(records),
        header_(header),
        skips_(skips),
        operations_(operations),
        steps_(steps),
        intersectors_(intersectors) {}

  /// Goes on until every ray's traversal has ended (true), or a record is absent: bundle.absent. Then call again once it is
  /// present.
  bool run() {
    if (bundle_.stage == RayBundle::Stage::start) {
      start();
    }
    while (bundle_.stage != RayBundle::Stage::finished) {
      if (!(bundle_.stage == RayBundle::Stage::directory ? enter_cell()
            : header_.has_voxels()                       ? visit_list()
                                                         : visit_children())) {
        return false;
      }
    }
    return true;
  }

  /// Visits what bundle.next_rays may hit below bundle.next: all of its records are present.
  void visit_below() { expect(visit_waiting(), "whoever has a child's record has all that is below it"); }

  /// RayTraversal::first_leaf() for rays whose rows run() has filled, each from its cell and t_enter on, in a proxy that is fully
  /// present. Returns the rays that meet a leaf, with t in best.t. The rays' positions are not kept.
  RayMask find_first_leaves(RayMask rays) {
    expect(header_.region == Region{.high = bundle_.grid_size}, "a proxy is of the whole grid");
    bundle_.any = false;
    bundle_.region = header_.region;
    bundle_.is_whole = true;
    bundle_.alive = rays;
    next_cell();
    RayMask met = 0;
    while (bundle_.stage != RayBundle::Stage::finished) {
      if (bundle_.stage == RayBundle::Stage::directory) {
        expect(enter_cell(), "a proxy has its directory");
      } else {
        met |= first_leaves_in_cell();
      }
    }
    return met;
  }

 private:
  static constexpr bool may_go_inside = std::is_same_v<Bundle, InstanceBundle>;

  void start() {
    if constexpr (may_go_inside) {
      bundle_.is_inside = false;
    }
    bundle_.any = skips_.any_hit && bundle_.rays[0].kind == RayKind::shadow;
    steps_.enter(bundle_, header_.frame, header_.region);
    if (bundle_.count > 1) {
      ++operations_.bundles;
      operations_.rays_in_bundles += bundle_.count;
    }
    next_cell();
  }

  void next_cell() {
    bundle_.stage = bundle_.alive != 0 ? RayBundle::Stage::directory : RayBundle::Stage::finished;
    if (bundle_.alive != 0) {
      steps_.next_group(bundle_);
    }
  }

  /// The record that `wanted` rays need, looked up once.
  const std::byte* find(Address address, std::uint32_t wanted) {
    const std::byte* const record = records_.find(address);
    if (record == nullptr) {
      bundle_.absent = address;
    } else {
      operations_.skipped.bundles += wanted - 1;
    }
    return record;
  }

  /// The planes through which rays leave the box of all cells nearer to the bundle's than `reach`, clipped to `limits`.
  PlanesAhead planes_ahead(std::int32_t reach, const Region& limits) const {
    PlanesAhead ahead;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ahead.above[axis] = std::min(bundle_.cell[axis] + reach, limits.high[axis]);
      ahead.below[axis] = std::max(bundle_.cell[axis] - reach + finest_per_macro, limits.low[axis]);
    }
    return ahead;
  }

  /// Reads the directory entry of the bundle's cell.
  bool enter_cell() {
    const std::uint64_t index = directory_index(header_, bundle_.cell);
    const std::byte* const record = find(directory_address(header_, index), count_of(bundle_.group));
    if (record == nullptr) {
      return false;
    }
    const auto entry = read<DirectoryEntry>(record + directory_offset(index));
    if (entry.empty()) {
      pass(entry.radius());
      return true;
    }
    steps_.find_exits(bundle_, planes_ahead(finest_per_macro, bundle_.region));
    bundle_.waiting.count = 0;
    bundle_.next = BvhChild::bvh_node(entry.bvh_node());
    bundle_.next_rays = bundle_.group;
    bundle_.stage = RayBundle::Stage::child;
    return true;
  }

  /// Leaves the box of empty cells nearer than `radius`; 0: only other rays have something in this cell.
  void pass(std::int32_t radius) {
    const bool jumps = radius > 1;
    const Region limits = radius > 0 ? Region{.high = bundle_.grid_size} : bundle_.region;
    const PlanesAhead ahead = planes_ahead((jumps ? radius : 1) * finest_per_macro, limits);
    const Region around{.low = ahead.below, .high = ahead.above};
    steps_.find_exits(bundle_, ahead);
    operations_.cell_steps += count_of(bundle_.group);
    operations_.empty_cells += steps_.leave(bundle_, bundle_.group, ahead, jumps ? &around : nullptr);
    next_cell();
  }

  /// Visits the children of the cell that some rays meet, then leaves it.
  bool visit_children() {
    if (!visit_waiting()) {
      return false;
    }
    leave_cell(rays_done());
    return true;
  }

  /// Visits bundle.next and all that wait behind it.
  bool visit_waiting() {
    while (bundle_.next.found()) {
      const Address address = bundle_.next.address();
      const std::uint32_t wanted = count_of(bundle_.next_rays);
      const std::byte* const record = find(address, wanted);
      if (record == nullptr) {
        return false;
      }
      if constexpr (may_go_inside) {
        visit(record, address, wanted);
      } else {
        if (bundle_.next.is_leaf()) {
          test_leaf(record, address, wanted);
        } else {
          operations_.bvh_node_reads += wanted;
          intersectors_.meet_children(bundle_, *reinterpret_cast<const BvhNode*>(record), bundle_.next_rays);
        }
        intersectors_.take_child(bundle_);
      }
    }
    return true;
  }

  /// As in InstanceTraversal: handles a child and moves on to the next.
  void visit(const std::byte* record, Address address, std::uint32_t wanted) {
    const bool is_leaf = bundle_.next.is_leaf();
    const bool is_of_instances = is_leaf && !bundle_.is_inside && read<LeafHeader>(record).kind == PrimitiveKind::instance;
    if (is_of_instances && read<LeafHeader>(record).count == 0) {
      operations_.instance_entries += wanted;
      bundle_.enter(read<InstanceRecord>(record), address, header_.frame);
      place_.reset();
      return;
    }
    operations_.bvh_node_reads += is_leaf && !is_of_instances ? 0 : wanted;
    if (is_of_instances) {
      bundle_.meet_instances(record, !bundle_.any);
    } else if (!is_leaf) {
      meet_bvh_nodes(*reinterpret_cast<const BvhNode*>(record));
    } else {
      bundle_.is_inside ? test_placed(record, address, wanted) : test_leaf(record, address, wanted);
    }
    intersectors_.take_child(bundle_);
    if (bundle_.is_inside && !bundle_.next.found()) {
      bundle_.leave_mesh();
      intersectors_.take_child(bundle_);
    }
  }

  void meet_bvh_nodes(const BvhNode& bvh_node) {
    if (bundle_.is_inside) {
      bundle_.swap_rows();
      intersectors_.meet_children(bundle_, padded(bvh_node, bundle_.mesh_pad), bundle_.next_rays);
      bundle_.swap_rows();
    } else {
      intersectors_.meet_children(bundle_, bvh_node, bundle_.next_rays);
    }
  }

  void test_placed(const std::byte* record, Address leaf, std::uint32_t wanted) {
    if (!place_) {
      place_.emplace(bundle_.instance, header_.frame);
    }
    PlacedLeaf placed;
    operations_.placed_triangles += placed.place(record, *place_);
    const BundleHits before = bundle_.best;
    const RayMask found = bundle_.found;
    test_leaf(placed.record(), leaf, wanted);
    if (meets_vanished(placed, before)) {
      placed.take_vanished_away();
      bundle_.best = before;
      bundle_.found = found;
      test_leaf(placed.record(), leaf, wanted);
    }
    for_each_new(before, [&](std::size_t ray) {
      bundle_.best.lane[ray] = lane_in_instance(bundle_.best.lane[ray], bundle_.instance_address);
    });
  }

  bool meets_vanished(const PlacedLeaf& placed, const BundleHits& before) const {
    bool meets = false;
    for_each_new(before, [&](std::size_t ray) { meets = meets || placed.has_vanished(bundle_.best.lane[ray]); });
    return meets;
  }

  /// The tested rays whose hit has changed.
  template <class Visit>
  void for_each_new(const BundleHits& before, const Visit& visit) const {
    for (RayMask rays = bundle_.next_rays; rays != 0; rays &= rays - 1) {
      const auto ray = static_cast<std::size_t>(std::countr_zero(rays));
      if (bundle_.best.t[ray] != before.t[ray] || bundle_.best.primitive[ray] != before.primitive[ray]) {
        visit(ray);
      }
    }
  }

  /// RayTraversal::first_block_in_cell(), then leaves the cell. Boxes behind the first leaf are treated as those behind a hit.
  RayMask first_leaves_in_cell() {
    RayMask met = 0;
    if (header_.has_voxels()) {
      met = bundle_.group;
      set_first(met, bundle_.t_low);
      bundle_.next = BvhChild::none();
    }
    while (bundle_.next.found()) {
      if (bundle_.next.is_leaf()) {
        met |= bundle_.next_rays;
        set_first(bundle_.next_rays,
                  bundle_.waiting.t_enter[bundle_.waiting.count]);  // t_enter of the child that was taken last
      } else {
        const std::uint32_t wanted = count_of(bundle_.next_rays);
        operations_.bvh_node_reads += wanted;
        const std::byte* const record = find(bundle_.next.address(), wanted);
        intersectors_.meet_children(bundle_, *reinterpret_cast<const BvhNode*>(record), bundle_.next_rays);
      }
      intersectors_.take_child(bundle_);
    }
    leave_cell(met);
    return met;
  }

  void set_first(RayMask rays, const Row<float>& t) {
    for (; rays != 0; rays &= rays - 1) {
      const auto ray = static_cast<std::size_t>(std::countr_zero(rays));
      bundle_.best.t[ray] = t[ray];
    }
  }

  /// Tests the leaves in the voxel's list, as RayTraversal::visit_list() does, then leaves it.
  bool visit_list() {
    BvhChild& behind = bundle_.waiting.record[0];
    while (bundle_.next.found()) {
      const bool is_leaf = bundle_.next.is_leaf();
      const Address address = is_leaf ? bundle_.next.address() : reference_address(header_, bundle_.next.bits);
      const std::uint32_t wanted = count_of(bundle_.next_rays);
      const std::byte* const record = find(address, wanted);
      if (record == nullptr) {
        return false;
      }
      if (is_leaf) {
        const RayMask found = bundle_.found;
        test_leaf(record, address, wanted);
        if (bundle_.any) {
          operations_.skipped.any_hit += behind.found() ? count_of(bundle_.found & ~found) : 0;
          bundle_.next_rays &= ~bundle_.found;
        }
        bundle_.next = bundle_.next_rays != 0 ? behind : BvhChild::none();
      } else {
        const auto reference = read<VoxelReference>(record + reference_offset(bundle_.next.bits));
        behind = reference.is_last() ? BvhChild::none() : BvhChild{bundle_.next.bits + 1};
        bundle_.next = BvhChild::leaf(reference.leaf());
      }
    }
    leave_cell(rays_done());
    return true;
  }

  /// Rays that end at any hit and have one.
  RayMask rays_done() const { return bundle_.any ? bundle_.found : 0; }

  /// Takes the group's rays on, except those of `done`, whose traversal ends.
  void leave_cell(RayMask done) {
    const RayMask leaving = bundle_.group & ~done;
    bundle_.alive &= ~(bundle_.group & done);
    if (leaving != 0) {
      operations_.cell_steps += count_of(leaving);
      steps_.leave(bundle_, leaving, planes_ahead(finest_per_macro, bundle_.region), nullptr);
    }
    next_cell();
  }

  /// Tests the primitives of a leaf that `wanted` rays need.
  void test_leaf(const std::byte* record, Address leaf, std::uint32_t wanted) {
    const auto header = read<LeafHeader>(record);
    const RayMask rays = bundle_.next_rays, found = bundle_.found;
    const auto* rows = reinterpret_cast<const float*>(record + sizeof(LeafHeader));
    if (header.kind == PrimitiveKind::triangle && !header.has_plane()) {
      operations_.primitive_tests[0] += std::uint64_t{wanted} * header.count;
      intersectors_.hit_triangles(bundle_, {rows, header.count, header.shared_lanes}, leaf, rays);
      if (header.shared_lanes != 0) {
        test_shared(record, leaf, rays);
      }
    } else if (header.kind == PrimitiveKind::triangle) {
      test_apart(record, leaf, rays);
    } else {
      operations_.primitive_tests[static_cast<std::size_t>(header.kind)] += std::uint64_t{wanted} * header.count;
      hit_curved(bundle_, record, leaf, rays);
    }
    if (bundle_.any && bundle_.found != found) {
      operations_.skipped.any_hit += intersectors_.count_waiting(bundle_, bundle_.found & ~found);
    }
  }

  void test_apart(const std::byte* record, Address leaf, RayMask rays) {
    for (; rays != 0; rays &= rays - 1) {
      const auto ray = static_cast<std::size_t>(std::countr_zero(rays));
      Hit best = bundle_.best.of(ray);
      core::test_leaf(bundle_.rays[ray], bundle_.sheared(ray), record, leaf, best, operations_);
      if (best.t != bundle_.best.t[ray] || best.primitive != bundle_.best.primitive[ray]) {
        bundle_.best.set(ray, best);
        bundle_.found |= RayMask{1} << ray;
      }
    }
  }

  /// Triangles that share their planes: rare.
  [[gnu::noinline]] void test_shared(const std::byte* record, Address leaf, RayMask rays) {
    const auto header = read<LeafHeader>(record);
    const std::byte* const ids = ids_of(header, record);
    for (; rays != 0; rays &= rays - 1) {
      const auto ray = static_cast<std::size_t>(std::countr_zero(rays));
      float times[leaf_lanes];
      std::uint32_t hits =
          hit_shared_faces(bundle_.sheared(ray), record, bundle_.ignored_primitive[ray], bundle_.best.t[ray], times);
      for (; hits != 0; hits &= hits - 1) {
        const auto lane = static_cast<std::uint32_t>(std::countr_zero(hits));
        const auto id = read<std::uint32_t>(ids + lane * sizeof(std::uint32_t));
        if (times[lane] < bundle_.t_max[ray] && nearer(times[lane], id, bundle_.best.of(ray))) {
          bundle_.best.set(ray, {times[lane], id, leaf, lane});
          bundle_.found |= RayMask{1} << ray;
        }
      }
    }
  }

  Bundle& bundle_;
  R& records_;
  const DatabaseHeader& header_;
  const Skips& skips_;
  Operations& operations_;
  const BundleSteps& steps_;
  const BundleIntersectors& intersectors_;
  std::conditional_t<may_go_inside, std::optional<PlacedMesh>, std::monostate> place_;  ///< the instance that the bundle is in
};

/// Traverses the grid with the rays of `bundle` until each one's nearest hit in (0, t_max) is known (for shadow rays: any hit,
/// unless that skip is off), or it has left the region of `header`, or a record is absent (false). Then call again with the same
/// bundle once the record of bundle.absent is present. bundle.best, and where rays leave, have the bits that trace() finds for
/// each ray by itself; slightly more is counted, since a bundle visits children in one order for all its rays. Source: I. Wald,
/// P. Slusallek, C. Benthin, M. Wagner, "Interactive Rendering with Coherent Ray Tracing", Eurographics 2001.
template <Records R>
bool trace(RayBundle& bundle, R& records, const DatabaseHeader& header, const Skips& skips, Operations& operations) {
  return BundleTraversal<R>(bundle, records, header, skips, operations).run();
}
/// For a database with instances.
template <Records R>
bool trace(InstanceBundle& bundle, R& records, const DatabaseHeader& header, const Skips& skips, Operations& operations) {
  return BundleTraversal<R, InstanceBundle>(bundle, records, header, skips, operations).run();
}

}  // namespace dmpc::core
