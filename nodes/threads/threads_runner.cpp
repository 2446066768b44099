#include "nodes/threads/threads_runner.h"

#include <exception>
#include <string>
#include <utility>

#include "core/base/expect.h"
#include "nodes/processors.h"
#include "nodes/runner.h"
#include "nodes/threads/node_threads.h"

namespace dmpc::nodes {

struct ThreadsRunner::Implementation {
  Implementation(std::span<const NodeSpecification> specifications, const std::optional<Chaos>& chaos, Observer* observer,
                 const std::optional<std::uint32_t>& pool_threads)
      : nodes(specifications, chaos, observer, nullptr, pool_threads), disturbance(chaos) {}

  RunEnd judge() const {
    switch (nodes.ending()) {
      case Ending::failed:
        std::rethrow_exception(nodes.failure());
      case Ending::stalled:
        throw StandstillError(stall_text(disturbance) + nodes.describe());
      case Ending::interrupted:
        return RunEnd::interrupted;
      default:
        nodes.expect_nothing_lies_about();
        expect_all_received(nodes.processors());
        return RunEnd::finished;
    }
  }

  NodeThreads nodes;
  std::optional<Chaos> disturbance;
  bool started = false;
};

ThreadsRunner::ThreadsRunner(std::span<const NodeSpecification> specifications, const std::optional<Chaos>& chaos,
                             Observer* observer, const std::optional<std::uint32_t>& pool_threads)
    : implementation_(std::make_unique<Implementation>(specifications, chaos, observer, pool_threads)) {}
ThreadsRunner::~ThreadsRunner() = default;

RunEnd ThreadsRunner::run(std::stop_token stop) {
  NodeThreads& nodes = implementation_->nodes;
  if (std::exchange(implementation_->started, true)) {
    nodes.begin_again();
  }
  {
    const std::stop_callback on_stop(std::move(stop), [&nodes] { nodes.end(Ending::interrupted); });
    nodes.start(nanoseconds(CLOCK_MONOTONIC));
    nodes.join();
  }
  return implementation_->judge();
}

Node& ThreadsRunner::node(std::size_t index) { return implementation_->nodes.processor(index).node; }
Program& ThreadsRunner::program(std::size_t index) { return *implementation_->nodes.processor(index).program; }

std::vector<std::string> ThreadsRunner::gather(const Tell& tell) {
  const auto& processors = implementation_->nodes.processors();
  return told_by(processors, processors.size(), tell);
}

}  // namespace dmpc::nodes
