// Rays that found no credit: buffered in the host's large memory until their owners have free slots.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/base/expect.h"
#include "dataflow/packets.h"

namespace dmpc::dataflow {

/// Rays by owner, for each owner the newest first: a ray's children go before the rays that came earlier, so fewer rays are
/// buffered at once. Grows as rays arrive: the host refuses none. Thread safety: belongs to the host.
class BufferedRays {
 public:
  explicit BufferedRays(std::uint32_t node_count, std::uint32_t tested_objects = 0)
      : message_bytes_(ray_message_bytes(tested_objects)), newest_(node_count, none), counts_(node_count) {}

  void put(std::uint32_t owner, const RayMessage& message) {
    if (free_ == none) {
      free_ = static_cast<std::uint32_t>(older_.size());
      core::expect(free_ != none, "the host numbers the rays that it keeps");
      older_.push_back(none);
      messages_.resize(older_.size() * message_bytes_);
    }
    const std::uint32_t place = free_;
    free_ = older_[place];
    older_[place] = newest_.at(owner);
    std::memcpy(&messages_[place * message_bytes_], &message, message_bytes_);
    newest_[owner] = place;
    ++counts_[owner];
    high_water_ = std::max(high_water_, ++size_);
  }

  /// Removes the newest ray for `owner`. Requires that there is one.
  RayMessage take(std::uint32_t owner) {
    core::expect(counts_.at(owner) > 0, "a ray is forwarded that is kept");
    const std::uint32_t place = newest_[owner];
    newest_[owner] = older_[place];
    older_[place] = free_;
    free_ = place;
    --counts_[owner];
    --size_;
    RayMessage message;
    std::memcpy(&message, &messages_[place * message_bytes_], message_bytes_);
    return message;
  }

  std::uint64_t count(std::uint32_t owner) const { return counts_.at(owner); }
  std::uint64_t size() const { return size_; }
  /// The maximum number of rays that were buffered at once.
  std::uint64_t high_water() const { return high_water_; }
  /// Bytes of the heap for slots of rays, used or not: they never shrink. While their number grows, the old memory exists beside
  /// the new one for a moment.
  std::size_t store_bytes() const { return messages_.capacity() + older_.capacity() * sizeof(older_[0]); }

 private:
  static constexpr std::uint32_t none = 0xffffffffU;

  std::size_t message_bytes_;
  std::vector<std::byte> messages_;    ///< by slot
  std::vector<std::uint32_t> older_;   ///< by slot: the next of the same owner, or of the free list
  std::vector<std::uint32_t> newest_;  ///< by owner
  std::vector<std::uint64_t> counts_;
  std::uint32_t free_ = none;
  std::uint64_t size_ = 0, high_water_ = 0;
};

}  // namespace dmpc::dataflow
