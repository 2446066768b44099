// A subject rendered by each strategy, to the end; and computers of each kind, on all of which it is to show the same.
#pragma once

#include <cstdint>
#include <optional>

#include "dataflow/run.h"
#include "svm/forest/strategy.h"
#include "svm/run.h"
#include "tests/support/subject.h"

namespace dmpc::tests {

inline svm::Report run_svm(const Subject& subject, const svm::RunOptions& options, const core::Skips& skips = {}) {
  return svm::run_svm(subject.database(), subject.settings(skips), options, {});
}
inline svm::Report run_replicated(const Subject& subject, const svm::RunOptions& options, const core::Skips& skips = {}) {
  return svm::run_replicated(subject.database(), subject.settings(skips), options, {});
}
inline svm::Report run_forest(const Subject& subject, const svm::RunOptions& options, const core::Skips& skips = {}) {
  return svm::run_forest(subject.database(), subject.settings(skips), options, {});
}
inline dataflow::Report run_dataflow(const Subject& subject, const dataflow::RunOptions& options, const core::Skips& skips = {}) {
  return dataflow::run_dataflow(subject.database(), subject.settings(skips), options, {});
}

/// 0: threads; 1: a pool of two; 2: a model; 3: threads that chaos disturbs.
inline nodes::ComputerRequest computer_of_kind(int number, std::uint32_t nodes, std::uint64_t seed) {
  return {.node_count = nodes,
          .chaos = number == 3 ? std::optional(nodes::chaos_of(seed)) : std::nullopt,
          .pool_threads = number == 1 ? std::optional(2U) : std::nullopt,
          .machine = number == 2 ? std::optional(nodes::Machine{}) : std::nullopt};
}

}  // namespace dmpc::tests
