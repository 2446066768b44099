#include "nodes/ranks/streams_to_ranks.h"

#include <algorithm>

#include "core/base/expect.h"
#include "nodes/byte_source.h"
#include "nodes/ranks/failure.h"

namespace dmpc::nodes {

StreamsToRanks::StreamsToRanks(RankLinks& links) : links_(&links), exchange_(links), streams_(links.rank_count()) {
  core::expect(links.rank() == 0, "rank 0 sends the streams");
}

void StreamsToRanks::write(std::uint32_t rank, std::span<const std::byte> bytes) {
  Stream& stream = streams_.at(rank);
  const std::size_t item_bytes_max = links_->frame_bytes() / 2;
  while (!bytes.empty()) {
    const std::size_t window = stream_window_bytes - (stream.written_bytes - stream.read_bytes);
    const std::span<const std::byte> part = bytes.first(std::min({bytes.size(), item_bytes_max, window}));
    const ItemHeader header{.packet = {.bytes = static_cast<std::uint32_t>(part.size())}, .item = Item::stream};
    if (!part.empty() && links_->put(rank, header, part)) {
      stream.written_bytes += part.size();
      bytes = bytes.subspan(part.size());
    } else {
      exchange_.turn([this](auto&&... item) { receive(item...); });
    }
  }
}

void StreamsToRanks::write_counted(std::uint32_t rank, std::span<const std::byte> bytes) {
  const std::uint64_t count = bytes.size();
  write(rank, bytes_of(count));
  write(rank, bytes);
}

void StreamsToRanks::write_counted_to_all(std::string_view bytes) {
  for (std::uint32_t rank = 1; rank < rank_count(); ++rank) {
    write_counted(rank, std::as_bytes(std::span(bytes)));
  }
}

void StreamsToRanks::write_piece(std::uint32_t rank, std::span<const std::byte> whole, std::size_t offset_bytes,
                                 std::size_t bytes) {
  const PieceHeader header{offset_bytes, bytes};
  write(rank, bytes_of(header));
  write(rank, whole.subspan(offset_bytes, bytes));
}

void StreamsToRanks::finish() {
  const auto is_done = [this] {
    return std::all_of(streams_.begin() + 1, streams_.end(), [](const Stream& stream) { return stream.is_ready; });
  };
  exchange_.turn_until(is_done, [this](auto&&... item) { receive(item...); });
  std::for_each(streams_.begin(), streams_.end(), [](Stream& stream) { stream.is_ready = false; });
}

void StreamsToRanks::look_after() {
  exchange_.turn([this](auto&&... item) { receive(item...); });
  links_->look_after();  // though others' signs of life have just come
}

void StreamsToRanks::receive(std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes) {
  Stream& stream = streams_.at(rank);
  switch (header.item) {
    case Item::stream_read:
      stream.read_bytes += value_of<std::uint64_t>(bytes);
      core::expect(stream.read_bytes <= stream.written_bytes, "a rank reads what was written to it");
      return;
    case Item::ready:
      core::expect(stream.read_bytes == stream.written_bytes, "a rank that is ready has read all that is for it");
      stream.is_ready = true;
      return;
    case Item::failure:
      fail_as_said(links_->name_of(rank), bytes);
    default:
      core::expect(false, "before the run a rank says what it has read, that it is ready, or that it has failed");
  }
}

}  // namespace dmpc::nodes
