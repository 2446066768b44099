#include "apps/computer/instruments.h"

#include "apps/computer/program_work.h"

namespace dmpc::apps {

Instruments::Instruments(const ProgramOptions& options, std::uint32_t node_count, bool has_pages) {
  const std::uint32_t peer_count = node_count + 1;  // and the host
  if (options.trace) {
    add(recorder_.emplace(peer_count, nodes::TraceChoice{}));
  }
  if (options.report) {
    add(profile_.emplace(peer_count, [has_pages](const nodes::Span& span) { return program_work_of(span, has_pages); }));
  }
}

nodes::Observer* Instruments::observer() { return members_.empty() ? nullptr : &group_.emplace(members_); }

void Instruments::put(nodes::FlatWriter& flat) const {
  if (recorder_) {
    flat.put_bytes(recorder_->bytes());
  }
  if (profile_) {
    flat.put_bytes(profile_->bytes());
  }
}

void Instruments::add(nodes::FlatReader& flat, const nodes::ClockDrift& clock) {
  if (recorder_) {
    recorder_->add(flat.take_bytes(), clock);
  }
  if (profile_) {
    profile_->add(flat.take_bytes());
  }
}

std::optional<nodes::Trace> Instruments::trace() { return recorder_ ? std::optional(recorder_->take()) : std::nullopt; }

std::optional<nodes::ActivitySteps> Instruments::steps() { return profile_ ? std::optional(profile_->take()) : std::nullopt; }

}  // namespace dmpc::apps
