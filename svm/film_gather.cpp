#include "svm/film_gather.h"

#include <algorithm>
#include <cstring>

#include "core/base/expect.h"
#include "core/picture/memory_use.h"

namespace dmpc::svm {

/// A packet that is being gathered, and behind it the pixels in flight, which may all finish before it can leave; and the
/// header.
nodes::Room<std::byte> FilmGather::layout(const FilmCapacity& capacity) {
  return {core::MemoryUse::film_tiles,
          sizeof(FilmEntry) * (std::size_t{capacity.packet_entries} + capacity.in_flight + header_entries)};
}

FilmGather::FilmGather(nodes::Node& node, const FilmCapacity& capacity)
    : node_(&node), host_(capacity.host), packet_entries_(capacity.packet_entries), room_(layout(capacity).in(node.memory())) {
  node.grant(host_, bulk_channel, capacity.credits);
}

void FilmGather::add(std::uint32_t pixel, const core::PixelSums& sums) {
  core::expect(has_room_for(1), "the gathered film has room for every pixel that was started");
  const FilmEntry finished{pixel, 0, sums};
  std::memcpy(entry(count_), &finished, sizeof(finished));
  ++count_;
  if (count_ >= packet_entries_) {
    send();
  }
}

void FilmGather::flush() {
  while (count_ > 0 && send()) {
  }
}

void FilmGather::acknowledged() {
  core::expect(under_way_ > 0, "the host acknowledges what was sent");
  --under_way_;
  node_->grant(host_, bulk_channel);
  if (count_ >= packet_entries_) {
    send();
  }
}

/// Sends the oldest entries, at most a packet full, and moves the others to the front. Returns whether a credit was left.
bool FilmGather::send() {
  const FilmHeader header{std::min(count_, packet_entries_)};
  std::memcpy(room_.data(), &header, sizeof(header));
  const std::size_t bytes = sizeof(header) + header.count * sizeof(FilmEntry);
  if (node_->credits(host_, bulk_channel) == 0 ||
      !node_->try_send(host_, bulk_channel, number_of(Kind::film_sums), std::span<const std::byte>(room_.first(bytes)))) {
    return false;
  }
  count_ -= header.count;
  std::memmove(entry(0), entry(header.count), count_ * sizeof(FilmEntry));
  ++under_way_;
  return true;
}

}  // namespace dmpc::svm
