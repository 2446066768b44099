// What rank 0 sends the others before the run, so that they can make their nodes: a stream to each, in bounded memory.
//
// A rank has memory for stream_window_bytes that it has not read yet, and reports what it has read; no more bytes are in flight
// to it, even if the network would take them. Nobody starts before rank 0 does (RanksRunner), which waits here until all are
// ready: so until then nothing else is in flight.
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

/// The maximum number of bytes of one rank's stream that are sent and not read.
inline constexpr std::size_t stream_window_bytes = std::size_t{512} << 10U;

/// Thread safety: belongs to the communicating thread of rank 0.
class StreamsToRanks {
 public:
  /// `links` outlive this.
  explicit StreamsToRanks(RankLinks& links);

  std::uint32_t rank_count() const { return links_->rank_count(); }
  /// Sends these bytes, after waiting until they may be sent. Throws what has failed on another rank, with its name; LostRank as
  /// RankLinks do.
  void write(std::uint32_t rank, std::span<const std::byte> bytes);
  /// Writes the number of bytes, then these: for read_counted().
  void write_counted(std::uint32_t rank, std::span<const std::byte> bytes);
  /// write_counted() for each other rank.
  void write_counted_to_all(std::string_view bytes);
  /// Writes the piece of `whole` from `offset_bytes` on: for a ByteSource.
  void write_piece(std::uint32_t rank, std::span<const std::byte> whole, std::size_t offset_bytes, std::size_t bytes);
  /// Waits until all ranks have read their streams, and are ready; then streams can be written for another run. Throws as write()
  /// does.
  void finish();
  /// Receives what has arrived, and sends heartbeats: to be called repeatedly while it does something else. Throws as write()
  /// does.
  void look_after();

 private:
  /// The state of one rank's stream.
  struct Stream {
    std::uint64_t written_bytes = 0, read_bytes = 0;
    bool is_ready = false;
  };

  void receive(std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes);

  RankLinks* links_;
  Exchange exchange_;
  std::vector<Stream> streams_;  ///< by rank; the first is unused
};

/// The other end of StreamsToRanks. Holds no more than stream_window_bytes. Thread safety: belongs to the communicating thread.
class StreamFromHost final : public ByteStream {
 public:
  /// `links` outlive this.
  explicit StreamFromHost(RankLinks& links);

  /// Throws Dismissed if rank 0 ends the command instead, LostRank as RankLinks do.
  void read(std::span<std::byte> into) override;
  /// Reports that all is read and all nodes are made.
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
  std::vector<std::byte> window_;      ///< a ring: received and not read
  std::size_t first_ = 0, count_ = 0;  ///< range of the window
  std::uint64_t bytes_read_ = 0, bytes_reported_ = 0;
};

}  // namespace dmpc::nodes
