// Deposits on their way to the host: gathered, and merged where neighbours in time fall on the same pixel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/picture/film/film.h"
#include "core/picture/memory_use.h"
#include "dataflow/packets.h"
#include "nodes/layout.h"
#include "nodes/node.h"

namespace dmpc::dataflow {

/// One open packet. A full one that finds no credit waits, and meanwhile nothing may be added: the host acknowledges every packet
/// at once, so the wait is bounded. Thread safety: belongs to one node.
class FilmGather {
 public:
  struct Capacity {
    std::uint32_t node_count = 1;
    std::uint32_t credits = 1;         ///< for packets to the host, node `node_count`
    std::uint32_t packet_entries = 1;  ///< of a full packet
    std::uint32_t at_once = 1;         ///< deposits that may come after one look whether the packet waits: 1 .. packet_entries
  };

  struct Counters {
    std::uint64_t deposits = 0;
    std::uint64_t entries = 0;    ///< sent
    std::uint64_t saturated = 0;  ///< deposits that saturated an entry's channel
  };

  /// Takes the credits.
  FilmGather(nodes::Node& node, const Capacity& capacity);
  /// What the constructor takes for packets of so many entries.
  static nodes::Room<std::byte> layout(std::uint32_t packet_entries) {
    return {core::MemoryUse::film_tiles, film_packet_bytes(packet_entries)};
  }

  /// Requires that the packet did not wait before as many deposits as may come at once. Sends it if it has no room for as many
  /// more and a credit is left.
  void add(std::uint32_t pixel, std::uint32_t plane, const core::FixedColor& light);
  /// The same for light that is all that the pixel gets on this plane: pixels of a row that follow each other, and have the same,
  /// share an entry, also where they come square by square (PixelOrder).
  void add_only(std::uint32_t pixel, std::uint32_t plane, const core::FixedColor& light);
  /// Sends what is there, full or not, if a credit is left.
  void flush();
  /// The host has taken a packet. Sends the one that waits.
  void acknowledged();

  /// The packet is full, or has no room for what may come at once, and found no credit.
  bool waits() const { return count_ + at_once_ > entries_.size(); }
  /// Everything that was added has been sent and acknowledged.
  bool settled() const { return count_ == 0 && under_way_ == 0; }
  std::uint32_t gathered() const { return count_; }
  const Counters& counters() const { return counters_; }

 private:
  /// The entry for this plane of a pixel alone, or nullptr: among the newest of the open packet, since a pixel's deposits come
  /// together, or with those of the pixels of a bundle.
  FilmEntry* find(std::uint32_t pixel, std::uint32_t plane);
  FilmEntry* entry_before(std::uint32_t pixel, std::uint32_t plane, const core::FixedColor& light);
  void append(std::uint32_t pixel, std::uint32_t plane, const core::FixedColor& light);

  /// So many are looked at. Packets have fewer where rays walk alone, so there all are.
  static constexpr std::uint32_t newest_entries = 32;
  static_assert(newest_entries >= film_packet_entries);

  nodes::Node* node_;
  nodes::NodeId host_;
  std::span<std::byte> packet_;   ///< as it is sent
  std::span<FilmEntry> entries_;  ///< in it
  std::uint32_t at_once_;
  std::uint32_t count_ = 0;
  std::uint32_t under_way_ = 0;
  Counters counters_;
};

}  // namespace dmpc::dataflow
