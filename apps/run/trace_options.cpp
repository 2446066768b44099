#include "apps/run/trace_options.h"

#include <string_view>

#include "apps/edge/line/option_values.h"
#include "apps/edge/line/parsed_number.h"
#include "apps/edge/show/trace/format.h"
#include "core/base/expect.h"
#include "nodes/watch/trace.h"

namespace dmpc::apps {

namespace {

using core::UsageError;

constexpr double window_ms_max = 1e9;

std::uint64_t parse_time_ns(const std::string& text, const std::string& whole) {
  const double milliseconds = finite_number(text);
  if (!(milliseconds >= 0 && milliseconds <= window_ms_max)) {
    throw UsageError("--trace-window=" + whole +
                     ": expected milliseconds since the start of the run, FROM,TO, such as 0,2.5 or 10,");
  }
  return static_cast<std::uint64_t>(milliseconds * 1e6 + 0.5);
}

void parse_row(std::string_view text, const std::string& whole, TraceNodes& nodes) {
  if (text == "host") {
    nodes.has_host = true;
    return;
  }
  const std::size_t dash = text.find('-');
  const auto first = number_in<std::uint32_t>(text.substr(0, dash));
  const auto last = dash == std::string_view::npos ? first : number_in<std::uint32_t>(text.substr(dash + 1));
  if (!first || !last || *last < *first) {
    throw UsageError("--trace-nodes=" + whole + ": expected numbers of nodes, rows of them, or the host, such as 0,3-5,host");
  }
  nodes.rows.emplace_back(*first, *last);
}

/// The parts between commas; of an empty text one, which is empty.
std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ',') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

}  // namespace

TraceWindow parse_trace_window(const std::string& text) {
  const std::vector<std::string> parts = split(text);
  TraceWindow window;
  if (parts.size() != 2 || text == ",") {
    parse_time_ns("", text);  // says what is expected
  }
  if (!parts[0].empty()) {
    window.from_ns = parse_time_ns(parts[0], text);
  }
  if (!parts[1].empty()) {
    window.to_ns = parse_time_ns(parts[1], text);
  }
  if (window.to_ns && *window.to_ns <= window.from_ns) {
    throw UsageError("--trace-window=" + text + ": the window ends before it begins");
  }
  return window;
}

TraceNodes parse_trace_nodes(const std::string& text) {
  TraceNodes nodes;
  for (const std::string& part : split(text)) {
    parse_row(part, text, nodes);
  }
  return nodes;
}

void add_options(OptionSet options, TraceOptions& trace) {
  options.add_path(
      "--trace", "FILE", trace.path,
      "Write what each node did when, its messages and how full it was: FILE.pftrace for Perfetto, FILE.json for it or "
      "Chrome, FILE.paje for readers of Paje; .gz behind it packs");
  options.add_text(
      "--trace-window", "FROM,TO", [&trace](const std::string& text) { trace.window = parse_trace_window(text); },
      "Only this time, in milliseconds since the start of the run; FROM, lasts until its end");
  options.add_text(
      "--trace-nodes", "0,3-5,host", [&trace](const std::string& text) { trace.nodes = parse_trace_nodes(text); },
      "Only these nodes, and messages between them");
  options.add_number("--trace-every", trace.every, 1, 1'000'000'000, "1",
                     "Only one of so many pixels: the quanta that work on it, and what follows from the messages that they send");
  options.add_number("--trace-events", trace.events_max, 1, 100'000'000, "1000000",
                     "The most events to keep, each in about 110 bytes of the real computer");
  options.add_choice<nodes::TraceKeep>(
      "--trace-keep", trace.keep,
      {{"spread", nodes::TraceKeep::spread}, {"last", nodes::TraceKeep::last}, {"first", nodes::TraceKeep::first}}, "spread",
      "Of more events than that, how the run begins and ends and parts of all times between, what each node did last, or what "
      "comes first");
}

void check_trace(const OptionSet& options, const TraceOptions& trace, std::uint32_t node_count) {
  for (const std::string option : {"--trace-window", "--trace-nodes", "--trace-every", "--trace-events", "--trace-keep"}) {
    if (!trace.path && options.is_given(option)) {
      throw UsageError(option + " chooses what --trace records: give --trace=FILE too");
    }
  }
  if (trace.path && !trace_file_of(*trace.path)) {
    throw UsageError("--trace=" + trace.path->string() +
                     ": expected a file with the ending .pftrace (Perfetto), .json (Perfetto, "
                     "Chrome) or .paje, or one of these and .gz");
  }
  for (const auto& [first, last] : trace.nodes.value_or(TraceNodes{}).rows) {
    if (last >= node_count) {
      throw UsageError("--trace-nodes: there is no node " + std::to_string(last) + " among " + std::to_string(node_count));
    }
  }
}

nodes::TraceChoice trace_choice(const TraceOptions& trace, std::uint32_t node_count) {
  nodes::TraceChoice choice{.every = trace.every, .events_max = trace.events_max, .keep = trace.keep};
  if (trace.window) {
    choice.from_ns = trace.window->from_ns;
    choice.to_ns = trace.window->to_ns.value_or(choice.to_ns);
  }
  if (trace.nodes) {
    choice.nodes.assign(node_count + 1, false);
    choice.nodes.back() = trace.nodes->has_host;
    for (const auto& [first, last] : trace.nodes->rows) {
      std::fill(choice.nodes.begin() + first, choice.nodes.begin() + last + 1, true);
    }
  }
  return choice;
}

}  // namespace dmpc::apps
