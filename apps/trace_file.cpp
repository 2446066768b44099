#include "apps/trace_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "apps/figures.h"
#include "apps/trace_chrome.h"
#include "apps/trace_paje.h"
#include "apps/trace_view.h"
#include "core/expect.h"
#include "nodes/trace.h"

namespace dmpc::apps {

namespace {

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
                  {"runner", name_of(options.computer.runner)}};
  if (account.virtual_time) {
    view.remarks.push_back({"machine", options.computer.machine->name});
    view.remarks.push_back({"machine_digest", hash_text(account.virtual_time->machine_digest)});
    view.remarks.push_back({"run_hash", hash_text(account.virtual_time->run_hash(account.film.hash()))});
  }
  if (options.trace.every > 1) {
    view.remarks.push_back({"recorded", "one pixel of " + std::to_string(options.trace.every)});
  }
  view.remarks.push_back({"lost", record.trace->events_lost == 0 ? "nothing" : loss_note(*record.trace, options.trace)});
  return view;
}

void write(const RenderRecord& record, const OutputFile& file) {
  std::ofstream stream(file.temporary(), std::ios::binary);
  const TraceView view = view_of(record);
  record.options.trace.path->extension() == ".paje" ? write_paje(view, stream) : write_chrome(view, stream);
  stream.close();
  if (!stream) {
    throw core::InputError(record.options.trace.path->string() + ": cannot be written: " + std::strerror(errno));
  }
}

}  // namespace

TraceFile::TraceFile(const RenderRecord& record) {
  if (record.options.trace.path) {
    core::expect(record.trace != nullptr, "a trace that is written was recorded");
    write(record, file_.emplace(*record.options.trace.path));
  }
}

void TraceFile::commit() {
  if (file_) {
    file_->commit();
  }
}

std::string loss_note(const nodes::Trace& trace, const TraceOptions& options) {
  if (trace.events_lost == 0) {
    return "";
  }
  return "the trace is full: " + counted(trace.events_lost, "event") + " from " + thousandths(trace.lost_from_ns / 1000) +
         " ms on were not recorded; " +
         (options.every > 1 ? "--trace-window or --trace-nodes leave" : "--trace-window, --trace-nodes or --trace-every leave") +
         " room, --trace-events makes some";
}

}  // namespace dmpc::apps
