// Light that waits to be sent to the host: gathered, and merged where successive deposits fall on the same pixel.
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
    std::uint32_t packet_entries = 1;  ///< per full packet
    std::uint32_t at_once = 1;         ///< deposits that may follow one test of waits(): 1 .. packet_entries
  };

  struct Counters {
    std::uint64_t deposits = 0;
    std::uint64_t entries = 0;    ///< sent
    std::uint64_t saturated = 0;  ///< deposits that saturated an entry's channel
  };

  /// Takes the credits.
  FilmGather(nodes::Node& node, const Capacity& capacity);
  /// The memory that the constructor takes for packets of `packet_entries`.
  static nodes::Room<std::byte> layout(std::uint32_t packet_entries) {
    return {core::MemoryUse::film_tiles, film_packet_bytes(packet_entries)};
  }

  /// Requires that waits() was false at most `at_once` deposits ago. Sends the packet if it has not enough free entries for as
  /// many more and a credit is left.
  void add(std::uint32_t pixel, std::uint32_t plane, const core::FixedColor& light);
  /// add() for light that is all that the pixel gets on this plane: consecutive pixels of a row with the same light share an
  /// entry, also if they come square by square (PixelOrder).
  void add_only(std::uint32_t pixel, std::uint32_t plane, const core::FixedColor& light);
  /// Sends the packet, full or not, if a credit is left.
  void flush();
  /// To be called when the host has taken a packet. Sends the one that waits.
  void acknowledged();

  /// Whether the packet is full, or has not enough free entries, and found no credit.
  bool waits() const { return count_ + at_once_ > entries_.size(); }
  /// Whether everything that was added has been sent and acknowledged.
  bool settled() const { return count_ == 0 && under_way_ == 0; }
  std::uint32_t gathered() const { return count_; }
  const Counters& counters() const { return counters_; }

 private:
  /// The entry for only this pixel and plane, or nullptr: among the newest of the open packet, since a pixel's deposits come
  /// together, or with those of the pixels of a bundle.
  FilmEntry* find(std::uint32_t pixel, std::uint32_t plane);
  FilmEntry* entry_before(std::uint32_t pixel, std::uint32_t plane, const core::FixedColor& light);
  void append(std::uint32_t pixel, std::uint32_t plane, const core::FixedColor& light);

  /// The number of entries that are searched.
  static constexpr std::uint32_t newest_entries = 32;

  nodes::Node* node_;
  nodes::NodeId host_;
  std::span<std::byte> packet_;   ///< in the form in which it is sent
  std::span<FilmEntry> entries_;  ///< in it
  std::uint32_t at_once_;
  std::uint32_t count_ = 0;
  std::uint32_t under_way_ = 0;
  Counters counters_;
};

}  // namespace dmpc::dataflow
