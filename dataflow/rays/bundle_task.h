// A bundle of rays of one kind on a node, with the hits from which they descend on this node.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/picture/hits/bundle_hit.h"
#include "core/trace/bundle.h"
#include "core/trace/instance_bundle.h"
#include "dataflow/packets.h"
#include "dataflow/rays/next_stop.h"
#include "dataflow/rays/ray_task.h"
#include "nodes/layout.h"
#include "nodes/local_memory.h"
#include "nodes/node_id.h"

namespace dmpc::dataflow {

/// RayTask for up to 16 rays: they are traced together, then handled one by one. The hits among them are shaded side by side, one
/// bundle of children at a time, each of which is traced to its end in the region before the next is made, and hits are popped
/// for their last one; so the stack holds at most the hits of one bundle per depth, with paths of one. A ray that has been
/// handled may go on in this region, and is then traced again with others. Thread safety: belongs to one node.
class BundleTask {
  struct Flights;
  template <class Bundle>
  struct FlightsWith;

 public:
  static constexpr std::uint32_t rays_max = core::bundle_rays_max;

  /// Idle. A stack of `waiting_max` bundles of hits: core::waiting_hits_max(). `has_instances`: the database has instances, and
  /// bundles are longer.
  BundleTask(nodes::LocalMemory& memory, nodes::NodeId self, std::uint32_t waiting_max, bool has_instances = false);
  /// The memory that the constructor takes.
  static nodes::Layout<FlightsWith<core::RayBundle>, FlightsWith<core::InstanceBundle>, core::BundleHit> layout(
      std::uint32_t waiting_max, bool has_instances = false);

  /// Whether rays are to be traced, once those that have ended are handled.
  bool has_rays() const { return count_ + waiting_ > 0; }
  /// Whether rays have been traced that the caller has not handled.
  bool has_ended() const { return ended_ < traced_; }
  /// Whether there is no ray, and no hit with further children.
  bool is_idle() const { return !has_rays() && !has_ended() && fresh_hits_ == 0 && depth_ == 0; }

  // See RayTask. At most rays_max rays and hits since trace() or next_children(), not counting rays that go on in this region:
  void shoot(const core::Ray& ray);
  template <class Make>
  const core::Ray* shoot_made(const Make& make);
  void enter(const RayMessage& message) { enter(std::as_bytes(std::span(&message, 1)).first(ray_message_bytes(0))); }
  void enter(std::span<const std::byte> message);
  void resume_hit(const RayMessage& message);

  /// Traces rays until each ends here or leaves its region, or does not start in it: rays that enter other regions of the node
  /// than the first one's wait for the next call. Requires that none has ended before.
  void trace(PartTracer& tracer, const core::DatabaseHeader& header, core::Operations& operations);

  /// Finds the next stops of those that have left their region and have not been handled: their ways may end, too. Once after
  /// trace().
  void find_stops(const Surroundings& surroundings, core::Operations& operations);

  // For the first of those that have ended:
  core::Traced traced() const;
  const core::Ray& ray() const { return bundle_->rays[ended_]; }
  bool found_here() const { return bundle_->hit(ended_).leaf != core::no_address; }
  void shade_hit();
  std::uint32_t stop() const { return flights_->stop[ended_]; }
  RayMessage leaving() const;
  void put_leaving(std::span<std::byte> place) const;
  RayMessage confirmed_hit() const;
  void drop_ended() { ++ended_; }

  /// Shades the newest hits until they make children (true), for each of which shoot(make) is called, or no hit is left (false):
  /// shoot may call make(ray) once, which returns whether there is a child. Requires that no ray is in progress.
  template <class Shoot, class Shine>
  bool next_children(PartTracer& tracer, const core::RenderSettings& settings, core::Operations& operations, const Shoot& shoot,
                     const Shine& shine);

 private:
  /// How a ray entered the region, if it did not start in it, and the address of its candidate's leaf if that is on another node.
  struct Entry {
    core::Passage passage;
    nodes::NodeId finder{};
  };
  /// Origins and destinations of rays.
  struct Flights {
    std::array<Entry, rays_max> entry;
    core::Row<std::uint32_t> stop;  ///< the numbers of the regions to which rays go
  };
  /// And the rays with their traversal.
  template <class Bundle>
  struct FlightsWith : Flights {
    Bundle bundle;
  };

  core::Hit travelling_candidate() const;
  nodes::NodeId finder_of_candidate() const;
  void push(const core::Ray& ray, const core::Hit& hit);
  void close_hits();
  void gather_waiting();
  void choose_region(PartTracer& tracer, const core::GridFrame& frame);
  void part_others(const core::Region& region);

  nodes::NodeId self_;
  bool has_instances_;
  Flights* flights_;
  core::RayBundle* bundle_;  ///< an InstanceBundle if the database has instances
  std::span<core::BundleHit> stack_;
  std::uint32_t depth_ = 0;       ///< bundles of hits on the stack, all of whose rays have ended
  std::uint32_t fresh_hits_ = 0;  ///< in the next one
  std::uint32_t count_ = 0;       ///< number of rays to be traced: the first ones
  core::RayMask entered_ = 0;     ///< rays to be traced that did not start here
  std::uint32_t waiting_ = 0;     ///< number of rays after the traced ones, to be traced in another region
  std::uint32_t ended_ = 0;       ///< number of rays that were traced and handled
  std::uint32_t traced_ = 0;      ///< number of rays that were traced
  bool knows_stops_ = false;      ///< for those that have left
};

/// Makes it in the slot where it is traced.
template <class Make>
const core::Ray* BundleTask::shoot_made(const Make& make) {
  core::expect(!has_ended() && count_ < rays_max, "a bundle has room for its rays");
  core::Ray& ray = bundle_->rays[count_];
  if (!make(ray)) {
    return nullptr;
  }
  flights_->entry[count_++].finder = self_;
  return &ray;
}

template <class Shoot, class Shine>
bool BundleTask::next_children(PartTracer& tracer, const core::RenderSettings& settings, core::Operations& operations,
                               const Shoot& shoot, const Shine& shine) {
  core::expect(!has_rays() && !has_ended(), "children are made when their parents' bundle has ended");
  close_hits();
  while ((depth_ = core::waiting_count(stack_, depth_)) > 0) {
    core::BundleHit& hits = stack_[depth_ - 1];
    core::Address absent = core::no_address;
    core::BundleShader<PartTracer> shader(hits, tracer, settings, operations);
    const bool is_here = shader.step(
        absent, [&](std::uint32_t, const auto& make) { shoot(make); },
        [&](const core::Color& light, std::uint32_t i) { shine(hits.hit[i].ray, light); });
    core::expect(is_here, "a node has every record of its region");
    if (has_rays()) {
      return true;
    }
  }
  return false;
}

}  // namespace dmpc::dataflow
