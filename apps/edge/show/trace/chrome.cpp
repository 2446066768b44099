#include "apps/edge/show/trace/chrome.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>
#include <tuple>
#include <vector>

#include "apps/edge/show/trace/causal_order.h"

namespace dmpc::apps {

namespace {

/// Between quotation marks: a name of ours, which needs no more.
std::string quoted(const std::string& name) { return "\"" + name + "\""; }

/// Any text as a string of JSON; what is no UTF-8, as the name of a file may be, is replaced.
std::string json_of(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string key(const char* name, const std::string& value) { return std::string("\"") + name + "\":" + value; }

class ChromeWriter {
 public:
  ChromeWriter(const TraceView& view, std::ostream& output) : view_(view), output_(output), waits_(page_waits(view)) {}

  void write() {
    output_ << "{\"displayTimeUnit\":\"ns\",\n\"otherData\":{" << key("clock", json_of(view_.clock));
    for (const auto& [name, text] : view_.remarks) {
      output_ << ",\n" << json_of(name) << ":" << json_of(text);
    }
    output_ << "},\n\"traceEvents\":[\n";
    for (std::uint32_t node = 0; node < view_.trace.nodes.size(); ++node) {
      write_names(node, node_name(view_, node));
    }
    write_stretches();
    for (const TraceItem& item : items()) {
      write(item);
    }
    output_ << "\n]}\n";
  }

 private:
  std::vector<TraceItem> items() const {
    std::vector<TraceItem> items = items_of(view_.trace, waits_);
    std::sort(items.begin(), items.end(), [](const TraceItem& a, const TraceItem& b) {
      return std::tie(a.time_ns, a.node, a.call, a.moment, a.index) < std::tie(b.time_ns, b.node, b.call, b.moment, b.index);
    });
    order_causally(items);
    return items;
  }

  /// Process numbers begin at 1: 0 is an idle processor's.
  void begin(const char* phase, std::uint32_t node) {
    const std::string number = std::to_string(node + 1);
    output_ << (is_first_ ? "" : ",\n") << "{\"ph\":\"" << phase << "\",\"pid\":" << number << ",\"tid\":" << number;
    is_first_ = false;
  }
  void add(const char* name, const std::string& value) { output_ << "," << key(name, value); }
  void end() { output_ << "}"; }

  /// When all was recorded, as a process behind the nodes, if something was forgotten.
  void write_stretches() {
    const std::vector<TraceStretch> stretches = recorded_stretches(view_.trace);
    const auto number = static_cast<std::uint32_t>(view_.trace.nodes.size());
    if (!stretches.empty()) {
      write_names(number, "recorded");
    }
    for (const TraceStretch& stretch : stretches) {
      begin("X", number);
      add("ts", thousandths(stretch.begin_ns));
      add("dur", thousandths(stretch.end_ns - stretch.begin_ns));
      add("name", quoted("recorded"));
      end();
    }
  }

  void write_names(std::uint32_t node, const std::string& name) {
    const std::pair<const char*, std::string> all[] = {{"process_name", key("name", quoted(name))},
                                                       {"process_sort_index", key("sort_index", std::to_string(node))},
                                                       {"thread_name", key("name", quoted(name))}};
    for (const auto& [what, argument] : all) {
      begin("M", node);
      add("name", quoted(what));
      add("args", "{" + argument + "}");
      end();
    }
  }

  void write(const TraceItem& item) {
    switch (item.moment) {
      case TraceMoment::span_end:
        return;  // a slice has a duration
      case TraceMoment::span_begin:
        return write_slice(item.node, view_.trace.nodes[item.node].spans[item.index]);
      case TraceMoment::level:
        return write_level(item.node, view_.trace.nodes[item.node].levels[item.index]);
      case TraceMoment::sent:
      case TraceMoment::received:
        return write_flow(item);
      case TraceMoment::wait_begin:
      case TraceMoment::wait_end:
        return write_wait(item);
    }
  }

  void write_slice(std::uint32_t node, const nodes::TraceSpan& span) {
    begin("X", node);
    add("ts", thousandths(span.begin_ns));
    add("dur", thousandths(span.end_ns - span.begin_ns));
    add("name", json_of(span_texts_[view_.text_number(span)]));
    add("cat", quoted("node"));
    add("args", "{" + arguments_of(span) + "}");
    end();
  }

  std::string arguments_of(const nodes::TraceSpan& span) const {
    std::string arguments = key("own_us", thousandths(span.own_ns));
    const auto add = [&arguments](const char* name, const std::string& value) { arguments += "," + key(name, value); };
    if (span.activity != nodes::Activity::work && span.activity != nodes::Activity::send) {
      add("packet", quoted(view_.kind_names[span.packet]));
    }
    if (span.item != nodes::TraceSpan::no_item) {
      add("x", std::to_string(span.item % view_.width));
      add("y", std::to_string(span.item / view_.width));
      add("depth", std::to_string(span.depth));
    }
    if (span.is_cut) {
      add("cut", "true");
    }
    return arguments;
  }

  void write_flow(const TraceItem& item) {
    const nodes::TraceMessage& message = view_.trace.messages[item.index];
    begin(item.moment == TraceMoment::sent ? "s" : "f", item.node);
    add("ts", thousandths(item.time_ns));
    add("id", std::to_string(item.index));
    add("name", quoted(view_.kind_names[message.kind]));
    add("cat", quoted("message"));
    add("args", "{" + key("bytes", std::to_string(message.bytes)) + "}");
    end();
  }

  void write_wait(const TraceItem& item) {
    begin(item.moment == TraceMoment::wait_begin ? "b" : "e", item.node);
    add("ts", thousandths(item.time_ns));
    add("id", std::to_string(item.index));
    add("name", quoted("page " + std::to_string(waits_[item.index].page)));
    add("cat", quoted("fault"));
    end();
  }

  void write_level(std::uint32_t node, const nodes::TraceLevel& level) {
    begin("C", node);
    add("ts", thousandths(level.time_ns));
    add("name", quoted(view_.trace.nodes[node].level_names[level.number]));
    add("args", "{" + key("value", std::to_string(level.value)) + "}");
    end();
  }

  const TraceView& view_;
  const std::vector<const char*> span_texts_ = view_.span_texts();
  std::ostream& output_;
  std::vector<PageWait> waits_;
  bool is_first_ = true;
};

}  // namespace

void write_chrome(const TraceView& view, std::ostream& output) { ChromeWriter(view, output).write(); }

}  // namespace dmpc::apps
