#include "apps/frontend/show/trace/perfetto.h"

#include <algorithm>
#include <array>
#include <limits>
#include <ostream>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "apps/frontend/line/utf8.h"
#include "apps/frontend/show/trace/causal_order.h"
#include "apps/frontend/show/trace/wire.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// Numbers of the fields that are used, by the messages of Perfetto that have them.
namespace trace_field {
enum : std::uint32_t { packet = 1 };
}
namespace packet_field {
enum : std::uint32_t { timestamp = 8, sequence = 10, event = 11, interned = 12, flags = 13, track = 60 };
}
namespace track_field {
enum : std::uint32_t { uuid = 1, name = 2, process = 3, thread = 4, parent = 5, counter = 8 };
}
namespace process_field {
enum : std::uint32_t { pid = 1, sort_index = 3, name = 6 };
}
namespace thread_field {
enum : std::uint32_t { pid = 1, tid = 2, name = 5 };
}
namespace event_field {
enum : std::uint32_t {
  argument = 4,
  type = 9,
  name_id = 10,
  track = 11,
  name = 23,
  counter_value = 30,
  flow = 47,
  ending_flow = 48
};
}
namespace argument_field {
enum : std::uint32_t { name_id = 1, truth = 2, number = 3, text = 6, name = 10, text_id = 17 };
}
namespace interned_field {
enum : std::uint32_t { event_names = 2, argument_names = 3, argument_texts = 29 };
}
namespace entry_field {  // interned strings
enum : std::uint32_t { id = 1, text = 2 };
}
enum class EventType : std::uint8_t { slice_begin = 1, slice_end, instant, counter };
enum : std::uint64_t { state_cleared = 1, needs_state = 2 };

/// What slices and instants say of themselves; numbers of their names, from 1 on.
enum class Argument : std::uint8_t { own_ns = 1, packet, x, y, depth, cut, bytes };
constexpr std::array<const char*, 7> argument_names = {"own_ns", "packet", "x", "y", "depth", "cut", "bytes"};

