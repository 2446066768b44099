#include "apps/computer/program_watch.h"

#include <utility>

#include "apps/computer/readable_nodes.h"

namespace dmpc::apps {

ProgramWatch::ProgramWatch(const ProgramOptions& options, std::uint32_t node_count) : instruments_(options, node_count) {
  if (options.report && node_count <= readable_nodes_max) {
    instruments_.add(pairs_.emplace(node_count));
  }
}

void ProgramWatch::take(ProgramRecord& record) {
  record.trace = instruments_.trace();
  if (auto steps = instruments_.steps()) {
    record.view = {.steps = std::move(*steps), .pairs = pairs_ ? std::optional(pairs_->pairs()) : std::nullopt};
  }
}

}  // namespace dmpc::apps
