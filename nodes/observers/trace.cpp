#include "nodes/observers/trace.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "core/base/expect.h"
#include "nodes/atomics.h"
#include "nodes/flat_bytes.h"
#include "nodes/program.h"

namespace dmpc::nodes {
namespace {

/// The number of packets so far, by peer and kind.
class Ordinals {
 public:
  std::uint32_t next(NodeId peer, PacketKind kind) { return count_[index_of(peer) * packet_kind_count + kind]++; }

 private:
  std::unordered_map<std::size_t, std::uint32_t> count_;  // its order is never visible
};

/// By begin; at equal times by the order of the calls.
bool is_before(const TraceSpan& a, const TraceSpan& b) {
  return std::tuple(a.begin_ns, a.call, a.activity) < std::tuple(b.begin_ns, b.call, b.activity);
}

}  // namespace

struct TraceRecorder::End {
  std::uint64_t time_ns = 0;
  std::uint32_t peer = 0, ordinal = 0;
  std::uint64_t call = 0;
  std::uint32_t bytes = 0, first_word = 0;
  PacketKind kind = 0;

  /// What the two ends of a message, and no others, have in common.
  using Name = std::tuple<std::uint32_t, std::uint32_t, PacketKind, std::uint32_t>;
  Name name(std::uint32_t source, std::uint32_t target) const { return {source, target, kind, ordinal}; }
};

/// The ends of messages that one node reported, either sent or received.
struct TraceRecorder::Ends {
  std::vector<End> kept;
  Ordinals count;
};

/// The reports of one node, on separate cache lines.
struct alignas(cache_line_bytes) TraceRecorder::Log {
  TraceNode node;
  Ends sent, received;
  std::array<std::uint64_t, Levels::count_max> levels{};
  TraceSpan current;                   ///< the current call's, with its work
  std::uint64_t room = 0;              ///< events that may be kept
  std::uint64_t lost = 0;              ///< number of events
  std::optional<RecordedTimes> times;  ///< if events were dropped

