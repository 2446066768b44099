// Functions on all processors of a runner: each has a `node` and its `program`, and the host is the last.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "nodes/counters.h"

namespace dmpc::nodes {

template <class Processor>
using Processors = std::vector<std::unique_ptr<Processor>>;

/// Whether no program will work or need to receive any more.
template <class Processor>
bool all_finished(const Processors<Processor>& processors) {
  return std::all_of(processors.begin(), processors.end(), [](const auto& processor) { return processor->program->finished(); });
}

/// A line for each program on its queues and state, for the report on a deadlock.
template <class Processor>
std::string describe(const Processors<Processor>& processors) {
  std::string lines;
  for (const auto& processor : processors) {
    const std::uint32_t index = index_of(processor->node.id());
    lines += "\n  " + (index + 1 == processor->node.peer_count() ? std::string("host") : "node " + std::to_string(index)) +
             (processor->program->finished() ? " (finished): " : ": ") + processor->program->describe();
  }
  return lines;
}

/// The processors' reports, by index.
template <class Processor, class Report>
std::vector<std::string> reported_by(const Processors<Processor>& processors, std::size_t peer_count, const Report& report) {
  std::vector<std::string> reported(peer_count);
  for (const auto& processor : processors) {
    reported[index_of(processor->node.id())] = report(index_of(processor->node.id()));
  }
  return reported;
}

/// Expects, at a regular end, that as many packets were received as sent; `came` and `went` are those from and to other ranks.
template <class Processor>
void expect_all_received(const Processors<Processor>& processors, std::uint64_t came = 0, std::uint64_t went = 0) {
  std::uint64_t sent = came, received = went;
  for (const auto& processor : processors) {
    sent += total(processor->node.counters().sent).packets;
    received += total(processor->node.counters().received).packets;
  }
  core::expect(sent == received, "packets sent are packets received");
}

}  // namespace dmpc::nodes
