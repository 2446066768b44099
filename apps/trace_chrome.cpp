#include "apps/trace_chrome.h"

#include <algorithm>
#include <ostream>
#include <tuple>

namespace dmpc::apps {

namespace {

/// Between quotation marks.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
    }
    result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return result + "\"";
}

std::string key(const char* name, const std::string& value) { return std::string("\"") + name + "\":" + value; }

class ChromeWriter {
 public:
  ChromeWriter(const TraceView& view, std::ostream& output) : view_(view), output_(output), waits_(page_waits(view)) {}

  void write() {
    output_ << "{\"displayTimeUnit\":\"ns\",\n\"otherData\":{" << key("clock", quoted(view_.clock));
    for (const auto& [name, text] : view_.remarks) {
      output_ << ",\n" << quoted(name) << ":" << quoted(text);
    }
    output_ << "},\n\"traceEvents\":[\n";
    for (std::uint32_t node = 0; node < view_.trace.nodes.size(); ++node) {
      write_names(node);
    }
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

  void write_names(std::uint32_t node) {
    const std::string name = node_name(view_, node);
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
    add("name", quoted(text_of(name_of(span))));
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
    if (span.pixel != nodes::TraceSpan::no_pixel) {
      add("x", std::to_string(span.pixel % view_.width));
      add("y", std::to_string(span.pixel / view_.width));
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
    add("name", quoted(std::string(view_.trace.nodes[node].level_names[level.number])));
    add("args", "{" + key("value", std::to_string(level.value)) + "}");
    end();
  }

  const TraceView& view_;
  std::ostream& output_;
  std::vector<PageWait> waits_;
  bool is_first_ = true;
};

}  // namespace

void write_chrome(const TraceView& view, std::ostream& output) { ChromeWriter(view, output).write(); }

}  // namespace dmpc::apps
