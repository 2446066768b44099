#include "dataflow/rays/ray_task.h"

#include "core/base/expect.h"
#include "core/picture/memory_use.h"
#include "core/trace/traversal.h"

namespace dmpc::dataflow {

RayTask::RayTask(nodes::LocalMemory& memory, nodes::NodeId self, std::uint32_t waiting_max, std::uint32_t tested_objects,
                 bool has_instances)
    : self_(self), tested_(tested_objects), has_instances_(has_instances) {
  core::expect(tested_objects == 0 || !has_instances, "a list of tested objects names no place of a mesh");
  std::span<FlightWith<core::Cursor>> flight;
  std::span<FlightWith<core::InstanceCursor>> longer;
  std::tie(flight, longer, stack_) = layout(waiting_max, has_instances).in(memory);
  flight_ = has_instances ? static_cast<Flight*>(longer.data()) : flight.data();
  cursor_ = has_instances ? &longer.data()->cursor : &flight.data()->cursor;
}

nodes::Layout<RayTask::FlightWith<core::Cursor>, RayTask::FlightWith<core::InstanceCursor>, core::HitState> RayTask::layout(
    std::uint32_t waiting_max, bool has_instances) {
  return {{core::MemoryUse::ray_stacks, has_instances ? 0U : 1U},
          {core::MemoryUse::ray_stacks, has_instances ? 1U : 0U},
          {core::MemoryUse::ray_stacks, waiting_max}};
}

void RayTask::shoot(const core::Ray& ray) {
  core::expect(stage_ == Stage::none, "one ray at a time is under way");
  flight_->ray = ray;
  tested_.set({});
  stage_ = Stage::shot;
}

void RayTask::enter(const RayMessage& message) {
  core::expect(stage_ == Stage::none, "one ray at a time is under way");
  flight_->ray = message.ray;
  *cursor_ = core::arrive(message.passage());
  flight_->finder = nodes::NodeId{message.finder};
  flight_->block_at_finder = message.best.leaf;
  if (flight_->finder != self_) {
    cursor_->best.leaf = core::no_address;
  }
  tested_.set(message.tested);
  entered_cell_ = message.cell;
  stage_ = Stage::entered;
}

void RayTask::resume_hit(const RayMessage& message) {
  core::expect(stage_ == Stage::none, "one ray at a time is under way");
  core::expect(nodes::NodeId{message.finder} == self_, "a confirmed hit comes to its finder");
  push(message.ray, message.best);
}

void RayTask::trace(PartTracer& tracer, const core::DatabaseHeader& header, core::Operations& operations) {
  const bool is_here = stage_ == Stage::entered ? tracer.enter_taken_up(entered_cell_) : begin(tracer, header);
  core::expect(is_here || stage_ != Stage::entered, "a ray enters a region of the node's");
  if (is_here) {
    traced_ = walk(tracer, operations);
  }
  core::expect(traced_ != core::Traced::absent, "a node has every record of its region");
  stage_ = Stage::ended;
}

void RayTask::find_stops(const Surroundings& surroundings, core::Operations& operations) {
  if (traced_ != core::Traced::left) {
    return;
  }
  core::Cursor& cursor = *cursor_;
  const NextStop stop = next_stop(flight_->ray, core::passage_of(cursor), surroundings, self_, operations);
  traced_ = stop.traced;
  stop_ = stop.region;
  cursor.t_enter = stop.passage.t_enter;
  cursor.arrival = stop.passage.cell;
  cursor.entry_axis = stop.passage.entry_axis;
}

core::Traced RayTask::walk(PartTracer& tracer, core::Operations& operations) {
  if (has_instances_) {
    auto& cursor = static_cast<core::InstanceCursor&>(*cursor_);
    cursor.is_inside = false;
    return tracer.trace(flight_->ray, cursor, operations);
  }
  return tested_.capacity() > 0 ? trace_with_list(tracer, operations) : tracer.trace(flight_->ray, *cursor_, operations);
}

/// A leaf on the list is not tested again. The candidate's leaf is not put there, though the ray may meet it again in another
/// voxel: the node where it proves to be the hit then meets it itself, and the ray need not return to its finder.
core::Traced RayTask::trace_with_list(PartTracer& tracer, core::Operations& operations) {
  const core::ShearedRay sheared(flight_->ray);
  const auto test = [&](const std::byte* record, core::Address address, core::Hit& best) {
    const auto header = core::read<core::LeafHeader>(record);
    if (tested_.has(header.shared_name)) {
      tests_avoided_ += header.count;
    } else {
      core::test_leaf(flight_->ray, sheared, record, address, best, operations);
      if (best.leaf != address) {
        tested_.add(header.shared_name);
      }
    }
  };
  return tracer.trace(flight_->ray, *cursor_, operations, test);
}

/// Whether the ray starts in a region of the node. If not, it has left the region, or misses the grid.
bool RayTask::begin(PartTracer& tracer, const core::DatabaseHeader& header) {
  const auto passage = core::first_passage(flight_->ray, header.frame);
  flight_->finder = self_;
  *cursor_ = core::arrive(passage.value_or(core::Passage{}));
  const bool is_here = passage && tracer.enter(passage->cell);
  if (passage && !is_here) {
    cursor_->arrival = passage->cell;
  }
  traced_ = passage ? core::Traced::left : core::Traced::miss;
  return is_here;
}

void RayTask::shade_hit() {
  core::expect(found_here(), "a hit is shaded where its leaf is");
  push(flight_->ray, cursor_->best);
}

/// Uses the slot of hits that need nothing more.
void RayTask::push(const core::Ray& ray, const core::Hit& hit) {
  depth_ = core::waiting_count(stack_, depth_);
  core::expect(depth_ < stack_.size(), "the ray stack holds the hits that wait");
  stack_[depth_++] = core::begin_shading(ray, hit);
}

core::Hit RayTask::travelling_candidate() const {
  core::Hit candidate = cursor_->best;
  if (!found_here()) {
    candidate.leaf = flight_->block_at_finder;
  }
  return candidate;
}

RayMessage RayTask::leaving() const {
  core::Passage passage = core::passage_of(*cursor_);
  passage.best = travelling_candidate();
  RayMessage message = message_of(flight_->ray, passage, finder_of_candidate());
  message.tested = tested_.names();
  return message;
}

RayMessage RayTask::confirmed_hit() const {
  core::expect(cursor_->best.found() && !found_here(), "a hit found here is shaded here");
  RayMessage message = message_of(flight_->ray, {.best = travelling_candidate()}, flight_->finder);
  message.is_confirmed = 1;
  return message;
}

}  // namespace dmpc::dataflow
