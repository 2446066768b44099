// The format of messages between ranks: frames, each a number and then items, packets of nodes and messages of ranks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "core/base/expect.h"
#include "nodes/packet.h"

namespace dmpc::nodes {

/// A rank's frames to another are numbered from 0, so that a lost one is detected when the next one arrives.
using FrameNumber = std::uint64_t;

/// The kind of an item.
enum class Item : std::uint8_t {
  packet,    ///< from a node to a node
  counts,    ///< Counts, of the sender's next wave
  text,      ///< a part of the text of the sender's messages
  closing,   ///< how the run has ended for the sender: its termination message of the run
  report,    ///< a part of a node's report after it
  reported,  ///< no more reports come from the sender

  rank_traffic,   ///< RankTraffic, of the sender, after the reports
  rank_report,    ///< a part of the sender's report after the run, in addition to its nodes'
  rank_reported,  ///< no more of that comes from it

  stream,          ///< from rank 0, before the run: a part of what a rank's nodes are made from
  stream_read,     ///< to rank 0: how many bytes of the stream have been read
  ready,           ///< to rank 0: all nodes are made
  clock_asked,     ///< from rank 0, before the start or after the run: asks for the receiver's clock
  clock_reported,  ///< to rank 0: the clock
  clocks_read,     ///< from rank 0, after the run: it asks no more
  start,           ///< from rank 0: all are ready, and what the receiver's clock showed when the run began
  failure,         ///< to rank 0: why no node is made, or no report
  dismissal        ///< from rank 0, its last message: the status with which all end
};

/// Precedes an item's bytes.
struct ItemHeader {
  std::uint32_t target = 0;  ///< the index of a packet's target, or of the node that a report is of
  PacketHeader packet;       ///< in other items only `bytes` is used
  Item item = Item::packet;

  /// Including the bytes that follow.
  std::size_t bytes() const { return sizeof(ItemHeader) + packet.bytes; }
};

/// The minimum length of frames; they are longer if a packet would not fit.
inline constexpr std::size_t frame_bytes_min = std::size_t{16} << 10U;

/// The length of a frame that holds at least one packet of this size.
constexpr std::size_t frame_bytes_for(std::size_t payload_bytes_max) {
  const std::size_t least = sizeof(FrameNumber) + sizeof(ItemHeader) + payload_bytes_max;
  return least > frame_bytes_min ? least : frame_bytes_min;
}

/// Writes a frame into a fabric's buffer.
class FrameWriter {
 public:
  /// Not begun: there is no buffer yet.
  FrameWriter() = default;
  FrameWriter(std::span<std::byte> room, FrameNumber number) : room_(room), used_bytes_(sizeof(number)) {
    std::memcpy(room.data(), &number, sizeof(number));
  }

  bool is_begun() const { return !room_.empty(); }
  bool has_room_for(const ItemHeader& header) const { return room_.size() - used_bytes_ >= header.bytes(); }
  void add(const ItemHeader& header, std::span<const std::byte> bytes) {
    core::expect(header.packet.bytes == bytes.size() && has_room_for(header), "an item fits its frame");
    std::memcpy(room_.data() + used_bytes_, &header, sizeof(header));
    if (!bytes.empty()) {
      std::memcpy(room_.data() + used_bytes_ + sizeof(header), bytes.data(), bytes.size());
    }
    used_bytes_ += header.bytes();
  }
  std::size_t used_bytes() const { return used_bytes_; }

 private:
  std::span<std::byte> room_;
  std::size_t used_bytes_ = 0;
};

/// Reads a message that is a value.
template <class T>
T value_of(std::span<const std::byte> bytes) {
  core::expect(bytes.size() == sizeof(T), "a word has the size of its kind");
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}
template <class T>
std::span<const std::byte> bytes_of(const T& value) {
  return std::as_bytes(std::span(&value, 1));
}

inline FrameNumber number_of(std::span<const std::byte> frame) {
  FrameNumber number = 0;
  core::expect(frame.size() >= sizeof(number), "a frame has a number");
  std::memcpy(&number, frame.data(), sizeof(number));
  return number;
}

/// Calls receive(header, bytes) for each item.
template <class Receive>
void for_each_item(std::span<const std::byte> frame, const Receive& receive) {
  for (std::size_t offset = sizeof(FrameNumber); offset < frame.size();) {
    ItemHeader header;
    core::expect(frame.size() - offset >= sizeof(header), "a frame's items are whole");
    std::memcpy(&header, frame.data() + offset, sizeof(header));
    core::expect(frame.size() - offset >= header.bytes(), "a frame's items are whole");
    receive(header, frame.subspan(offset + sizeof(header), header.packet.bytes));
    offset += header.bytes();
  }
}

}  // namespace dmpc::nodes
