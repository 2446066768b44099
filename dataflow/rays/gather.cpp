#include "dataflow/rays/gather.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "core/base/counts.h"
#include "core/base/expect.h"
#include "core/base/units.h"

namespace dmpc::dataflow {

using nodes::Category;
using nodes::NodeId;

Gather::Counters& Gather::Counters::operator+=(const Counters& more) {
  const std::uint64_t high_water = std::max(queue_high_water, more.queue_high_water);
  core::add_counts(*this, more).queue_high_water = high_water;
  return *this;
}

Gather::Gather(nodes::Node& node, const Capacity& capacity)
    : node_(&node),
      host_(NodeId{capacity.node_count}),
      ray_batch_(capacity.ray_batch),
      queue_capacity_(capacity.queue_packets),
      tested_objects_(capacity.tested_objects),
      open_packets_max_(capacity.open_packets_max()),
      asks_max_(capacity.asks_max()),
      shares_slots_(capacity.shares_slots),
      are_nodes_joined_(capacity.shares_slots || capacity.ray_credits > 0) {
  static_assert(nodes::begins_as_zeros<Owner>);
  std::tie(room_, slots_, owners_) = layout(capacity).in(node.memory());
  for (std::size_t slot = capacity.packets(); slot > 0; --slot) {
    release(static_cast<std::uint16_t>(slot));
  }
  for (std::uint32_t i = 0; capacity.ray_credits > 0 && i < capacity.node_count; ++i) {
    node.grant(NodeId{i}, ray_channel, NodeId{i} == node.id() ? 0 : capacity.ray_credits);
  }
  node.grant(host_, ray_channel, capacity.host_credits);
}

nodes::Layout<std::byte, Gather::Slot, Gather::Owner> Gather::layout(const Capacity& capacity) {
  const std::size_t stride = stride_bytes(ray_packet_bytes(capacity.ray_batch, capacity.tested_objects));
  return {{Category::queues, capacity.packets() * stride},
          {Category::queues, capacity.packets()},
          {Category::queues, capacity.node_count}};
}

std::size_t Gather::stride_bytes(std::size_t bytes) { return core::round_up(bytes, nodes::LocalMemory::alignment); }

std::uint32_t Gather::credits_returned(NodeId receiver, std::uint32_t count) {
  node_->grant(receiver, ray_channel, count);
  if (receiver == host_) {
    return 0;
  }
  if (shares_slots_) {
    core::expect(owner_at(receiver).has_asked == 1 && count == 1, "a place is granted to who asks for it");
    owner_at(receiver).has_asked = 0;
    --asked_;
    ask_others(receiver);
  }
  std::uint32_t sent = 0;
  for (; owner_at(receiver).first != none && has_credit(receiver); ++sent) {
    dequeue(receiver);
  }
  return sent + (ask_or_decline(receiver) ? 1 : 0);
}

bool Gather::wants_to_ask(NodeId owner) const {
  const Owner& target = owner_at(owner);
  return asks(has_rays_for(target), has_credit(owner), target.has_asked == 1);
}

/// Defers the request if the maximum number is outstanding.
void Gather::ask(NodeId owner) {
  if (!may_ask(asked_, asks_max_)) {
    has_put_off_asking_ = true;
    return;
  }
  owner_at(owner).has_asked = 1;
  ++asked_;
  send_control(*node_, owner, Kind::ask, Ask{});
}

/// An owner has answered a request: sends the deferred requests, beginning after that owner, so that each has its turn.
void Gather::ask_others(NodeId answering) {
  if (!std::exchange(has_put_off_asking_, false)) {
    return;
  }
  const auto count = static_cast<std::uint32_t>(owners_.size());
  for (std::uint32_t i = 1; i < count && !has_put_off_asking_; ++i) {
    const NodeId owner{(nodes::index_of(answering) + i) % count};
    if (owner != node_->id() && wants_to_ask(owner)) {
      ask(owner);
    }
  }
}

/// Called after any change of the rays here for `owner`, or of its credit. Returns whether a credit went back.
bool Gather::ask_or_decline(NodeId owner) {
  if (!shares_slots_) {
    return false;
  }
  if (wants_to_ask(owner)) {
    ask(owner);
  }
  const bool goes_back = declines(has_rays_for(owner_at(owner)), has_credit(owner));
  if (goes_back) {
    node_->send_reserved(owner, ray_channel, number_of(Kind::unused), Unused{});
  }
  return goes_back;
}

/// The slot for the next ray for the owner.
std::span<std::byte> Gather::place_for(NodeId owner) {
  core::expect(!waits(), "no ray is gathered while a packet waits");
  core::expect(owner != node_->id() && owner != host_, "a ray leaves for another node");
  if (owner_at(owner).open == none) {
    core::expect(free_ != none, "every owner finds a slot to be filled");
    const std::uint16_t slot = free_;
    free_ = slot_at(slot).next;
    set_open(owner, slot);
  }
  const std::uint16_t open = owner_at(owner).open;
  return ray_bytes_in(packet_in(open), slot_at(open).count, tested_objects_);
}

/// The ray has been written.
void Gather::added(NodeId owner, core::RayKind kind) {
  Slot& slot = slot_at(owner_at(owner).open);
  ++size_;
  ++owner_at(owner).pair.rays[static_cast<std::size_t>(kind)];
  if (++slot.count == ray_batch_) {
    closed_ = owner;
  } else if (must_close(open_count_, open_packets_max_)) {
    close_one();
  }
  ask_or_decline(owner);
}

/// An open packet is not sent by way of the host while it can wait for its owner's credit.
bool Gather::may_leave(NodeId owner) const { return owner_at(owner).open != none && (has_credit(owner) || !are_nodes_joined_); }

bool Gather::can_flush() const {
  bool can = false;
  for_each_open([&](std::uint32_t i) { can = can || may_leave(NodeId{i}); });
  return can;
}

/// In ascending order.
template <class Visit>
void Gather::for_each_open(const Visit& visit) const {
  for (std::uint32_t word = 0; 64 * word < owners_.size(); ++word) {
    for (std::uint64_t owners = open_[word]; owners != 0; owners &= owners - 1) {
      visit(64 * word + static_cast<std::uint32_t>(std::countr_zero(owners)));
    }
  }
}

void Gather::set_open(NodeId owner, std::uint16_t slot) {
  owner_at(owner).open = slot;
  open_count_ += slot == none ? -1U : 1U;
  const std::uint32_t i = nodes::index_of(owner);
  const std::uint64_t bit = std::uint64_t{1} << (i % 64);
  open_[i / 64] = slot == none ? open_[i / 64] & ~bit : open_[i / 64] | bit;
}

/// Among the owners for which `may` is true, the one whose open packet has most rays.
template <class May>
std::optional<NodeId> Gather::fullest(const May& may) const {
  std::optional<NodeId> found;
  std::uint16_t most = 0;
  for_each_open([&](std::uint32_t i) {
    if (const std::uint16_t count = slot_at(owners_[i].open).count; count > most && may(NodeId{i})) {
      most = count;
      found = NodeId{i};
    }
  });
  return found;
}

void Gather::flush() {
  closed_ = fullest([this](NodeId owner) { return may_leave(owner); });
  core::expect(closed_.has_value(), "an open packet is flushed that may leave");
  ++counters_.packets_flushed;
}

/// The next ray may need a packet of its own.
void Gather::close_one() {
  closed_ = fullest([this](NodeId owner) { return may_leave(owner); });
  closed_ = closed_ ? closed_ : fullest([](NodeId) { return true; });
  ++counters_.packets_flushed;
}

Way Gather::send() {
  core::expect(waits(), "a packet is sent that waits");
  const NodeId owner = *closed_;
  const bool has_room = are_nodes_joined_ && queued_ < queue_capacity_;
  const Way way = way_of(has_credit(owner), has_room, has_credit(host_));
  if (way == Way::wait) {
    return way;
  }
  if (way == Way::to_queue) {
    enqueue(owner);
  } else {
    transmit(owner, owner_at(owner).open, way == Way::to_host);
  }
  set_open(owner, none);
  closed_.reset();
  ask_or_decline(owner);
  return way;
}

void Gather::enqueue(NodeId owner) {
  Owner& target = owner_at(owner);
  slot_at(target.open).next = none;
  (target.first == none ? target.first : slot_at(target.last).next) = target.open;
  target.last = target.open;
  counters_.queue_high_water = std::max<std::uint64_t>(counters_.queue_high_water, ++queued_);
  ++counters_.packets_queued;
}

void Gather::dequeue(NodeId owner) {
  Owner& target = owner_at(owner);
  const std::uint16_t slot = target.first;
  target.first = slot_at(slot).next;
  --queued_;
  transmit(owner, slot, false);
}

std::span<std::byte> Gather::packet_in(std::uint16_t slot) const {
  const std::size_t bytes = ray_packet_bytes(ray_batch_, tested_objects_);
  return room_.subspan((slot - 1U) * stride_bytes(bytes), bytes);
}

void Gather::transmit(NodeId owner, std::uint16_t slot, bool overflows) {
  const std::uint16_t count = slot_at(slot).count;
  const RayPacketHeader header{count, static_cast<std::uint16_t>(nodes::index_of(owner)), rays_left_};
  const std::span<std::byte> packet = packet_in(slot).first(ray_packet_bytes(count, tested_objects_));
  std::memcpy(packet.data(), &header, sizeof(header));
  node_->send_reserved(overflows ? host_ : owner, ray_channel, number_of(overflows ? Kind::overflow : Kind::rays), packet);
  ++counters_.packets;
  counters_.rays += count;
  counters_.packets_overflowed += overflows ? 1 : 0;
  counters_.rays_overflowed += overflows ? count : 0;
  PairCounters& pair = owner_at(owner).pair;
  ++pair.packets;
  pair.rays_overflowed += overflows ? count : 0;
  size_ -= count;
  release(slot);
}

std::vector<SentToOwner> Gather::pairs() const {
  std::vector<SentToOwner> pairs;
  for (std::uint32_t i = 0; i < owners_.size(); ++i) {
    if (owners_[i].pair.rays_total() > 0) {
      pairs.push_back({owners_[i].pair, i});
    }
  }
  return pairs;
}

void Gather::release(std::uint16_t slot) {
  slot_at(slot) = {.next = free_};
  free_ = slot;
}

}  // namespace dmpc::dataflow
