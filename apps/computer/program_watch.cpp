#include "apps/computer/program_watch.h"

#include <utility>

#include "apps/computer/readable_nodes.h"

namespace dmpc::apps {

ProgramWatch::ProgramWatch(const ProgramOptions& options, std::uint32_t node_count) : instruments_(options, node_count, false) {
  if (options.report && node_count <= readable_nodes_max) {
    instruments_.add(pairs_.emplace(node_count));
  }
}

std::string ProgramWatch::seen() const {
  nodes::FlatWriter flat;
  instruments_.put(flat);
  if (pairs_) {
    pairs_->put(flat);
  }
  return flat.take();
}

void ProgramWatch::add(std::string_view seen, const nodes::ClockDrift& clock) {
  nodes::FlatReader flat(seen);
  instruments_.add(flat, clock);
  if (pairs_) {
    pairs_->add(flat);
  }
}

void ProgramWatch::take(ProgramRecord& record) {
  record.trace = instruments_.trace();
  if (auto steps = instruments_.steps()) {
    record.view = {.steps = std::move(*steps), .pairs = pairs_ ? std::optional(pairs_->pairs()) : std::nullopt};
  }
}

}  // namespace dmpc::apps
