#include "apps/run/trace_options.h"

#include "apps/frontend/line/option_values.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/show/trace/perfetto.h"
#include "core/base/expect.h"
#include "nodes/observers/trace.h"

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

}  // namespace

TraceWindow parse_trace_window(const std::string& text) {
  const std::vector<std::string> parts = words_between(text, ',');
  TraceWindow window;
  if (parts.size() != 2 || text == ",") {
    parse_time_ns("", text);  // throws with the expected format
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

void add_options(OptionSet options, TraceOptions& trace) {
  options.add_path("--trace", "FILE.pftrace", trace.path,
                   "Write a timeline of what each node did, its messages and how full it was, for ui.perfetto.dev. An event "
                   "takes about 110 bytes of the real computer; of more than a million events the file has the beginning and the "
                   "end of the run and parts of all times between");
  options.add_text(
      "--trace-window", "FROM,TO", [&trace](const std::string& text) { trace.window = parse_trace_window(text); },
      "Record only this time, in milliseconds since the start of the run; FROM, lasts until its end");
}

void check_trace(const TraceOptions& trace) {
  if (trace.window && !trace.path) {
    throw UsageError("--trace-window chooses what --trace records: give --trace=FILE too");
  }
  if (trace.path) {
    check_trace_path(*trace.path);
  }
}

nodes::TraceChoice trace_choice(const TraceOptions& trace) {
  nodes::TraceChoice choice;
  if (trace.window) {
    choice.from_ns = trace.window->from_ns;
    choice.to_ns = trace.window->to_ns.value_or(choice.to_ns);
  }
  return choice;
}

}  // namespace dmpc::apps
