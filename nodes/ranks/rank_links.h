// One rank's links to all others: sending, receiving, and detection of lost ranks.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "nodes/ranks/backoff.h"
#include "nodes/ranks/fabric.h"
#include "nodes/ranks/frame.h"
#include "nodes/ranks/rank_way.h"

namespace dmpc::nodes {

/// Timeouts for lost ranks. Silence is measured in time in which this rank itself ran: if all were stopped, as clusters do with
/// waiting jobs, none was silent.
struct RankSilence {
  std::chrono::milliseconds heartbeat{2'000};  ///< a rank with nothing to send sends a heartbeat after this time
  std::chrono::milliseconds longest{600'000};  ///< a rank that is silent this long is lost; debuggers and swapping take long
  std::chrono::milliseconds reported{30'000};  ///< each time a rank has been silent for this time that is reported
  /// A longer time between two checks means that this rank did not run, and counts only as this much.
  std::chrono::milliseconds look_max() const { return std::min(longest, reported) / 8; }
};

/// Thread safety: belongs to one thread at a time.
class RankLinks {
 public:
  /// `fabric` outlives this. Others initially have this one's `longest`.
  explicit RankLinks(Fabric& fabric, const RankSilence& silence = {}, Idle idle = Idle::sleep);

  std::uint32_t rank() const { return fabric_->rank(); }
  std::uint32_t rank_count() const { return fabric_->rank_count(); }
  std::string name_of(std::uint32_t rank) const { return fabric_->name_of(rank); }
  std::size_t frame_bytes() const { return fabric_->frame_bytes(); }
  /// What this thread does while nothing comes.
  Idle idle() const { return idle_; }

  /// Puts a packet into the frame for another rank; false if there is no space while two are in flight.
  [[nodiscard]] bool put(std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes) {
    return ways_[rank].put(header, bytes);
  }
  /// Sends a message of this rank, about node `target` if given; split into several if it is long.
  void say(std::uint32_t rank, Item item, std::span<const std::byte> bytes, std::uint32_t target = 0);
  void say_to_all(Item item, std::span<const std::byte> bytes);
  /// Sends what there is, as far as links are free. Returns whether anything was sent.
  bool flush();
  bool has_said_all() const;

  /// Takes some of the frames that have come and calls receive(rank, header, bytes) for each item. Returns whether there was one.
  /// Throws FabricError, when the items of a frame are received, if one before it is lost.
  template <class Receive>
  bool take(const Receive& receive) {
    int taken = 0;
    for (; taken < takes_at_once; ++taken) {
      const std::optional<Arrival> arrival = fabric_->take();
      if (!arrival) {
        break;
      }
      const FrameNumber expected = note(*arrival);
      for_each_item(arrival->frame,
                    [&](const ItemHeader& header, std::span<const std::byte> bytes) { receive(arrival->rank, header, bytes); });
      expect_number(expected, *arrival);
    }
    return taken > 0;
  }

  /// Sends heartbeats, and reports which rank it waits for; throws LostRank if one has been silent for too long.
  void look_after();
  /// Sets who gets "rank 1 on host b: ..." about a rank that is waited for: on rank 0, and on rank 1 about rank 0.
  void report_to(std::function<void(const std::string&)> listener) { listener_ = std::move(listener); }

  struct Sent {
    std::uint64_t frames = 0, bytes = 0;
  };
  /// What was sent since the last call.
  Sent take_sent();
  /// Memory for frames that are sent.
  std::size_t room_bytes() const { return 2 * frame_bytes() * (rank_count() - 1); }
  /// Memory for received frames.
  std::size_t arrival_bytes() const { return fabric_->arrival_bytes(); }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr int takes_at_once = 16;

  struct Peer {
    FrameNumber frames_taken = 0;
    Clock::duration heard{};    ///< by the time in which this rank ran
    std::int64_t reported = 0;  ///< how often its silence has been reported since
    Clock::time_point spoken_to;
  };

  /// Adds the time since the last call, as far as this rank ran, to its running time, and returns the total.
  Clock::duration time_run();

  bool is_other(std::size_t rank) const { return rank != fabric_->rank(); }
  /// Returns the number that the frame should have.
  FrameNumber note(const Arrival& arrival);
  void expect_number(FrameNumber expected, const Arrival& arrival) const;
  void report_of_silence(std::uint32_t rank, Clock::duration silence);

  Fabric* fabric_;
  RankSilence silence_;
  Idle idle_;
  std::vector<RankWay> ways_;  ///< by rank, this one included
  std::vector<Peer> peers_;    ///< likewise
  Clock::time_point last_poll_ = Clock::now();
  Clock::duration time_run_{};
  Sent taken_;
  std::function<void(const std::string&)> listener_;
};

}  // namespace dmpc::nodes
