#include "nodes/threads/threads_runner.h"

#include <exception>
#include <string>
#include <utility>

#include "nodes/processors.h"

namespace dmpc::nodes {

ThreadsRunner::ThreadsRunner(std::span<const NodeSpecification> specifications, const std::optional<Chaos>& chaos,
                             Observer* observer, const std::optional<std::uint32_t>& pool_threads, Immutable immutable)
    : nodes_(specifications, chaos, observer, nullptr, pool_threads, immutable), disturbance_(chaos) {}

RunEnd ThreadsRunner::run(std::stop_token stop) {
  if (std::exchange(is_started_, true)) {
    nodes_.begin_again();
  }
  {
    const std::stop_callback on_stop(std::move(stop), [this] { nodes_.end(Ending::interrupted); });
    nodes_.start(nanoseconds(CLOCK_MONOTONIC));
    nodes_.join();
  }
  return judge();
}

RunEnd ThreadsRunner::judge() const {
  switch (nodes_.ending()) {
    case Ending::failed:
      std::rethrow_exception(nodes_.failure());
    case Ending::stalled:
      throw DeadlockError(deadlock_text(disturbance_) + nodes_.describe());
    case Ending::interrupted:
      return RunEnd::interrupted;
    default:
      nodes_.expect_nothing_lies_about();
      expect_all_received(nodes_.processors());
      return RunEnd::finished;
  }
}

Node& ThreadsRunner::node(std::size_t index) { return nodes_.processor(index).node; }
Program& ThreadsRunner::program(std::size_t index) { return *nodes_.processor(index).program; }

std::vector<std::string> ThreadsRunner::gather(const Report& report) {
  return reported_by(nodes_.processors(), nodes_.processors().size(), report);
}

}  // namespace dmpc::nodes
