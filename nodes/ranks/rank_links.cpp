#include "nodes/ranks/rank_links.h"

namespace dmpc::nodes {

RankLinks::RankLinks(Fabric& fabric, const RankSilence& silence, Idle idle) : fabric_(&fabric), silence_(silence), idle_(idle) {
  for (std::uint32_t rank = 0; rank < fabric.rank_count(); ++rank) {
    ways_.emplace_back(fabric, rank);
    peers_.push_back({.spoken_to = Clock::now()});
  }
}

void RankLinks::say(std::uint32_t rank, Item item, std::span<const std::byte> bytes, std::uint32_t target) {
  const std::size_t bytes_max = frame_bytes() / 2;  // so that others fit beside it
  do {
    const std::span<const std::byte> part = bytes.first(std::min(bytes.size(), bytes_max));
    ways_[rank].say({.target = target, .packet = {.bytes = static_cast<std::uint32_t>(part.size())}, .item = item}, part);
    bytes = bytes.subspan(part.size());
  } while (!bytes.empty());
}

void RankLinks::say_to_all(Item item, std::span<const std::byte> bytes) {
  for (std::uint32_t rank = 0; rank < ways_.size(); ++rank) {
    if (is_other(rank)) {
      say(rank, item, bytes);
    }
  }
}

bool RankLinks::flush() {
  bool has_sent = false;
  for (std::uint32_t rank = 0; rank < ways_.size(); ++rank) {
    if (is_other(rank) && ways_[rank].flush()) {
      peers_[rank].spoken_to = Clock::now();
      has_sent = true;
    }
  }
  return has_sent;
}

bool RankLinks::has_said_all() const {
  return std::all_of(ways_.begin(), ways_.end(), [](const RankWay& way) { return way.has_said_all(); });
}

FrameNumber RankLinks::note(const Arrival& arrival) {
  Peer& peer = peers_[arrival.rank];
  peer.heard = time_run();
  peer.reported = 0;
  const FrameNumber expected = peer.frames_taken;
  peer.frames_taken = number_of(arrival.frame) + 1;
  return expected;
}

void RankLinks::expect_number(FrameNumber expected, const Arrival& arrival) const {
  if (number_of(arrival.frame) != expected) {
    throw FabricError("a frame from " + name_of(arrival.rank) + " to " + name_of(rank()) + " is lost: number " +
                      std::to_string(number_of(arrival.frame)) + " came in place of number " + std::to_string(expected));
  }
}

RankLinks::Clock::duration RankLinks::time_run() {
  const Clock::time_point now = Clock::now();
  time_run_ += std::min<Clock::duration>(now - std::exchange(last_poll_, now), silence_.look_max());
  return time_run_;
}

void RankLinks::report_of_silence(std::uint32_t rank, Clock::duration silence) {
  const std::int64_t times = silence / silence_.reported;
  const bool is_first = fabric_->rank() == (rank == 0 ? 1U : 0U);
  if (is_first && listener_ && times > std::exchange(peers_[rank].reported, std::max(times, peers_[rank].reported))) {
    const auto seconds = [](Clock::duration time) {
      return std::to_string(std::chrono::duration_cast<std::chrono::seconds>(time).count()) + " s";
    };
    listener_(name_of(rank) + ": nothing has been heard of it for " + seconds(times * silence_.reported) +
              "; it is waited for until that is " + seconds(silence_.longest));
  }
}

void RankLinks::look_after() {
  const Clock::duration run = time_run();
  const Clock::time_point now = last_poll_;
  for (std::uint32_t rank = 0; rank < ways_.size(); ++rank) {
    if (!is_other(rank)) {
      continue;
    }
    if (now - peers_[rank].spoken_to > silence_.heartbeat) {
      ways_[rank].send_heartbeat();
      peers_[rank].spoken_to = now;
    }
    report_of_silence(rank, run - peers_[rank].heard);
    if (run - peers_[rank].heard > silence_.longest) {
      throw LostRank(name_of(rank) + " is lost: nothing has been heard of it for " + std::to_string(silence_.longest.count()) +
                     " ms");
    }
  }
}

RankLinks::Sent RankLinks::take_sent() {
  Sent sent;
  for (const RankWay& way : ways_) {
    sent.frames += way.frames();
    sent.bytes += way.bytes();
  }
  const Sent before = std::exchange(taken_, sent);
  return {sent.frames - before.frames, sent.bytes - before.bytes};
}

}  // namespace dmpc::nodes
