// What happened in a run and when, for inspection; an instrument outside of the computer, whose memory is no node's.
#pragma once

#include <atomic>
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

/// The part of a run that is recorded: a window of time, everything that begins or ends in it, and if there are more events than
/// memory, the begin and end of the window, and in between the same part of each period, at all nodes.
struct TraceChoice {
  std::uint64_t from_ns = 0;
  std::uint64_t to_ns = std::numeric_limits<std::uint64_t>::max();  ///< not included
  std::uint64_t events_max = 1'000'000;  ///< spans, ends of messages and levels, each of about 110 bytes
};

/// A Span, cut where the window ends.
struct TraceSpan {
  static constexpr std::uint32_t no_item = 0xffffffffU;

  std::uint64_t begin_ns = 0, end_ns = 0;
  std::uint64_t own_ns = 0;  ///< as a Span's, of the whole span
  std::uint64_t call = 0;
  std::uint32_t item = no_item;  ///< the item worked on, the first of several
  std::uint32_t depth = 0;       ///< as in Worked
  Activity activity = Activity::work;
  PacketKind packet = 0;
  ChargeBits charged = 0;
  bool is_cut = false;  ///< it began before the window, or ends after it
};

/// A packet from node to node, with both ends recorded.
struct TraceMessage {
  NodeId source{}, target{};
  PacketKind kind = 0;
  std::uint32_t bytes = 0;       ///< payload
  std::uint32_t first_word = 0;  ///< first word of the payload: a number in many protocols
  std::uint64_t sent_call = 0, received_call = 0;
  std::uint64_t sent_ns = 0, received_ns = 0;
};

/// A level of a program and its begin.
struct TraceLevel {
  std::uint64_t time_ns = 0;
  std::uint64_t value = 0;
  std::uint32_t number = 0;  ///< index in TraceNode::level_names
};

/// What one node did, in order of time.
struct TraceNode {
  std::vector<TraceSpan> spans;  ///< ordered by begin, enclosing spans before those within
  std::vector<std::string> level_names;
  std::vector<TraceLevel> levels;  ///< only where they change
};

struct Trace {
  std::vector<TraceNode> nodes;  ///< by number, the host last
  std::vector<TraceMessage> messages;
  std::uint64_t events_lost = 0;       ///< beyond TraceChoice::events_max
  std::optional<RecordedTimes> times;  ///< when nothing was lost, if something was
  /// On ranks, whose clocks differ slightly: messages that seemed to be received before they were sent, and the maximum
  /// difference. They are shown as received when they were sent.
  std::uint64_t messages_moved = 0, moved_ns_max = 0;
};

/// Recorder. Half of the memory for events is distributed evenly over the nodes, the other half goes to those that need it first.
/// A node whose memory is full drops some of its own events, so nodes never wait for each other. Thread safety: as an Observer;
/// take() when the run is over.
class TraceRecorder final : public Observer {
 public:
  /// `peer_count` = nodes + host.
  TraceRecorder(std::uint32_t peer_count, const TraceChoice& choice);
  ~TraceRecorder() override;

  void ended(const Span& span, const Program& program) override;
  void sent(const Passing& packet) override;
  void received(const Passing& packet) override;
  void worked(const Worked& worked) override;

  /// What the nodes have reported, for add() of another rank's recorder, which has the same choice.
  std::string bytes() const;
  /// Adds what nodes on another rank have reported, in times of this one.
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
  std::uint64_t shared_room_ = 0;         ///< events, for the first that need it
  std::atomic<std::uint64_t> taken_{0};   ///< events taken from it, including requests in vain
  std::atomic<std::uint32_t> period_{0};  ///< bits of the first one to be thinned, plus 1
};

}  // namespace dmpc::nodes
