// A subject rendered by each strategy, to the end.
#pragma once

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

}  // namespace dmpc::tests
