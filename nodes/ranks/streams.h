// What rank 0 sends the others before the run, so that they can make their nodes: a stream to each, in bounded room.
//
// A rank has room for stream_window_bytes that it has not read yet, and tells what it has read; so many bytes are under way to it
// at most, whatever the network would take. Nobody starts before rank 0 does (RanksRunner), which waits here until all are ready:
// so until then nothing else is under way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "nodes/byte_source.h"
#include "nodes/ranks/exchange.h"
#include "nodes/ranks/frame.h"
#include "nodes/ranks/rank_links.h"

namespace dmpc::nodes {

/// So much of one rank's stream may be sent and not read.
inline constexpr std::size_t stream_window_bytes = std::size_t{512} << 10U;

/// Thread safety: belongs to the communicating thread of rank 0.
class StreamsToRanks {
 public:
  /// `links` outlive this.
  explicit StreamsToRanks(RankLinks& links);

  std::uint32_t rank_count() const { return links_->rank_count(); }
  /// Sends these bytes, or waits until they may be sent. Throws what has failed on another rank, with its name; LostRank as
  /// RankLinks do.
  void write(std::uint32_t rank, std::span<const std::byte> bytes);
  /// How many there are, then these bytes: for read_counted().
  void write_counted(std::uint32_t rank, std::span<const std::byte> bytes);
  /// The same for each rank but this.
  void write_counted_to_all(std::string_view bytes);
  /// The piece of `whole` from `offset_bytes` on: for a ByteSource.
  void write_piece(std::uint32_t rank, std::span<const std::byte> whole, std::size_t offset_bytes, std::size_t bytes);
  /// Waits until all ranks have read what is for them, and are ready; then streams can be written for another run. Throws as
  /// write() does.
  void finish();
  /// Takes what has come, and shows that this rank lives: to be called again and again while it does something else. Throws as
  /// write() does.
  void look_after();

 private:
  /// What one rank's stream has come to.
  struct Stream {
    std::uint64_t written_bytes = 0, read_bytes = 0;
    bool is_ready = false;
  };

  void receive(std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes);

  RankLinks* links_;
  Exchange exchange_;
  std::vector<Stream> streams_;  ///< by rank; the first is nobody's
};

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
  std::uint64_t bytes_read_ = 0, bytes_reported_ = 0;
};

}  // namespace dmpc::nodes
