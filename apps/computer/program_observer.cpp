#include "apps/computer/program_observer.h"

#include <utility>

#include "apps/computer/page_parts.h"
#include "apps/computer/program_work.h"
#include "apps/frontend/run/miss_estimate.h"
#include "nodes/flat_bytes.h"

namespace dmpc::apps {
namespace {

template <class Watch>
std::string bytes_of_observer(const std::optional<Watch>& observer) {
  return observer ? observer->bytes() : std::string();
}

template <class Watch>
void add_to(std::optional<Watch>& observer, std::string_view bytes, const auto&... clock) {
  if (observer) {
    observer->add(bytes, clock...);
  }
}

}  // namespace

template <class Watch, class... Arguments>
void ProgramObserver::look_on(std::optional<Watch>& observer, Arguments&&... arguments) {
  members_.push_back(&observer.emplace(std::forward<Arguments>(arguments)...));
}

ProgramObserver::ProgramObserver(const ProgramOptions& options, const Vocabulary& vocabulary, const WatchedRun& run) {
  const std::uint32_t peer_count = run.node_count + 1;  // and the host
  if (options.trace) {
    look_on(recorder_, peer_count, nodes::TraceChoice{});
  }
  if (options.report) {
    look_on(profile_, peer_count, program_work(vocabulary).work_of);
  }
  if (vocabulary.has_pages()) {
    watch_pages(options, run);
  } else if (options.report && run.node_count <= html::readable_nodes_max) {
    look_on(pairs_, run.node_count);
  }
}

void ProgramObserver::watch_pages(const ProgramOptions& options, const WatchedRun& run) {
  const bool has_report = options.report.has_value();
  if (has_report) {
    look_on(fetches_, run.node_count, run.page_count);
  }
  if (options.references) {
    reference_logs_.resize(run.node_count);
  } else if (has_report) {
    reference_logs_.assign(run.node_count, svm::ReferenceLog(references_of_node(run.node_count)));
  }
  if (has_report || options.heat) {
    heat_.resize(run.task_count);
  }
}

svm::TaskWatching ProgramObserver::watching() {
  return {.observer = observer(),
          .reference_logs = reference_logs_.empty() ? nullptr : &reference_logs_,
          .heat = heat_.empty() ? nullptr : &heat_,
          .seen = [this] { return seen(); },
          .add = [this](std::string_view reported, const nodes::ClockDrift& clock) { add(reported, clock); }};
}

std::string ProgramObserver::seen() const {
  nodes::FlatWriter flat;
  flat.put_bytes(bytes_of_observer(recorder_));
  flat.put_bytes(bytes_of_observer(profile_));
  flat.put_bytes(bytes_of_observer(pairs_));
  flat.put_bytes(bytes_of_observer(fetches_));
  svm::put_logs(flat, reference_logs_);
  svm::put_heat(flat, heat_);
  return flat.take();
}

void ProgramObserver::add(std::string_view seen, const nodes::ClockDrift& clock) {
  nodes::FlatReader flat(seen);
  add_to(recorder_, flat.take_bytes(), clock);
  add_to(profile_, flat.take_bytes());
  add_to(pairs_, flat.take_bytes());
  add_to(fetches_, flat.take_bytes(), clock);
  svm::take_logs(flat, reference_logs_);
  svm::add_heat(flat, heat_);
}

void ProgramObserver::take(ProgramRecord& record) {
  if (recorder_) {
    record.trace = recorder_->take();
  }
  if (profile_) {
    RunView& view = record.view.emplace(RunView{.steps = profile_->take()});
    if (fetches_) {
      view.fetches = fetches_->take();
      view.misses = estimate_misses(reference_logs_);
    }
  }
  if (pairs_) {
    record.pairs = pairs_->pairs();
  }
  record.tasks.references = std::move(reference_logs_);
  record.tasks.heat = std::move(heat_);
}

}  // namespace dmpc::apps
