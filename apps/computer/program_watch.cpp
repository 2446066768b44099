#include "apps/computer/program_watch.h"

#include <utility>

#include "apps/computer/program_work.h"
#include "apps/computer/readable_nodes.h"
#include "nodes/flat_bytes.h"

namespace dmpc::apps {

ProgramWatch::ProgramWatch(const ProgramOptions& options, const ProgramPlan& plan)
    : instruments_(options, plan.node_count(), packet_work(plan.needs().operations).work_of) {
  if (options.report && plan.node_count() <= readable_nodes_max) {
    instruments_.join(pairs_.emplace(plan.node_count()));
  }
}

std::string ProgramWatch::seen() const {
  nodes::FlatWriter flat;
  flat.put_bytes(instruments_.seen());
  flat.put_bytes(pairs_ ? pairs_->bytes() : std::string());
  return flat.take();
}

void ProgramWatch::add(std::string_view seen, const nodes::ClockDrift& clock) {
  nodes::FlatReader flat(seen);
  instruments_.add(flat.take_bytes(), clock);
  if (pairs_) {
    pairs_->add(flat.take_bytes());
  }
}

void ProgramWatch::take(ProgramRecord& record) {
  record.trace = instruments_.trace();
  if (auto steps = instruments_.steps()) {
    record.view = {.steps = std::move(*steps), .pairs = pairs_ ? std::optional(pairs_->pairs()) : std::nullopt};
  }
}

}  // namespace dmpc::apps
