// The current ray or hit on a node, with the hits from which it descends on this node.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/expect.h"
#include "core/picture/pixel_task.h"
#include "dataflow/packets.h"
#include "dataflow/rays/next_stop.h"
#include "dataflow/rays/part_tracer.h"
#include "nodes/layout.h"
#include "nodes/local_memory.h"
#include "nodes/node_id.h"

namespace dmpc::dataflow {

/// Depth first: a hit is shaded one child at a time. A child that stays in the region is traced to its end, its own hit shaded
/// and so on, before the next is made, and a hit is popped for its last one; so the stack holds at most one hit per depth, with
/// paths one, for any number of lights. A child that leaves is sent on by the caller; nothing of it stays here. Thread safety:
/// belongs to one node.
class RayTask {
  struct Flight;
  template <class RayCursor>
  struct FlightWith;

 public:
  static constexpr std::uint32_t rays_max = 1;

  /// Idle. A stack of `waiting_max` hits: core::waiting_hits_max(). With `tested_objects` rays remember that number of tested
  /// leaves; `has_instances`: the database has instances, and rays have longer cursors. Not both.
  RayTask(nodes::LocalMemory& memory, nodes::NodeId self, std::uint32_t waiting_max, std::uint32_t tested_objects = 0,
          bool has_instances = false);
  /// The memory that the constructor takes.
  static nodes::Layout<FlightWith<core::Cursor>, FlightWith<core::InstanceCursor>, core::HitState> layout(
      std::uint32_t waiting_max, bool has_instances = false);

  /// Whether a ray is to be traced.
  bool has_rays() const { return stage_ == Stage::shot || stage_ == Stage::entered; }
  /// Whether a ray has been traced that the caller has not handled.
  bool has_ended() const { return stage_ == Stage::ended; }
  /// Whether there is no ray, and no hit with further children.
  bool is_idle() const { return stage_ == Stage::none && depth_ == 0; }

  // Requires that no ray is in progress:
  /// Takes up a ray that starts anywhere.
  void shoot(const core::Ray& ray);
  /// shoot() with the ray that make(ray) builds in any given ray and returns; nullptr if there is none.
  template <class Make>
  const core::Ray* shoot_made(const Make& make) {
    core::Ray ray;
    if (!make(ray)) {
      return nullptr;
    }
    shoot(ray);
    return &flight_->ray;
  }
  /// Takes up a ray that enters a region of the node. If its candidate was found on another node the leaf's address is cleared
  /// here, and kept for that node.
  void enter(const RayMessage& message);
  void enter(std::span<const std::byte> message) { enter(message_in(message)); }
  /// Takes up a hit of this node that another has confirmed.
  void resume_hit(const RayMessage& message);

  /// Traces the ray until it ends here or leaves its region, or does not start in one of the node's. No record is absent.
  void trace(PartTracer& tracer, const core::DatabaseHeader& header, core::Operations& operations);

  /// After trace(): finds where the ray goes next, if it has left its region: its way may end, too. Once per ray.
  void find_stops(const Surroundings& surroundings, core::Operations& operations);

  // After that:
  core::Traced traced() const { return traced_; }
  const core::Ray& ray() const { return flight_->ray; }
  /// Whether the hit's leaf was read on this node.
  bool found_here() const { return cursor_->best.leaf != core::no_address; }
  /// Takes up the hit that was found here.
  void shade_hit();
  /// The number of the region to which it goes.
  std::uint32_t stop() const { return stop_; }
  /// The message of the ray to that region's owner.
  RayMessage leaving() const;
  /// Writes it into the bytes of a message.
  void put_leaving(std::span<std::byte> place) const {
    const RayMessage message = leaving();
    copy_message(place.data(), &message, place.size());
  }
  /// The message of the hit to its finder.
  RayMessage confirmed_hit() const;
  nodes::NodeId finder() const { return flight_->finder; }
  /// Lanes of leaves that were not tested here, since they were on the ray's list.
  std::uint64_t tests_avoided() const { return tests_avoided_; }
  /// To be called when the caller has handled the ray.
  void drop_ended() { stage_ = Stage::none; }

  /// Shades the newest hit until it makes a child (true), for which shoot(make) is called, with make as in shoot_made(), or no
  /// hit is left (false). If that hit glows, shine(ray, light) is called with its ray, at most once. Requires that no ray is in
  /// progress.
  template <class Shoot, class Shine>
  bool next_children(PartTracer& tracer, const core::RenderSettings& settings, core::Operations& operations, const Shoot& shoot,
                     const Shine& shine) {
    core::Ray child;
    const bool has_child = next_child(tracer, settings, child, operations, shine);
    if (has_child) {
      shoot([&child](core::Ray& ray) {
        ray = child;
        return true;
      });
    }
    return has_child;
  }

 private:
  /// The progress of the current ray.
  enum class Stage : std::uint8_t { none, shot, entered, ended };

  /// A ray, and the address of its candidate's leaf if that is on another node.
  struct Flight {
    core::Ray ray;
    nodes::NodeId finder{};
    core::Address block_at_finder = core::no_address;
  };
  /// And its traversal.
  template <class RayCursor>
  struct FlightWith : Flight {
    RayCursor cursor;
  };

  /// The candidate for other nodes, with the finder's address.
  core::Hit travelling_candidate() const;
  nodes::NodeId finder_of_candidate() const { return found_here() ? self_ : flight_->finder; }
  void push(const core::Ray& ray, const core::Hit& hit);
  template <class Shine>
  bool next_child(PartTracer& tracer, const core::RenderSettings& settings, core::Ray& child, core::Operations& operations,
                  const Shine& shine);
  core::Traced walk(PartTracer& tracer, core::Operations& operations);
  core::Traced trace_with_list(PartTracer& tracer, core::Operations& operations);
  bool begin(PartTracer& tracer, const core::DatabaseHeader& header);

  nodes::NodeId self_;
  TestedObjects tested_;  ///< by the current ray
  std::uint64_t tests_avoided_ = 0;
  bool has_instances_;
  Flight* flight_;
  core::Cursor* cursor_;  ///< an InstanceCursor if the database has instances
  std::span<core::HitState> stack_;
  std::uint32_t depth_ = 0;      ///< hits on the stack
  core::Corner entered_cell_{};  ///< with Stage::entered: the finest cell
  Stage stage_ = Stage::none;
  core::Traced traced_ = core::Traced::miss;
  std::uint32_t stop_ = 0;
};

template <class Shine>
bool RayTask::next_child(PartTracer& tracer, const core::RenderSettings& settings, core::Ray& child, core::Operations& operations,
                         const Shine& shine) {
  core::expect(stage_ == Stage::none, "a child is made when its parent's ray has ended");
  const core::Shader shader(settings.header, settings.shade, settings.skips, operations, &settings.camera);
  while ((depth_ = core::waiting_count(stack_, depth_)) > 0) {
    core::HitState& hit = stack_[depth_ - 1];
    const core::Address address = core::record_needed(hit, settings.header);
    const std::byte* const record = address == core::no_address ? nullptr : tracer.find(address);
    const bool was_known = hit.has_surface(), has_child = shader.step(hit, record, child);
    if (shader.hits_glow() && !was_known && hit.has_surface()) {
      shine(hit.ray, shader.glow(hit));
    }
    if (has_child) {
      return true;
    }
  }
  return false;
}

}  // namespace dmpc::dataflow
