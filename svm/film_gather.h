// Finished pixels that wait to be sent to the host, until a packet is full or there is nothing else to do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/picture/film/film.h"
#include "nodes/layout.h"
#include "nodes/node.h"
#include "svm/packets.h"

namespace dmpc::svm {

/// Capacities of a FilmGather.
struct FilmCapacity {
  nodes::NodeId host{};
  std::uint32_t packet_entries = 1;  ///< per full packet
  std::uint32_t credits = 1;         ///< packets that may be in flight to the host
  std::uint32_t in_flight = 1;       ///< pixels that may all finish before a packet can leave
  std::uint32_t planes = 2;          ///< on which a pixel has light
};

/// Never refuses a finished pixel, nor a run of them: a pixel may start only while has_room_for() the pixels in flight and it.
/// Not thread-safe.
class FilmGather {
 public:
  /// Takes the credits for film packets.
  FilmGather(nodes::Node& node, const FilmCapacity& capacity);
  /// The memory that the constructor takes.
  static nodes::Room<std::byte> layout(const FilmCapacity& capacity);

  bool has_room_for(std::uint32_t entries) const { return entries <= room_left(); }
  /// Entries that may be added before one has been sent.
  std::uint32_t room_left() const { return capacity() - count_; }
  /// Adds a finished pixel, or `count` consecutive ones of the same light, and sends a packet if one is full and a credit is
  /// left. Each call takes one entry.
  void add(std::uint32_t pixel, const core::PixelSums& sums, std::uint32_t count = 1);
  /// Sends all entries, as far as the credits go.
  void flush();
  /// To be called when the host has taken a packet.
  void acknowledged();

  /// Whether everything that was added has been sent and acknowledged.
  bool settled() const { return count_ == 0 && under_way_ == 0; }
  /// Number of entries not yet sent.
  std::uint32_t gathered() const { return count_; }
  std::uint32_t under_way() const { return under_way_; }

 private:
  std::uint32_t capacity() const { return static_cast<std::uint32_t>(room_.size() / film_entry_bytes(planes_)) - header_entries; }
  bool send();
  std::byte* entry(std::uint32_t index) { return room_.data() + film_entry_offset(index, planes_); }

  /// The header and the entries are contiguous; the header takes the space of one entry.
  static constexpr std::uint32_t header_entries = 1;

  nodes::Node* node_;
  nodes::NodeId host_;
  std::uint32_t packet_entries_, planes_;
  std::span<std::byte> room_;
  std::uint32_t count_ = 0;
  std::uint32_t under_way_ = 0;
};

}  // namespace dmpc::svm
