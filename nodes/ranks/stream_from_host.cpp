#include "nodes/ranks/stream_from_host.h"

#include <algorithm>

#include "core/base/expect.h"
#include "nodes/ranks/dismissal.h"
#include "nodes/ranks/streams_to_ranks.h"

namespace dmpc::nodes {

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

/// Takes as much of what has come as is wanted. Tells rank 0 of each quarter of the window, so that it sends on.
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
  if (bytes_read_ - bytes_told_ >= window_.size() / 4) {
    say_read();
  }
  return taken;
}

void StreamFromHost::say_read() {
  const std::uint64_t bytes = bytes_read_ - bytes_told_;
  links_->say(0, Item::stream_read, bytes_of(bytes));
  bytes_told_ = bytes_read_;
}

void StreamFromHost::say_ready() {
  core::expect(count_ == 0, "what was sent to a rank is read");
  say_read();
  links_->say(0, Item::ready, {});
}

void StreamFromHost::look_after() {
  exchange_.turn([this](auto&&... item) { receive(item...); });
  links_->look_after();  // though others' signs of life have just come
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
