#include "nodes/ranks/streams.h"

#include <algorithm>

#include "core/base/expect.h"
#include "nodes/ranks/dismissal.h"
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
  links_->look_after();  // even if others' heartbeats have just come
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

StreamFromHost::StreamFromHost(RankLinks& links) : links_(&links), exchange_(links), window_(stream_window_bytes) {
  core::expect(links.rank() != 0, "rank 0 has no stream to read");
}

void StreamFromHost::read(std::span<std::byte> into) {
  while (true) {
    into = into.subspan(take(into));
    if (into.empty()) {
      return;
    }
    exchange_.turn([this](auto&&... item) { receive(item...); });
  }
}

/// Takes up to as many bytes as wanted from what has come. Acknowledges each quarter of the window, so that rank 0 sends on.
std::size_t StreamFromHost::take(std::span<std::byte> into) {
  std::size_t taken = 0;
  while (taken < into.size() && count_ > 0) {
    const std::size_t part = std::min({into.size() - taken, count_, window_.size() - first_});
    std::copy_n(window_.begin() + static_cast<std::ptrdiff_t>(first_), part, into.begin() + static_cast<std::ptrdiff_t>(taken));
    first_ = (first_ + part) % window_.size();
    count_ -= part;
    taken += part;
  }
  bytes_read_ += taken;
  if (bytes_read_ - bytes_reported_ >= window_.size() / 4) {
    say_read();
  }
  return taken;
}

void StreamFromHost::say_read() {
  const std::uint64_t bytes = bytes_read_ - bytes_reported_;
  links_->say(0, Item::stream_read, bytes_of(bytes));
  bytes_reported_ = bytes_read_;
}

void StreamFromHost::say_ready() {
  core::expect(count_ == 0, "what was sent to a rank is read");
  say_read();
  links_->say(0, Item::ready, {});
}

void StreamFromHost::look_after() {
  exchange_.turn([this](auto&&... item) { receive(item...); });
  links_->look_after();  // even if others' heartbeats have just come
}

void StreamFromHost::receive(std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes) {
  if (header.item == Item::dismissal) {
    throw Dismissed{value_of<int>(bytes)};
  }
  core::expect(rank == 0 && header.item == Item::stream,
               "before the run rank 0 alone has something to say, and that is a stream");
  core::expect(count_ + bytes.size() <= window_.size(), "no more is under way than a rank has room for");
  const std::size_t end = (first_ + count_) % window_.size();
  const std::span<const std::byte> before_wrap = bytes.first(std::min(bytes.size(), window_.size() - end));
  std::copy(before_wrap.begin(), before_wrap.end(), window_.begin() + static_cast<std::ptrdiff_t>(end));
  std::copy(bytes.begin() + static_cast<std::ptrdiff_t>(before_wrap.size()), bytes.end(), window_.begin());
  count_ += bytes.size();
}

}  // namespace dmpc::nodes