/// What is no UTF-8 is replaced.
std::string utf8_of(std::string_view text) {
  std::string made;
  while (!text.empty()) {
    const std::size_t bytes = first_character(text).bytes;
    made += bytes == 0 ? std::string_view("\xef\xbf\xbd") : text.substr(0, bytes);
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return made;
}

/// A node's slices, each beginning where it is on top of those that last, with the ends of messages behind the beginning of what
/// sends or receives them.
class NodeOrder {
 public:
  NodeOrder(const nodes::TraceNode& node, std::uint32_t number, std::vector<TraceItem> ends)
      : node_(node), number_(number), ends_(std::move(ends)) {
    std::sort(ends_.begin(), ends_.end(), [](const TraceItem& a, const TraceItem& b) {
      return std::tie(a.time_ns, a.call, a.moment, a.index) < std::tie(b.time_ns, b.call, b.moment, b.index);
    });
  }

  std::vector<TraceItem> make() {
    for (std::uint32_t i = 0; i < node_.spans.size(); ++i) {
      const nodes::TraceSpan& span = node_.spans[i];
      close(span.begin_ns);
      notify_ends(span.begin_ns, span.call);
      add(span.begin_ns, TraceMoment::span_begin, i);
      open_.push_back(i);
    }
    close(std::numeric_limits<std::uint64_t>::max());
    notify_ends(std::numeric_limits<std::uint64_t>::max(), 0);
    return std::move(made_);
  }

 private:
  void add(std::uint64_t time_ns, TraceMoment moment, std::uint32_t index) {
    made_.push_back({.time_ns = time_ns, .node = number_, .call = node_.spans[index].call, .moment = moment, .index = index});
  }
  /// What is over by then.
  void close(std::uint64_t time_ns) {
    while (!open_.empty() && node_.spans[open_.back()].end_ns <= time_ns) {
      const nodes::TraceSpan& span = node_.spans[open_.back()];
      notify_ends(span.end_ns, span.call + 1);
      add(span.end_ns, TraceMoment::span_end, open_.back());
      open_.pop_back();
    }
  }
  /// Writes the ends before `time_ns`; at the same time those of earlier calls.
  void notify_ends(std::uint64_t time_ns, std::uint64_t call) {
    for (; reported_ < ends_.size() && std::tie(ends_[reported_].time_ns, ends_[reported_].call) < std::tie(time_ns, call);
         ++reported_) {
      made_.push_back(ends_[reported_]);
    }
  }

  const nodes::TraceNode& node_;
  std::uint32_t number_;
  std::vector<TraceItem> ends_, made_;
  std::vector<std::uint32_t> open_;
  std::size_t reported_ = 0;
};

/// Numbers of tracks. Those of the most events are small, since small numbers take fewer bytes.
class Tracks {
 public:
  explicit Tracks(const nodes::Trace& trace) : node_count_(trace.nodes.size()), next_(2 * node_count_ + 4) {
    for (const nodes::TraceNode& node : trace.nodes) {
      levels_.push_back(next_);
      next_ += node.level_names.size();
    }
  }

  static std::uint64_t of_node(std::uint64_t node) { return node + 1; }
  std::uint64_t of_run() const { return node_count_ + 1; }
  std::uint64_t of_times() const { return node_count_ + 2; }
  /// Id of the process of a node; the run follows the nodes.
  std::uint64_t of_process(std::uint64_t node) const { return node_count_ + 3 + node; }
  std::uint64_t of_level(std::uint64_t node, std::uint64_t number) const { return levels_[node] + number; }
  std::uint64_t next() { return next_++; }

 private:
  std::uint64_t node_count_, next_;
  std::vector<std::uint64_t> levels_;  ///< the first of each node
};

class PerfettoWriter {
 public:
  PerfettoWriter(const TraceView& view, std::ostream& output)
      : view_(view), output_(output), waits_(page_waits(view)), tracks_(view.trace) {}

  void write() {
    write_names();
    for (std::uint32_t node = 0; node < view_.trace.nodes.size(); ++node) {
      write_tracks(node);
    }
    write_run();
    write_wait_tracks();
    for (const TraceItem& item : items()) {
      write(item);
    }
  }

 private:
  /// Whether a packet has numbers of texts that are written once.
  enum class UsesNames : std::uint8_t { no, yes };

  /// What is in packet_.
  void end_packet(UsesNames uses_names = UsesNames::yes) {
    packet_.put(packet_field::sequence, 1);
    if (uses_names != UsesNames::no) {
      packet_.put(packet_field::flags, std::exchange(flags_, needs_state));
    }
    WireMessage whole;
    whole.put(trace_field::packet, packet_);
    output_.write(whole.bytes().data(), static_cast<std::streamsize>(whole.bytes().size()));
    packet_.clear();
  }

  /// Each text once; events have its number.
  void write_names() {
    WireMessage interned, entry;
    const auto add = [&](std::uint32_t field, std::uint64_t id, std::string_view text) {
      entry.clear();
      entry.put(entry_field::id, id);
      entry.put_bytes(entry_field::text, utf8_of(text));
      interned.put(field, entry);
    };
    for (std::size_t i = 0; i < span_texts_.size(); ++i) {
      if (span_texts_[i] != nullptr) {
        add(interned_field::event_names, i + 1, span_texts_[i]);
      }
    }
    for (std::size_t kind = 0; kind < view_.kind_names.size(); ++kind) {
      add(interned_field::event_names, name_of_kind(kind), view_.kind_names[kind]);
      add(interned_field::argument_texts, kind + 1, view_.kind_names[kind]);
    }
    for (std::size_t i = 0; i < argument_names.size(); ++i) {
      add(interned_field::argument_names, i + 1, argument_names[i]);
    }
    packet_.put(packet_field::interned, interned);
    end_packet();
  }
  std::uint64_t name_of_kind(std::size_t kind) const { return span_texts_.size() + 1 + kind; }

  void write_track(std::uint64_t uuid, std::uint64_t parent, std::string_view name, std::uint32_t kind = 0,
                   const WireMessage& what = {}) {
    WireMessage track;
    track.put(track_field::uuid, uuid);
    if (parent != 0) {
      track.put(track_field::parent, parent);
    }
    if (!name.empty()) {
      track.put_bytes(track_field::name, utf8_of(name));
    }
    if (kind != 0) {
      track.put(kind, what);
    }
    packet_.put(packet_field::track, track);
    end_packet();
  }

  /// Process numbers begin at 1: 0 is an idle processor's.
  void write_process(std::uint64_t number, std::string_view name) {
    WireMessage process;
    process.put(process_field::pid, number + 1);
    process.put(process_field::sort_index, number);
    process.put_bytes(process_field::name, name);
    write_track(tracks_.of_process(number), 0, "", track_field::process, process);
  }

  void write_tracks(std::uint32_t node) {
    const std::string name = node_name(view_, node);
    write_process(node, name);
    WireMessage thread;
    thread.put(thread_field::pid, node + 1);
    thread.put(thread_field::tid, node + 1);
    thread.put_bytes(thread_field::name, name);
    write_track(tracks_.of_node(node), tracks_.of_process(node), "", track_field::thread, thread);
    const std::vector<std::string>& levels = view_.trace.nodes[node].level_names;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      write_track(tracks_.of_level(node, i), tracks_.of_process(node), levels[i], track_field::counter);
    }
  }

  /// The run as a slice that says what there is to say of it, and when all was recorded.
  void write_run() {
    const std::uint64_t number = view_.trace.nodes.size(), end = end_ns(view_.trace);
    write_process(number, "run");
    write_track(tracks_.of_run(), tracks_.of_process(number), "run");
    WireMessage event = begun(EventType::slice_begin, tracks_.of_run());
    event.put_bytes(event_field::name, utf8_of(view_.clock));
    for (const auto& [name, text] : view_.remarks) {
      WireMessage argument;
      argument.put_bytes(argument_field::name, utf8_of(name));
      argument.put_bytes(argument_field::text, utf8_of(text));
      event.put(event_field::argument, argument);
    }
    write_event(0, event);
    write_event(end, begun(EventType::slice_end, tracks_.of_run()));
    const std::vector<TraceStretch> stretches = recorded_stretches(view_.trace);
    if (!stretches.empty()) {
      write_track(tracks_.of_times(), tracks_.of_process(number), "recorded");
    }
    for (const TraceStretch& stretch : stretches) {
      WireMessage begin = begun(EventType::slice_begin, tracks_.of_times());
      begin.put_bytes(event_field::name, "recorded");
      write_event(stretch.begin_ns, begin);
      write_event(stretch.end_ns, begun(EventType::slice_end, tracks_.of_times()));
    }
  }

  /// Waits that lie over each other need tracks of their own: each takes the first of its node's that is free.
  void write_wait_tracks() {
    struct Lane {
      std::uint64_t track = 0, end_ns = 0;
    };
    std::vector<std::vector<Lane>> lanes(view_.trace.nodes.size());
    std::vector<std::size_t> order(waits_.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      order[i] = i;
    }
    std::stable_sort(order.begin(), order.end(),
                     [this](std::size_t a, std::size_t b) { return waits_[a].begin_ns < waits_[b].begin_ns; });
    wait_tracks_.resize(waits_.size());
    for (const std::size_t i : order) {
      const PageWait& wait = waits_[i];
      std::vector<Lane>& of_node = lanes[wait.node];
      auto lane = std::find_if(of_node.begin(), of_node.end(), [&](const Lane& free) { return free.end_ns < wait.begin_ns; });
      if (lane == of_node.end()) {
        lane = of_node.insert(lane, Lane{.track = tracks_.next()});
        write_track(lane->track, tracks_.of_process(wait.node), "waits for pages");
      }
      lane->end_ns = wait.end_ns;
      wait_tracks_[i] = lane->track;
    }
  }

  std::vector<TraceItem> items() const {
    std::vector<std::vector<TraceItem>> ends(view_.trace.nodes.size());
    std::vector<TraceItem> others;
    for (std::uint32_t node = 0; node < ends.size(); ++node) {
      for (std::uint32_t i = 0; const nodes::TraceLevel& level : view_.trace.nodes[node].levels) {
        others.push_back({level.time_ns, node, 0, TraceMoment::level, i++});
      }
    }
    for (std::uint32_t i = 0; const nodes::TraceMessage& message : view_.trace.messages) {
      const std::uint32_t source = index_of(message.source), target = index_of(message.target);
      ends[source].push_back({message.sent_ns, source, message.sent_call, TraceMoment::sent, i});
      ends[target].push_back({message.received_ns, target, message.received_call, TraceMoment::received, i++});
    }
    for (std::uint32_t i = 0; const PageWait& wait : waits_) {
      others.push_back({wait.begin_ns, wait.node, 0, TraceMoment::wait_begin, i});
      others.push_back({wait.end_ns, wait.node, 0, TraceMoment::wait_end, i++});
    }
    std::vector<TraceItem> all;
    for (std::uint32_t node = 0; node < ends.size(); ++node) {
      const std::vector<TraceItem> ordered = NodeOrder(view_.trace.nodes[node], node, std::move(ends[node])).make();
      all.insert(all.end(), ordered.begin(), ordered.end());
    }
    all.insert(all.end(), others.begin(), others.end());
    std::stable_sort(all.begin(), all.end(), [](const TraceItem& a, const TraceItem& b) {
      return std::tie(a.time_ns, a.node) < std::tie(b.time_ns, b.node);
    });
    order_causally(all);
    return all;
  }

  static WireMessage begun(EventType type, std::uint64_t track) {
    WireMessage event;
    event.put(event_field::type, static_cast<std::uint64_t>(type));
    event.put(event_field::track, track);
    return event;
  }
  void write_event(std::uint64_t time_ns, const WireMessage& event, UsesNames uses_names = UsesNames::yes) {
    packet_.put(packet_field::timestamp, time_ns);
    packet_.put(packet_field::event, event);
    end_packet(uses_names);
  }
  static void add(WireMessage& event, Argument name, std::uint32_t field, std::uint64_t value) {
    WireMessage argument;
    argument.put(argument_field::name_id, static_cast<std::uint64_t>(name));
    argument.put(field, value);
    event.put(event_field::argument, argument);
  }

  void write(const TraceItem& item) {
    switch (item.moment) {
      case TraceMoment::span_begin:
        return write_event(item.time_ns, slice_of(item.node, view_.trace.nodes[item.node].spans[item.index]));
      case TraceMoment::span_end:
        return write_event(item.time_ns, begun(EventType::slice_end, Tracks::of_node(item.node)), UsesNames::no);
      case TraceMoment::level:
        return write_level(item.node, view_.trace.nodes[item.node].levels[item.index]);
      case TraceMoment::sent:
      case TraceMoment::received:
        return write_end_of_message(item);
      case TraceMoment::wait_begin:
      case TraceMoment::wait_end:
        return write_wait(item);
    }
  }

  WireMessage slice_of(std::uint32_t node, const nodes::TraceSpan& span) const {
    WireMessage event = begun(EventType::slice_begin, Tracks::of_node(node));
    event.put(event_field::name_id, view_.text_number(span) + 1);
    if (span.own_ns != span.end_ns - span.begin_ns) {
      add(event, Argument::own_ns, argument_field::number, span.own_ns);
    }
    if (span.activity != nodes::Activity::work && span.activity != nodes::Activity::send) {
      add(event, Argument::packet, argument_field::text_id, std::uint64_t{span.packet} + 1);
    }
    if (span.item != nodes::TraceSpan::no_item) {
      add(event, Argument::x, argument_field::number, span.item % view_.width);
      add(event, Argument::y, argument_field::number, span.item / view_.width);
      add(event, Argument::depth, argument_field::number, span.depth);
    }
    if (span.is_cut) {
      add(event, Argument::cut, argument_field::truth, 1);
    }
    return event;
  }

  void write_end_of_message(const TraceItem& item) {
    const nodes::TraceMessage& message = view_.trace.messages[item.index];
    const bool is_sent = item.moment == TraceMoment::sent;
    WireMessage event = begun(EventType::instant, Tracks::of_node(item.node));
    event.put(event_field::name_id, name_of_kind(message.kind));
    event.put_fixed(is_sent ? event_field::flow : event_field::ending_flow, std::uint64_t{item.index} + 1);
    if (is_sent) {
      add(event, Argument::bytes, argument_field::number, message.bytes);
    }
    write_event(item.time_ns, event);
  }

  void write_wait(const TraceItem& item) {
    const bool begins = item.moment == TraceMoment::wait_begin;
    WireMessage event = begun(begins ? EventType::slice_begin : EventType::slice_end, wait_tracks_[item.index]);
    if (begins) {
      event.put_bytes(event_field::name, "page " + std::to_string(waits_[item.index].page));
    }
    write_event(item.time_ns, event, UsesNames::no);
  }

  void write_level(std::uint32_t node, const nodes::TraceLevel& level) {
    WireMessage event = begun(EventType::counter, tracks_.of_level(node, level.number));
    event.put(event_field::counter_value, level.value);
    write_event(level.time_ns, event, UsesNames::no);
  }

  const TraceView& view_;
  const std::vector<const char*> span_texts_ = view_.span_texts();
  std::ostream& output_;
  std::vector<PageWait> waits_;
  std::vector<std::uint64_t> wait_tracks_;
  Tracks tracks_;
  WireMessage packet_;
  std::uint64_t flags_ = state_cleared;
};

}  // namespace

void check_trace_path(const std::filesystem::path& path) {
  if (path.extension() == ".pftrace") {
    return;
  }
  const bool is_packed = path.extension() == ".gz";
  const std::filesystem::path other = is_packed ? path.stem() : path.filename();
  std::string name = other.stem().string();
  std::string message = "--trace=" + path.string() + ": expected a file with the ending .pftrace, such as " + name +
                        ".pftrace, which ui.perfetto.dev shows";
  if (other.extension() == ".json" || other.extension() == ".paje") {
    message += "; Perfetto's own converter makes JSON of it: traceconv json " + name + ".pftrace " + name + ".json";
  }
  throw core::UsageError(message + (is_packed ? "; gzip packs it" : ""));
}

void write_perfetto(const TraceView& view, std::ostream& output) { PerfettoWriter(view, output).write(); }

}  // namespace dmpc::apps
