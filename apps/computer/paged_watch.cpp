#include "apps/computer/paged_watch.h"

#include <utility>

#include "apps/computer/program_work.h"
#include "apps/edge/run/miss_estimate.h"
#include "nodes/flat_bytes.h"

namespace dmpc::apps {

PagedWatch::PagedWatch(const PagedOptions& options, const std::vector<OperationNeed>& operations, const svm::TaskPlan& plan,
                       std::uint32_t task_count)
    : instruments_(options.program, plan.node_count(), task_work(operations).work_of) {
  const bool has_report = options.program.report.has_value();
  if (has_report) {
    instruments_.join(fetches_.emplace(plan.node_count(), plan.pages().page_count));
  }
  if (options.references) {
    reference_logs_.resize(plan.node_count());
  } else if (has_report) {
    reference_logs_.assign(plan.node_count(), svm::ReferenceLog(references_of_node(plan.node_count())));
  }
  if (has_report || options.heat) {
    heat_.resize(task_count);
  }
}

svm::TaskWatching PagedWatch::watching() {
  return {.observer = instruments_.observer(),
          .reference_logs = reference_logs_.empty() ? nullptr : &reference_logs_,
          .heat = heat_.empty() ? nullptr : &heat_,
          .seen = [this] { return seen(); },
          .add = [this](std::string_view told, const nodes::ClockDrift& clock) { add(told, clock); }};
}

std::string PagedWatch::seen() const {
  nodes::FlatWriter flat;
  flat.put_bytes(instruments_.seen());
  flat.put_bytes(fetches_ ? fetches_->bytes() : std::string());
  svm::put_logs(flat, reference_logs_);
  svm::put_heat(flat, heat_);
  return flat.take();
}

void PagedWatch::add(std::string_view seen, const nodes::ClockDrift& clock) {
  nodes::FlatReader flat(seen);
  instruments_.add(flat.take_bytes(), clock);
  const std::string_view fetches = flat.take_bytes();
  if (fetches_) {
    fetches_->add(fetches, clock);
  }
  svm::take_logs(flat, reference_logs_);
  svm::add_heat(flat, heat_);
}

void PagedWatch::take(PagedRecord& record) {
  record.trace = instruments_.trace();
  if (auto steps = instruments_.steps()) {
    record.view = {.steps = std::move(*steps), .fetches = fetches_->take(), .misses = estimate_misses(reference_logs_)};
  }
  record.references = std::move(reference_logs_);
  record.heat = std::move(heat_);
}

}  // namespace dmpc::apps
