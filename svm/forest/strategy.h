// The strategy that sends questions about rays: J. Goldsmith and J. Salmon's, over one tree of boxes.
#pragma once

#include <cstdint>
#include <stop_token>

#include "core/database/database.h"
#include "core/picture/pixel_task.h"
#include "svm/run.h"
#include "svm/strategy.h"

namespace dmpc::svm {

/// The default number of pixels in flight on a node's thread: a quarter of its share of the picture, within these. A node whose
/// pixel waits for an answer goes on with others, and the more there are, the fuller are packets of questions; but pixels in
/// flight cannot be given to an idle node (svm/RESULTS.md).
inline constexpr std::uint32_t forest_in_flight_least = 16, forest_in_flight_most = 256;

/// Every node holds the upper part of the tree, and asks the owners of its subtrees what rays hit there.
const Strategy* forest_strategy();

/// Renders with strategy forest, a database of one tree in spatial order (core::Database::forest_page_count()), as run_by() does.
Report run_forest(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
                  std::stop_token stop);

}  // namespace dmpc::svm
