#include "apps/computer/instruments.h"

namespace dmpc::apps {

Instruments::Instruments(const ProgramOptions& options, std::uint32_t node_count) {
  const std::uint32_t peer_count = node_count + 1;  // and the host
  if (options.trace) {
    add(recorder_.emplace(peer_count, nodes::TraceChoice{}));
  }
  if (options.report) {
    add(profile_.emplace(peer_count));
  }
}

nodes::Observer* Instruments::observer() { return members_.empty() ? nullptr : &group_.emplace(members_); }

std::optional<nodes::Trace> Instruments::trace() { return recorder_ ? std::optional(recorder_->take()) : std::nullopt; }

std::optional<nodes::ActivitySteps> Instruments::steps() { return profile_ ? std::optional(profile_->take()) : std::nullopt; }

}  // namespace dmpc::apps
