// What a rank is sent by rank 0 before the run: a stream from which its nodes are made.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nodes/byte_source.h"
#include "nodes/ranks/exchange.h"
#include "nodes/ranks/frame.h"
#include "nodes/ranks/rank_links.h"

namespace dmpc::nodes {

/// The other end of StreamsToRanks. Holds no more than stream_window_bytes. Thread safety: belongs to the communicating thread.
class StreamFromHost final : public ByteStream {
 public:
  /// `links` outlive this.
  explicit StreamFromHost(RankLinks& links);

  /// Throws Dismissed if rank 0 ends the command instead, LostRank as RankLinks do.
  void read(std::span<std::byte> into) override;
  /// All is read and all nodes are made.
  void say_ready();
  /// As StreamsToRanks::look_after(). Throws as read() does.
  void look_after();

  /// So far.
  std::uint64_t bytes_read() const { return bytes_read_; }

 private:
  void receive(std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes);
  std::size_t take(std::span<std::byte> into);
  void say_read();

  RankLinks* links_;
  Exchange exchange_;
  std::vector<std::byte> window_;      ///< a ring: what has come and is not read
  std::size_t first_ = 0, count_ = 0;  ///< of it
  std::uint64_t bytes_read_ = 0, bytes_told_ = 0;
};

}  // namespace dmpc::nodes
