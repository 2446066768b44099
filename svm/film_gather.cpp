#include "svm/film_gather.h"

#include <algorithm>
#include <cstring>

#include "core/base/expect.h"
#include "core/picture/memory_use.h"

namespace dmpc::svm {

/// A packet being gathered, then the pixels in flight, which may all finish before it can be sent, and the header.
nodes::Room<std::byte> FilmGather::layout(const FilmCapacity& capacity) {
  return {core::MemoryUse::film_tiles,
          film_entry_bytes(capacity.planes) * (std::size_t{capacity.packet_entries} + capacity.in_flight + header_entries)};
}

FilmGather::FilmGather(nodes::Node& node, const FilmCapacity& capacity)
    : node_(&node),
      host_(capacity.host),
      packet_entries_(capacity.packet_entries),
      planes_(capacity.planes),
      room_(layout(capacity).in(node.memory())) {
  node.grant(host_, bulk_channel, capacity.credits);
}

void FilmGather::add(std::uint32_t pixel, const core::PixelSums& sums, std::uint32_t count) {
  core::expect(has_room_for(1), "the gathered film has room for every pixel that was started");
  core::expect(planes_ == 2 || sums.plane[1] == core::FixedColor{}, "a pixel with one sample has light on one plane");
  put_film_entry(room_, count_, planes_, {pixel, count - 1, sums});
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

/// Sends the oldest entries, at most one packet, and moves the others to the front. Returns whether a credit was available.
bool FilmGather::send() {
  const FilmHeader header{std::min(count_, packet_entries_)};
  std::memcpy(room_.data(), &header, sizeof(header));
  const std::size_t bytes = film_packet_bytes(header.count, planes_);
  if (node_->credits(host_, bulk_channel) == 0 ||
      !node_->try_send(host_, bulk_channel, number_of(Kind::film_sums), std::span<const std::byte>(room_.first(bytes)))) {
    return false;
  }
  count_ -= header.count;
  std::memmove(entry(0), entry(header.count), count_ * film_entry_bytes(planes_));
  ++under_way_;
  return true;
}

}  // namespace dmpc::svm
