// One rank's link to another: the frame that is being filled, and messages that wait for space in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "nodes/ranks/fabric.h"
#include "nodes/ranks/frame.h"

namespace dmpc::nodes {

/// Thread safety: belongs to one thread at a time.
class RankWay {
 public:
  /// `fabric` outlives this.
  RankWay(Fabric& fabric, std::uint32_t rank) : fabric_(&fabric), rank_(rank) {}

  /// Puts a packet into the frame; false if there is no space while two frames are in flight.
  [[nodiscard]] bool put(const ItemHeader& header, std::span<const std::byte> bytes) {
    if (!has_room_for(header)) {
      return false;
    }
    frame_.add(header, bytes);
    return true;
  }

  /// A message of this rank: goes with the next frame that has space, in the order of such messages.
  void say(const ItemHeader& header, std::span<const std::byte> bytes) {
    words_.push_back({header, std::vector<std::byte>(bytes.begin(), bytes.end())});
  }

  /// Sends what there is, if the link is free; the next frame fills meanwhile. Returns whether anything was sent.
  bool flush() {
    while (!words_.empty() && has_room_for(words_.front().header)) {
      frame_.add(words_.front().header, words_.front().bytes);
      words_.pop_front();
    }
    return send();
  }

  /// Sends a frame, even an empty one.
  void send_heartbeat() {
    if (begin_frame()) {
      send();
    }
  }

  bool has_said_all() const { return words_.empty() && !frame_.is_begun(); }
  /// Frames sent so far, and their bytes.
  std::uint64_t frames() const { return number_; }
  std::uint64_t bytes() const { return bytes_; }

 private:
  struct Word {
    ItemHeader header;
    std::vector<std::byte> bytes;
  };

  bool begin_frame() {
    if (!frame_.is_begun()) {
      const std::span<std::byte> room = fabric_->room(rank_);
      frame_ = room.empty() ? FrameWriter() : FrameWriter(room, number_);
    }
    return frame_.is_begun();
  }

  /// In this frame, or in the next one after sending this one.
  bool has_room_for(const ItemHeader& header) {
    if (begin_frame() && !frame_.has_room_for(header)) {
      send();
      begin_frame();
    }
    return frame_.is_begun();
  }

  bool send() {
    if (!frame_.is_begun()) {
      return false;
    }
    fabric_->send(rank_, frame_.used_bytes());
    bytes_ += frame_.used_bytes();
    frame_ = {};
    ++number_;
    return true;
  }

  Fabric* fabric_;
  std::uint32_t rank_;
  FrameWriter frame_;
  FrameNumber number_ = 0;
  std::uint64_t bytes_ = 0;
  std::deque<Word> words_;
};

}  // namespace dmpc::nodes
