// The backlog: rays that a node has received and not taken up, the deepest first.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/expect.h"
#include "core/trace/bundle.h"
#include "dataflow/flow_control.h"
#include "dataflow/packets.h"
#include "nodes/layout.h"
#include "nodes/local_memory.h"

namespace dmpc::dataflow {

/// A bounded set of rays in order of depth, and the account of the credits for their slots.
///
/// Rays that are taken together are stored together, so that their slots and bytes are found with few accesses.
///
/// Senders that share slots count as one. A sender's credit is a slot for one full packet. So of the packets that have come from
/// a sender, as many credits are withheld as the rays of it that are still here would fill; the others are owed to it. Thread
/// safety: belongs to one node.
class RayQueue {
  struct List;
  struct Sender;

 public:
  struct Capacity {
    std::uint32_t sender_count = 0;    ///< senders have indices below this
    std::uint32_t packets_each = 0;    ///< maximum by one sender's credits
    std::uint32_t packets = 0;         ///< maximum by all credits together
    std::uint32_t ray_batch = 1;       ///< rays in a full packet
    std::uint32_t depth_max = 1;       ///< rays have depths 1 .. depth_max
    bool are_kinds_apart = false;      ///< shadow rays of a depth are separate from its other rays
    std::uint32_t tested_objects = 0;  ///< names per ray

    std::uint32_t rays() const { return packets * ray_batch; }
    std::uint32_t lists() const { return (depth_max + 1) * (are_kinds_apart ? 2 : 1); }
    /// Number of rays that are stored together.
    std::uint32_t group_rays() const { return are_kinds_apart ? static_cast<std::uint32_t>(core::bundle_rays_max) : 1; }
    /// In each list that is used one group may not be full; none is empty.
    std::uint32_t groups() const {
      const std::uint32_t used = lists() - (are_kinds_apart ? 2 : 1);  // no ray has depth 0
      return std::min(rays(), (rays() + used * (group_rays() - 1)) / group_rays());
    }
    std::uint32_t slots() const { return groups() * group_rays(); }
  };

  /// Empty.
  RayQueue(nodes::LocalMemory& memory, const Capacity& capacity)
      : packets_each_(capacity.packets_each),
        ray_batch_(capacity.ray_batch),
        lists_a_depth_(capacity.are_kinds_apart ? 2 : 1),
        group_rays_(capacity.group_rays()),
        message_bytes_(ray_message_bytes(capacity.tested_objects)) {
    std::tie(rays_, from_, older_, lists_, senders_) = layout(capacity).in(memory);
    for (std::uint32_t group = capacity.groups(); group > 0; --group) {
      release(group - 1);
    }
  }
  /// The memory that the constructor takes.
  static nodes::Layout<std::byte, std::uint32_t, std::uint32_t, List, Sender> layout(const Capacity& capacity) {
    using nodes::Category;
    return {{Category::queues, capacity.slots() * ray_message_bytes(capacity.tested_objects)},
            {Category::queues, capacity.slots()},
            {Category::queues, capacity.groups()},
            {Category::queues, capacity.lists()},
            {Category::queues, capacity.sender_count}};
  }

  /// Takes a packet with `ray_count` rays from `sender`; put() them next.
  void accept_packet(std::uint32_t sender, std::uint32_t ray_count) {
    Sender& from = senders_[sender];
    core::expect(ray_count >= 1 && ray_count <= ray_batch_, "a packet of rays has rays, no more than a full one");
    core::expect(from.packets < packets_each_, "a sender's packets stay within its credits");
    ++from.packets;
  }

  void put(std::uint32_t sender, const RayMessage& message) {
    put(sender, std::as_bytes(std::span(&message, 1)).first(message_bytes_));
  }
  /// Copies a ray from a packet.
  void put(std::uint32_t sender, std::span<const std::byte> message) {
    const std::uint32_t list =
        lists_a_depth_ * depth_in(message) + (lists_a_depth_ > 1 && kind_in(message) == core::RayKind::shadow ? 1 : 0);
    core::expect(list < lists_.size(), "a ray is no deeper than the picture's depth");
    const std::uint32_t place = new_place(lists_[list]);
    copy_message(&rays_[place * message_bytes_], message.data(), message_bytes_);
    from_[place] = sender;
    last_ = std::max<std::uint32_t>(last_, list);
    ++senders_[sender].rays;
    high_water_ = std::max(high_water_, ++size_);
  }

