// Instruments beside a run of tasks over pages.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/computer/instruments.h"
#include "apps/computer/paged_record.h"
#include "svm/pages/run_tasks.h"
#include "svm/pages/task_heat.h"
#include "svm/pages/task_plan.h"
#include "svm/pages/watch/fetch_watch.h"
#include "svm/pages/watch/reference_log.h"

namespace dmpc::apps {

/// For one run of so many tasks that have these operations. Thread safety: as an Observer.
class PagedWatch {
 public:
  PagedWatch(const PagedOptions& options, const std::vector<OperationNeed>& operations, const svm::TaskPlan& plan,
             std::uint32_t task_count);

  /// For the run, on every rank, where nobody has a pointer who wants to know nothing; what ranks saw is added up.
  svm::TaskWatching watching();
  /// Puts what was seen into the record, in place of what another run showed. Call it once, when the run is over.
  void take(PagedRecord& record);

 private:
  std::string seen() const;
  void add(std::string_view seen, const nodes::ClockDrift& clock);

  Instruments instruments_;
  std::optional<svm::FetchWatch> fetches_;
  std::vector<svm::ReferenceLog> reference_logs_;
  svm::TaskHeat heat_;
};

}  // namespace dmpc::apps
