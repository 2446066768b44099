#include "svm/forest/run.h"

#include <utility>

#include "svm/forest/strategy.h"

namespace dmpc::svm {

Report run_forest(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
                  std::stop_token stop) {
  return run_by(*forest_strategy(), database, settings, options, std::move(stop));
}

}  // namespace dmpc::svm
