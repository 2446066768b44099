// Finished pixels on their way to the host: gathered until a packet is full or there is nothing else to do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/picture/film.h"
#include "nodes/layout.h"
#include "nodes/node.h"
#include "svm/packets.h"

namespace dmpc::svm {

/// For which pixels there is room.
struct FilmCapacity {
  nodes::NodeId host{};
  std::uint32_t packet_entries = 1;  ///< pixels in a full packet
  std::uint32_t credits = 1;         ///< packets that may be under way to the host
  std::uint32_t in_flight = 1;       ///< pixels that may all finish before a packet can leave
};

/// Never refuses a finished pixel: a pixel may start only while has_room_for() the pixels in flight and it. Thread safety:
/// none.
class FilmGather {
 public:
  /// Takes the credits for film packets.
  FilmGather(nodes::Node& node, const FilmCapacity& capacity);
  /// What the constructor takes.
  static nodes::Room<std::byte> layout(const FilmCapacity& capacity);

  bool has_room_for(std::uint32_t pixels) const { return count_ + pixels <= capacity(); }
  /// Adds a finished pixel, and sends a packet if one is full and a credit is left.
  void add(std::uint32_t pixel, const core::PixelSums& sums);
  /// Sends what is there, full or not, as far as the credits go.
  void flush();
  /// The host has taken a packet.
  void acknowledged();

  /// Everything that was added has been sent and acknowledged.
  bool settled() const { return count_ == 0 && under_way_ == 0; }
  std::uint32_t gathered() const { return count_; }
  std::uint32_t under_way() const { return under_way_; }

 private:
  std::uint32_t capacity() const { return static_cast<std::uint32_t>(room_.size() / sizeof(FilmEntry)) - header_entries; }
  bool send();
  std::byte* entry(std::uint32_t index) { return room_.data() + sizeof(FilmHeader) + index * sizeof(FilmEntry); }

  /// The header and the entries stand in one run of bytes; the header takes the room of one entry.
  static constexpr std::uint32_t header_entries = 1;

  nodes::Node* node_;
  nodes::NodeId host_;
  std::uint32_t packet_entries_;
  std::span<std::byte> room_;
  std::uint32_t count_ = 0;
  std::uint32_t under_way_ = 0;
};

}  // namespace dmpc::svm
