// What happened in a run and when, as far as somebody wants to look at it: an instrument beside the computer, whose memory is no
// node's.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/observer.h"
#include "nodes/observers/recorded_times.h"
#include "nodes/ranks/clock_drift.h"

namespace dmpc::nodes {

/// What of a run is recorded: a window of time, what begins or ends in it, and of more events than there is room for how the
/// window begins and ends, and in between the same part of each period, at all nodes.
struct TraceChoice {
  std::uint64_t from_ns = 0;
  std::uint64_t to_ns = std::numeric_limits<std::uint64_t>::max();  ///< not included
  std::uint64_t events_max = 1'000'000;                             ///< spans, ends of messages and levels, of 110 bytes or so
};

/// A Span, cut where the window ends.
struct TraceSpan {
  static constexpr std::uint32_t no_item = 0xffffffffU;

  std::uint64_t begin_ns = 0, end_ns = 0;
  std::uint64_t own_ns = 0;  ///< as a Span's, of the whole
  std::uint64_t call = 0;
  std::uint32_t item = no_item;  ///< that was worked on, of several the first
  std::uint32_t depth = 0;       ///< of a Worked
  Activity activity = Activity::work;
  PacketKind packet = 0;
  ChargeBits charged = 0;
  bool is_cut = false;  ///< it began before the window, or ends after it
};

/// A packet from node to node, both of whose ends were recorded.
struct TraceMessage {
  NodeId source{}, target{};
  PacketKind kind = 0;
  std::uint32_t bytes = 0;       ///< of the payload
  std::uint32_t first_word = 0;  ///< of the payload: what many protocols say first, a number
  std::uint64_t sent_call = 0, received_call = 0;
  std::uint64_t sent_ns = 0, received_ns = 0;
};

/// A level that a program has had since a time.
struct TraceLevel {
  std::uint64_t time_ns = 0;
  std::uint64_t value = 0;
  std::uint32_t number = 0;  ///< index in TraceNode::level_names
};

/// What one node did, in order of time.
struct TraceNode {
  std::vector<TraceSpan> spans;  ///< what begins first comes first, and what lies within it behind it
  std::vector<std::string> level_names;
  std::vector<TraceLevel> levels;  ///< only where they change
};

struct Trace {
  std::vector<TraceNode> nodes;  ///< by number, the host last
  std::vector<TraceMessage> messages;
  std::uint64_t events_lost = 0;       ///< beyond TraceChoice::events_max
  std::optional<RecordedTimes> times;  ///< when nothing was lost, if something was
  /// On ranks, whose clocks are not quite alike: messages that seemed to be received before they were sent, and by how much at
  /// most. They are received when they are sent.
  std::uint64_t messages_moved = 0, moved_ns_max = 0;
};

/// Records. Half of the room for events is shared out evenly among the nodes, the other half is theirs who need it first. A node
/// whose room is full forgets some of what it has itself, so nobody waits for anybody.
/// Thread safety: as an Observer; take() when the run is over.
class TraceRecorder final : public Observer {
 public:
  /// `peer_count` = nodes + host.
  TraceRecorder(std::uint32_t peer_count, const TraceChoice& choice);
  ~TraceRecorder() override;

  void ended(const Span& span, const Program& program) override;
  void sent(const Passing& packet) override;
  void received(const Passing& packet) override;
  void worked(const Worked& worked) override;

  /// What the nodes have told, for add() of the recorder of another rank, which has the same choice.
  std::string bytes() const;
  /// Takes over what nodes have told that are on another rank, in times of this one.
  void add(std::string_view bytes, const ClockDrift& clock);

  /// What was recorded; call it once.
  Trace take();

 private:
  struct Log;
  struct End;
  struct Ends;

  bool overlaps_window(const Span& span) const;
  TraceSpan cut(Log& log, const Span& span) const;
  bool is_in_window(std::uint64_t time_ns) const { return choice_.from_ns <= time_ns && time_ns < choice_.to_ns; }
  bool admit(Log& log, std::uint64_t time_ns);
  bool gets_more_room();
  void make_room(Log& log, std::uint64_t now_ns);
  void thin(Log& log, std::uint64_t now_ns);
  std::optional<RecordedTimes> settle_times();
  void note_levels(Log& log, const Program& program, std::uint64_t time_ns);
  void note_end(Log& log, Ends& ends, const Passing& packet, std::uint64_t time_ns);
  std::vector<TraceMessage> join() const;
  std::uint64_t events_lost() const;

  TraceChoice choice_;
  std::vector<Log> logs_;
  std::uint64_t shared_room_ = 0;         ///< events, for whoever comes first
  std::atomic<std::uint64_t> taken_{0};   ///< of them, and what was asked for in vain
  std::atomic<std::uint32_t> period_{0};  ///< bits of the first to be thinned, and 1
};

}  // namespace dmpc::nodes
