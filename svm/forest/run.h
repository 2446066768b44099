// Renders a picture on nodes that ask each other.
#pragma once

#include <stop_token>

#include "core/database/database.h"
#include "core/picture/pixel_task.h"
#include "svm/run.h"

namespace dmpc::svm {

/// Renders with strategy forest, a database of one tree in spatial order (core::Database::forest_page_count()), as run_by() does.
Report run_forest(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
                  std::stop_token stop);

}  // namespace dmpc::svm
