#include "apps/show/trace/file.h"

#include <algorithm>
#include <ostream>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/show/trace/perfetto.h"
#include "apps/frontend/show/trace/view.h"
#include "core/base/expect.h"
#include "nodes/observers/trace.h"

namespace dmpc::apps {

namespace {

/// Joins a text into one line.
std::string line_of(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, ' ');
  return text;
}

std::string window_text(const std::optional<TraceWindow>& window) {
  return window ? milliseconds(window->from_ns) + " to " + (window->to_ns ? milliseconds(*window->to_ns) : "the end") : "all";
}

/// Returns how accurately times of different ranks can be compared.
std::string clocks_text(const std::vector<nodes::RankFigures>& ranks, const nodes::Trace& trace) {
  std::uint64_t error_ns = 0;
  for (const nodes::RankFigures& rank : ranks) {
    error_ns = std::max(error_ns, rank.clock.error_ns());
  }
  std::string text = "of " + counted(ranks.size(), "rank") +
                     ", compared with that of rank 0 before and after the run: wrong by " + thousandths(error_ns) + " us" +
                     " at most";
  if (trace.messages_moved > 0) {
    text += "; of " + counted(trace.messages.size(), "message") + " " + std::to_string(trace.messages_moved) +
            " seemed to be received up to " + thousandths(trace.moved_ns_max) + " us" +
            " before they were sent, and are shown as received when they were sent";
  }
  return text;
}

TraceView view_of(const RenderRecord& record) {
  const RenderOptions& options = record.options;
  const Account account = account_of(record.report);
  TraceView view{.trace = *record.trace,
                 .kind_names = account.kind_names,
                 .has_pages = options.strategy == Strategy::svm,
                 .width = static_cast<std::uint32_t>(account.film.width()),
                 .clock = options.computer.machine ? "virtual time" : "wall clock"};
  view.remarks = {{"scene", options.picture.scene},
                  {"strategy", name_of(options.strategy)},
                  {"nodes", std::to_string(options.computer.node_count)},
                  {"runner", name_of(options.runner.kind)}};
  if (account.virtual_time) {
    view.remarks.push_back({"machine", options.computer.machine->name});
    view.remarks.push_back({"machine_digest", hash_text(account.virtual_time->machine_digest)});
    view.remarks.push_back({"run_hash", hash_text(account.virtual_time->run_hash(record.film_hash()))});
  }
  if (account.ranks.size() > 1) {
    view.remarks.push_back({"clocks", clocks_text(account.ranks, *record.trace)});
  }
  view.remarks.push_back({"window_ms", window_text(options.trace.window)});
  view.remarks.push_back({"recorded_nodes", "all"});
  view.remarks.push_back({"lost", record.trace->events_lost == 0 ? "nothing" : loss_note(*record.trace)});
  for (auto& [name, text] : view.remarks) {
    text = line_of(std::move(text));
  }
  return view;
}

}  // namespace

void write_trace(const RenderRecord& record, std::ostream& stream) {
  core::expect(record.trace != nullptr, "a trace that is written was recorded");
  write_perfetto(view_of(record), stream);
}

std::string loss_note(const nodes::Trace& trace) {
  return trace.events_lost == 0
             ? ""
             : "the trace is full: " + lost_text(trace) + "; --trace-window=FROM,TO records a part of the run completely";
}

std::string empty_note(const nodes::Trace& trace) {
  const bool is_empty = trace.messages.empty() && std::all_of(trace.nodes.begin(), trace.nodes.end(),
                                                              [](const nodes::TraceNode& node) { return node.spans.empty(); });
  return is_empty && trace.events_lost == 0 ? "the trace is empty: no event that it records happened in this run" : "";
}

}  // namespace dmpc::apps