  std::uint64_t count() const { return node.spans.size() + node.levels.size() + sent.kept.size() + received.kept.size(); }
  bool is_empty() const { return count() == 0 && lost == 0; }
  /// The time of the event that `rank` events precede.
  std::uint64_t time_of(std::uint64_t rank) const {
    std::vector<std::uint64_t> times_ns;
    times_ns.reserve(count());
    const auto add = [&times_ns](const auto& events, auto time_ns) {
      std::transform(events.begin(), events.end(), std::back_inserter(times_ns),
                     [&](const auto& event) { return event.*time_ns; });
    };
    add(node.spans, &TraceSpan::begin_ns);
    add(node.levels, &TraceLevel::time_ns);
    add(sent.kept, &End::time_ns);
    add(received.kept, &End::time_ns);
    std::nth_element(times_ns.begin(), times_ns.begin() + static_cast<std::ptrdiff_t>(rank), times_ns.end());
    return times_ns[rank];
  }
  /// Drops events at other times.
  void leave(const RecordedTimes& left) {
    const std::uint64_t before = count();
    std::erase_if(node.spans, [&left](const TraceSpan& span) { return !left.has(span.begin_ns); });
    for (Ends* const ends : {&sent, &received}) {
      std::erase_if(ends->kept, [&left](const End& end) { return !left.has(end.time_ns); });
    }
    leave_levels(left);
    lost += before - count();
  }
  /// Reports the current levels again after a gap in the recorded times.
  void leave_levels(const RecordedTimes& left) {
    std::array<std::optional<TraceLevel>, Levels::count_max> passed;
    std::vector<TraceLevel> kept;
    std::uint64_t next_ns = 0;
    const auto report_passed = [&] {
      for (std::optional<TraceLevel>& level : passed) {
        if (level) {
          kept.push_back({next_ns, level->value, level->number});
          level.reset();
        }
      }
    };
    for (const TraceLevel& level : node.levels) {
      if (level.time_ns >= next_ns) {
        report_passed();
      }
      if (left.has(level.time_ns)) {
        kept.push_back(level);
      } else {
        passed[level.number] = level;
        next_ns = left.next(level.time_ns);
      }
    }
    report_passed();
    node.levels = std::move(kept);
  }
  void put(FlatWriter& flat) const {
    flat.put_all(node.spans);
    flat.put(node.level_names.size());
    for (const std::string& name : node.level_names) {
      flat.put_bytes(name);
    }
    flat.put_all(node.levels);
    flat.put_all(sent.kept);
    flat.put_all(received.kept);
    flat.put(lost);
    flat.put(times);
  }
  void take(FlatReader& flat) {
    node.spans = flat.take_all<TraceSpan>();
    for (auto left = flat.take<std::size_t>(); left > 0; --left) {
      node.level_names.emplace_back(flat.take_bytes());
    }
    node.levels = flat.take_all<TraceLevel>();
    sent.kept = flat.take_all<End>();
    received.kept = flat.take_all<End>();
    lost = flat.take<std::uint64_t>();
    times = flat.take<std::optional<RecordedTimes>>();
  }
  /// Converts from the clock of the node's rank to that of rank 0.
  void correct(const ClockDrift& clock) {
    for (TraceSpan& span : node.spans) {
      span.begin_ns = clock.corrected(span.begin_ns);
      span.end_ns = std::max(span.begin_ns, clock.corrected(span.end_ns));
    }
    for (TraceLevel& level : node.levels) {
      level.time_ns = clock.corrected(level.time_ns);
    }
    for (Ends* const ends : {&sent, &received}) {
      for (End& end : ends->kept) {
        end.time_ns = clock.corrected(end.time_ns);
      }
    }
    if (times) {  // except its parts: near their edges events may be missing
      times->whole_until_ns = clock.corrected(times->whole_until_ns);
      times->whole_from_ns = clock.corrected(times->whole_from_ns);
    }
  }
};

TraceRecorder::TraceRecorder(std::uint32_t peer_count, const TraceChoice& choice) : choice_(choice), logs_(peer_count) {
  const std::uint64_t own_room = choice.events_max / 2 / peer_count;
  shared_room_ = choice.events_max - own_room * peer_count;
  for (Log& log : logs_) {
    log.room = own_room;
  }
}

TraceRecorder::~TraceRecorder() = default;

bool TraceRecorder::gets_more_room() { return taken_.fetch_add(1, std::memory_order_relaxed) < shared_room_; }

/// Whether there is memory for one more event, if necessary after dropping others.
bool TraceRecorder::admit(Log& log, std::uint64_t time_ns) {
  if (log.count() < log.room) {
    return true;
  }
  if (gets_more_room()) {
    ++log.room;
    return true;
  }
  make_room(log, time_ns);
  if (log.count() < log.room) {
    return true;
  }
  ++log.lost;
  return false;
}

void TraceRecorder::make_room(Log& log, std::uint64_t now_ns) {
  if (log.room == 0) {
    log.times = RecordedTimes{.whole_from_ns = now_ns + 1};
    return;
  }
  thin(log, now_ns);
  if (log.count() >= log.room - log.room / 8) {  // where nearly all events have one time
    log.times = RecordedTimes{.whole_from_ns = std::max(log.time_of(log.count() / 2), log.time_of(0) + 1)};
    log.leave(*log.times);
  }
}

/// An eighth of the memory is for the beginning of the run, another for the newest events, dropped only when they are older.
void TraceRecorder::thin(Log& log, std::uint64_t now_ns) {
  const std::uint64_t count = log.count();
  if (!log.times) {
    std::uint32_t period = 0;  // common to all nodes
    const std::uint32_t here = RecordedTimes::period_bits_at(now_ns) + 1;
    period = period_.compare_exchange_strong(period, here, std::memory_order_relaxed) ? here : period;
    log.times = RecordedTimes::begin(log.time_of(count / 8) + 1, period - 1);
  }
  log.times->whole_from_ns = log.time_of(count - count / 8 - 1);
  log.leave(*log.times);
  for (int i = 0; i < std::numeric_limits<std::uint64_t>::digits && log.count() > log.room - log.room / 4; ++i) {
    log.times->thin(now_ns);
    log.leave(*log.times);
  }
}

void TraceRecorder::worked(const Worked& worked) {
  Log& log = logs_[index_of(worked.node)];
  if (log.current.item == TraceSpan::no_item) {
    log.current.item = worked.item;
    log.current.depth = worked.depth;
  }
}

void TraceRecorder::ended(const Span& span, const Program& program) {
  Log& log = logs_[index_of(span.node)];
  const TraceSpan made = cut(log, span);
  if (span.is_own_call()) {
    note_levels(log, program, span.end_ns);
  }
  if (overlaps_window(span) && admit(log, made.begin_ns)) {
    log.node.spans.push_back(made);
  }
}

/// The current call's span with its work, if it is a call that works.
TraceSpan TraceRecorder::cut(Log& log, const Span& span) const {
  TraceSpan made;
  if (span.is_own_call()) {
    made = std::exchange(log.current, {});
  }
  made.begin_ns = std::max(span.begin_ns, choice_.from_ns);
  made.end_ns = std::min(span.end_ns, choice_.to_ns);
  made.is_cut = made.begin_ns != span.begin_ns || made.end_ns != span.end_ns;
  made.own_ns = span.own_ns;
  made.call = span.call;
  made.activity = span.activity;
  made.charged = span.charged();
  made.packet = span.packet;
  return made;
}

bool TraceRecorder::overlaps_window(const Span& span) const {
  return is_in_window(span.begin_ns) || (span.begin_ns < choice_.from_ns && span.end_ns > choice_.from_ns);
}

void TraceRecorder::note_levels(Log& log, const Program& program, std::uint64_t time_ns) {
  if (!is_in_window(time_ns)) {
    return;
  }
  const bool is_first = log.node.level_names.empty();
  std::uint32_t number = 0;
  for (const Level& level : program.levels()) {
    if (is_first) {
      log.node.level_names.emplace_back(level.name);
    }
    if ((std::exchange(log.levels[number], level.value) != level.value || is_first) && admit(log, time_ns)) {
      log.node.levels.push_back({time_ns, level.value, number});
    }
    ++number;
  }
}

void TraceRecorder::note_end(Log& log, Ends& ends, const Passing& packet, std::uint64_t time_ns) {
  const std::uint32_t ordinal = ends.count.next(packet.peer, packet.kind);
  if (is_in_window(time_ns) && admit(log, time_ns)) {
    ends.kept.push_back({.time_ns = time_ns,
                         .peer = index_of(packet.peer),
                         .ordinal = ordinal,
                         .call = packet.call,
                         .bytes = static_cast<std::uint32_t>(packet.payload_bytes()),
                         .first_word = packet.first_word(),
                         .kind = packet.kind});
  }
}

void TraceRecorder::sent(const Passing& packet) {
  Log& log = logs_[index_of(packet.node)];
  note_end(log, log.sent, packet, packet.times.sending_ns);
}

void TraceRecorder::received(const Passing& packet) {
  Log& log = logs_[index_of(packet.node)];
  note_end(log, log.received, packet, packet.times.received_ns);
}

/// All messages with both ends: of those of one kind between two nodes, the n-th ends are paired.
std::vector<TraceMessage> TraceRecorder::join() const {
  using Named = std::pair<End::Name, const End*>;
  std::vector<Named> sent, received;
  for (std::uint32_t i = 0; i < logs_.size(); ++i) {
    for (const End& end : logs_[i].sent.kept) {
      sent.emplace_back(end.name(i, end.peer), &end);
    }
    for (const End& end : logs_[i].received.kept) {
      received.emplace_back(end.name(end.peer, i), &end);
    }
  }
  std::sort(sent.begin(), sent.end());
  std::sort(received.begin(), received.end());
  std::vector<TraceMessage> messages;
  auto at = sent.begin();
  for (const auto& [name, end] : received) {
    at = std::find_if(at, sent.end(), [&name = name](const Named& other) { return other.first >= name; });
    if (at != sent.end() && at->first == name) {
      messages.push_back({.source = NodeId{std::get<0>(name)},
                          .target = NodeId{std::get<1>(name)},
                          .kind = end->kind,
                          .bytes = end->bytes,
                          .first_word = end->first_word,
                          .sent_call = at->second->call,
                          .received_call = end->call,
                          .sent_ns = at->second->time_ns,
                          .received_ns = end->time_ns});
    }
  }
  return messages;
}

std::string TraceRecorder::bytes() const {
  FlatWriter flat;
  for (std::uint32_t index = 0; index < logs_.size(); ++index) {
    if (!logs_[index].is_empty()) {
      flat.put(index);
      logs_[index].put(flat);
    }
  }
  return flat.take();
}

void TraceRecorder::add(std::string_view bytes, const ClockDrift& clock) {
  FlatReader flat(bytes);
  while (!flat.is_at_end()) {
    Log& log = logs_.at(flat.take<std::uint32_t>());
    core::expect(log.is_empty(), "a node is on one rank");
    log.take(flat);
    log.correct(clock);
  }
}

/// Sum over the recorders here and those added.
std::uint64_t TraceRecorder::events_lost() const {
  std::uint64_t lost = 0;
  for (const auto& log : logs_) {
    lost += log.lost;
  }
  return lost;
}

/// The times that all nodes have recorded; nothing if none has dropped anything.
std::optional<RecordedTimes> TraceRecorder::settle_times() {
  std::optional<RecordedTimes> times;
  for (const auto& log : logs_) {
    if (log.times && times) {
      times->meet(*log.times);
    } else if (log.times) {
      times = log.times;
    }
  }
  for (Log& log : logs_) {
    if (times) {
      log.leave(*times);
    }
  }
  return times;
}

namespace {

/// No message arrives before it is sent, although clocks of several ranks, synchronised with each other, may say so.
void move_early(Trace& trace) {
  for (TraceMessage& message : trace.messages) {
    if (message.received_ns < message.sent_ns) {
      ++trace.messages_moved;
      trace.moved_ns_max = std::max(trace.moved_ns_max, message.sent_ns - message.received_ns);
      message.received_ns = message.sent_ns;
    }
  }
}

}  // namespace

Trace TraceRecorder::take() {
  const std::optional<RecordedTimes> times = settle_times();
  Trace trace{.messages = join(), .times = times};
  move_early(trace);
  std::stable_sort(trace.messages.begin(), trace.messages.end(),
                   [](const TraceMessage& a, const TraceMessage& b) { return a.sent_ns < b.sent_ns; });
  trace.events_lost = events_lost();
  for (Log& log : logs_) {
    trace.nodes.push_back(std::move(log.node));
  }
  for (TraceNode& node : trace.nodes) {
    std::sort(node.spans.begin(), node.spans.end(), is_before);
  }
  return trace;
}

}  // namespace dmpc::nodes
