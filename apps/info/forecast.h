// Forecasts the memory of a render by strategy and number of nodes, without rendering.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/database/database.h"
#include "core/picture/pixel_task.h"
#include "dataflow/regions/balance.h"
#include "svm/page_options.h"

namespace dmpc::apps {

/// Memory of one strategy, in bytes.
struct MemoryForecast {
  std::size_t least_bytes = 0;  ///< minimum of a node: a render with less is refused
  std::size_t usual_bytes = 0;  ///< default of the largest node, without options about memory
  std::size_t all_bytes = 0;    ///< sum over all nodes and the host in this case, which the real computer must provide
};

/// Forecast for a computer of `nodes` nodes.
struct ComputerForecast {
  std::uint32_t nodes = 1;
  MemoryForecast svm, replicated;
  std::optional<MemoryForecast> dataflow;  ///< nothing for more nodes than the regions support
  std::optional<MemoryForecast> forest;    ///< nothing unless the database is one tree
  double dataflow_copies = 1;              ///< copies per primitive, over all regions
};

struct Forecast {
  std::vector<ComputerForecast> computers;
  dataflow::Balance balance{};  ///< how the regions were made
  dataflow::CutOrder cuts{};    ///< order of their cuts
  std::uint32_t regions_a_node = 1;
  svm::PageHomes homes{};     ///< for svm's pages
  double region_seconds = 0;  ///< wall-clock time for making the regions
};

/// Called with (computers done, computers in all).
using ForecastProgress = std::function<void(std::uint64_t, std::uint64_t)>;

/// Forecasts `render` with these settings, with `pages` for svm, and with default options otherwise. Space is partitioned for
/// every number of nodes by `balance`: unless that is equal_size, the subsampled picture is rendered once, as dataflow does. Each
/// node count is from 1 to nodes::node_count_max. `database` still has its records. Throws core::UsageError as
/// dataflow::column_loads() does.
Forecast forecast(const core::Database& database, const core::RenderSettings& settings,
                  const std::vector<std::uint32_t>& node_counts, const dataflow::BalanceOptions& balance,
                  const ForecastProgress& progress = {}, const svm::PageOptions& pages = {});

}  // namespace dmpc::apps