  /// Removes the deepest ray, of equally deep ones the newest, and returns its sender; its bytes stay until the next put(). With
  /// kinds apart it is a shadow ray if there is one of that depth. Requires that there is a ray.
  std::span<const std::byte> take(std::uint32_t& sender) {
    core::expect(size_ > 0, "a ray is taken from a backlog that has one");
    while (lists_[last_].newest == none) {
      --last_;
    }
    return take_alike(sender);
  }
  /// Whether there is another ray of the same depth and kind as the last from take(). Requires no put() since.
  bool has_alike() const { return lists_[last_].newest != none; }
  /// Removes the newest of these.
  std::span<const std::byte> take_alike(std::uint32_t& sender) {
    core::expect(has_alike(), "a ray is taken from a backlog that has one");
    const std::uint32_t place = leave_newest_place(lists_[last_]);
    --size_;
    sender = from_[place];
    --senders_[sender].rays;
    return rays_.subspan(place * message_bytes_, message_bytes_);
  }
  /// The credits that `sender` can get back: of packets that its rays still here would not fill.
  std::uint32_t owed(std::uint32_t sender) const {
    return slots_freed(senders_[sender].packets, senders_[sender].rays, ray_batch_);
  }
  /// To be called when `count` of them, at most owed(), have been returned.
  void gave_back(std::uint32_t sender, std::uint32_t count) {
    core::expect(count <= owed(sender), "only credits that are owed are given back");
    senders_[sender].packets -= count;
  }

  bool empty() const { return size_ == 0; }
  std::uint32_t size() const { return size_; }
  std::uint32_t sender_count() const { return static_cast<std::uint32_t>(senders_.size()); }
  /// The maximum number of rays that were here at once.
  std::uint32_t high_water() const { return high_water_; }

 private:
  static constexpr std::uint32_t none = 0xffffffffU;

  /// Rays of one depth, and kind if they are apart. Only the newest group may have free slots.
  struct List {
    std::uint32_t newest = none;
    std::uint32_t count = 0;  ///< rays in it
  };

  std::uint32_t new_place(List& list) {
    if (list.newest == none || list.count == group_rays_) {
      core::expect(free_ != none, "a received ray has its place in the backlog");
      const std::uint32_t group = free_;
      free_ = older_[group];
      older_[group] = list.newest;
      list = {group, 0};
    }
    return list.newest * group_rays_ + list.count++;
  }
  std::uint32_t leave_newest_place(List& list) {
    const std::uint32_t group = list.newest, place = group * group_rays_ + --list.count;
    if (list.count == 0) {
      list = {older_[group], group_rays_};
      release(group);
    }
    return place;
  }
  void release(std::uint32_t group) {
    older_[group] = free_;
    free_ = group;
  }

  struct Sender {
    std::uint32_t packets = 0;  ///< received ones whose credits have not been returned
    std::uint32_t rays = 0;     ///< here
  };

  std::uint32_t packets_each_, ray_batch_, lists_a_depth_, group_rays_;
  std::size_t message_bytes_;
  std::span<std::byte> rays_;       ///< group by group
  std::span<std::uint32_t> from_;   ///< sender of each
  std::span<std::uint32_t> older_;  ///< by group: the next of the same list, or of the free list
  std::span<List> lists_;           ///< by depth, and by kind if they are apart
  std::span<Sender> senders_;
  std::uint32_t free_ = none;  ///< first free group
  std::uint32_t last_ = 0;     ///< no list after it has a ray
  std::uint32_t size_ = 0, high_water_ = 0;
};

}  // namespace dmpc::dataflow
