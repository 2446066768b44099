#include "dataflow/rays/bundle_task.h"

#include <utility>

#include "core/base/expect.h"
#include "core/picture/memory_use.h"
#include "core/trace/traversal.h"
#include "dataflow/rays/next_stop.h"

namespace dmpc::dataflow {

BundleTask::BundleTask(nodes::LocalMemory& memory, nodes::NodeId self, std::uint32_t waiting_max, bool has_instances)
    : self_(self), has_instances_(has_instances) {
  std::span<FlightsWith<core::RayBundle>> flights;
  std::span<FlightsWith<core::InstanceBundle>> longer;
  std::tie(flights, longer, stack_) = layout(waiting_max, has_instances).in(memory);
  flights_ = has_instances ? static_cast<Flights*>(longer.data()) : flights.data();
  bundle_ = has_instances ? &longer.data()->bundle : &flights.data()->bundle;
}

nodes::Layout<BundleTask::FlightsWith<core::RayBundle>, BundleTask::FlightsWith<core::InstanceBundle>, core::BundleHit>
BundleTask::layout(std::uint32_t waiting_max, bool has_instances) {
  return {{core::MemoryUse::ray_stacks, has_instances ? 0U : 1U},
          {core::MemoryUse::ray_stacks, has_instances ? 1U : 0U},
          {core::MemoryUse::ray_stacks, waiting_max}};
}

void BundleTask::shoot(const core::Ray& ray) {
  shoot_made([&ray](core::Ray& place) {
    place = ray;
    return true;
  });
}

/// Reads directly from the message: copying from a copy would have to wait for it.
void BundleTask::enter(std::span<const std::byte> message) {
  core::expect(count_ < (has_ended() ? ended_ : rays_max), "a bundle has room for its rays");
  core::expect(message.size() == ray_message_bytes(0), "rays of bundles have no lists with them");
  entered_ |= core::RayMask{1} << count_;
  get_field(message, offsetof(RayMessage, ray), bundle_->rays[count_]);
  auto& [passage, finder] = flights_->entry[count_++];
  get_field(message, offsetof(RayMessage, t_enter), passage.t_enter);
  get_field(message, offsetof(RayMessage, cell), passage.cell);
  get_field(message, offsetof(RayMessage, entry_axis), passage.entry_axis);
  get_field(message, offsetof(RayMessage, best), passage.best);
  std::uint16_t finder_index = 0;
  get_field(message, offsetof(RayMessage, finder), finder_index);
  finder = nodes::NodeId{finder_index};
}

void BundleTask::resume_hit(const RayMessage& message) {
  core::expect(nodes::NodeId{message.finder} == self_, "a confirmed hit comes to its finder");
  push(message.ray, message.best);
}

/// Moves waiting rays after those that were resumed since, each to its own slot or an earlier one.
void BundleTask::gather_waiting() {
  for (; waiting_ > 0; --waiting_, ++count_, ++traced_) {
    bundle_->rays[count_] = bundle_->rays[traced_];
    flights_->entry[count_] = flights_->entry[traced_];
    entered_ |= core::RayMask{1} << count_;
  }
}

/// Chooses the region of the first ray; keeps the previous one if the ray starts outside the node's regions.
void BundleTask::choose_region(PartTracer& tracer, const core::GridFrame& frame) {
  if ((entered_ & 1U) != 0) {
    const bool is_here = tracer.enter_taken_up(flights_->entry[0].passage.cell);
    core::expect(is_here, "a ray enters a region of the node's");
  } else if (const auto passage = core::first_passage(bundle_->rays[0], frame)) {
    tracer.enter(passage->cell);
  }
}

/// Moves the rays that enter another region to the end, where they wait.
void BundleTask::part_others(const core::Region& region) {
  for (std::uint32_t i = 0; i < count_;) {
    if ((entered_ >> i & 1U) == 0 || region.contains(flights_->entry[i].passage.cell)) {
      ++i;
      continue;
    }
    --count_;
    ++waiting_;
    std::swap(bundle_->rays[i], bundle_->rays[count_]);
    std::swap(flights_->entry[i], flights_->entry[count_]);
    const core::RayMask last = entered_ >> count_ & 1U, bit = core::RayMask{1} << i;
    entered_ = static_cast<core::RayMask>((entered_ & ~bit) | (last != 0 ? bit : 0));
  }
}

void BundleTask::trace(PartTracer& tracer, const core::DatabaseHeader& header, core::Operations& operations) {
  core::expect(!has_ended(), "rays that have ended are seen to before others are traced");
  gather_waiting();
  if (tracer.has_several_regions()) {
    choose_region(tracer, header.frame);
    part_others(tracer.region());
  }
  core::RayBundle& bundle = *bundle_;
  bundle.count = count_;
  bundle.start();
  for (std::uint32_t i = 0; entered_ != 0 && i < count_; ++i) {
    if ((entered_ >> i & 1U) != 0) {
      const auto& [passage, finder] = flights_->entry[i];
      const auto& [t, primitive, leaf, lane] = passage.best;
      bundle.arrive(
          i,
          {passage.t_enter, passage.cell, passage.entry_axis, {t, primitive, finder == self_ ? leaf : core::no_address, lane}});
    }
  }
  const bool is_here =
      has_instances_ ? tracer.trace(static_cast<core::InstanceBundle&>(bundle), operations) : tracer.trace(bundle, operations);
  core::expect(is_here, "a node has every record of its region");
  traced_ = count_;
  ended_ = count_ = 0;
  entered_ = 0;
  knows_stops_ = false;
}

void BundleTask::find_stops(const Surroundings& surroundings, core::Operations& operations) {
  core::expect(has_ended(), "rays go on that have been traced");
  if (!knows_stops_) {
    find_next_stops(*bundle_, surroundings, self_, operations, flights_->stop);
    knows_stops_ = true;
  }
}

core::Traced BundleTask::traced() const {
  const core::RayMask bit = core::RayMask{1} << ended_;
  return (bundle_->left & bit) != 0 ? core::Traced::left : (bundle_->found & bit) != 0 ? core::Traced::hit : core::Traced::miss;
}

void BundleTask::shade_hit() {
  core::expect(found_here(), "a hit is shaded where its leaf is");
  push(ray(), bundle_->hit(ended_));
}

/// Uses the slot of hits that need nothing more.
void BundleTask::push(const core::Ray& ray, const core::Hit& hit) {
  if (fresh_hits_ == 0) {
    depth_ = core::waiting_count(stack_, depth_);
  }
  core::expect(depth_ < stack_.size() && fresh_hits_ < rays_max, "the ray stack holds the bundles of hits that wait");
  core::BundleHit& hits = stack_[depth_];
  if (fresh_hits_ == 0) {
    hits.clear();
  }
  hits.add(ray, hit, fresh_hits_++);
}

/// Makes the pushed hits the next to be shaded.
void BundleTask::close_hits() {
  depth_ += fresh_hits_ > 0 ? 1 : 0;
  fresh_hits_ = 0;
}

core::Hit BundleTask::travelling_candidate() const {
  return found_here() || !bundle_->hit(ended_).found() ? bundle_->hit(ended_) : flights_->entry[ended_].passage.best;
}

nodes::NodeId BundleTask::finder_of_candidate() const { return found_here() ? self_ : flights_->entry[ended_].finder; }

RayMessage BundleTask::leaving() const {
  RayMessage message;
  put_leaving(std::as_writable_bytes(std::span(&message, 1)).first(ray_message_bytes(0)));
  return message;
}

/// Writes each value once: copying from a copy would have to wait for it.
void BundleTask::put_leaving(std::span<std::byte> place) const {
  core::expect(place.size() == ray_message_bytes(0), "rays of bundles have no lists with them");
  const core::RayBundle& bundle = *bundle_;
  put_field(place, offsetof(RayMessage, ray), ray());
  put_field(place, offsetof(RayMessage, t_enter), bundle.t_enter[ended_]);
  put_field(place, offsetof(RayMessage, cell),
            core::Corner{bundle.arrival[0][ended_], bundle.arrival[1][ended_], bundle.arrival[2][ended_]});
  put_field(place, offsetof(RayMessage, entry_axis), bundle.entry_axis[ended_]);
  put_field(place, offsetof(RayMessage, is_confirmed), std::uint8_t{0});
  put_field(place, offsetof(RayMessage, finder), static_cast<std::uint16_t>(nodes::index_of(finder_of_candidate())));
  put_field(place, offsetof(RayMessage, best), travelling_candidate());
}

RayMessage BundleTask::confirmed_hit() const {
  core::expect(traced() == core::Traced::hit && !found_here(), "a hit found here is shaded here");
  RayMessage message = message_of(ray(), {.best = travelling_candidate()}, finder_of_candidate());
  message.is_confirmed = 1;
  return message;
}

}  // namespace dmpc::dataflow
