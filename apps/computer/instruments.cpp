#include "apps/computer/instruments.h"

#include "nodes/flat_bytes.h"

namespace dmpc::apps {

Instruments::Instruments(const ProgramOptions& options, std::uint32_t node_count, const nodes::WorkOf& work_of) {
  const std::uint32_t peer_count = node_count + 1;  // and the host
  if (options.trace) {
    join(recorder_.emplace(peer_count, nodes::TraceChoice{}));
  }
  if (options.report) {
    join(profile_.emplace(peer_count, work_of));
  }
}

nodes::Observer* Instruments::observer() { return members_.empty() ? nullptr : &group_.emplace(members_); }

std::string Instruments::seen() const {
  nodes::FlatWriter flat;
  flat.put_bytes(recorder_ ? recorder_->bytes() : std::string());
  flat.put_bytes(profile_ ? profile_->bytes() : std::string());
  return flat.take();
}

void Instruments::add(std::string_view seen, const nodes::ClockDrift& clock) {
  nodes::FlatReader flat(seen);
  const std::string_view trace = flat.take_bytes(), profile = flat.take_bytes();
  if (recorder_) {
    recorder_->add(trace, clock);
  }
  if (profile_) {
    profile_->add(profile);
  }
}

std::optional<nodes::Trace> Instruments::trace() { return recorder_ ? std::optional(recorder_->take()) : std::nullopt; }

std::optional<nodes::ActivitySteps> Instruments::steps() { return profile_ ? std::optional(profile_->take()) : std::nullopt; }

}  // namespace dmpc::apps
