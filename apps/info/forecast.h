// How much memory a render would take: by strategy and number of nodes, without rendering it.
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

/// What one strategy asks for, in bytes.
struct MemoryForecast {
  std::size_t least_bytes = 0;  ///< minimum of a node: with less a render is refused
  std::size_t usual_bytes = 0;  ///< default of the largest node, without options about memory
  std::size_t all_bytes = 0;    ///< sum over all nodes and the host in this case: what the real computer needs
};

/// Forecast for a computer of `nodes` nodes.
struct ComputerForecast {
  std::uint32_t nodes = 1;
  MemoryForecast svm, replicated;
  std::optional<MemoryForecast> dataflow;  ///< nothing for more nodes than its regions are for
  std::optional<MemoryForecast> forest;    ///< nothing unless the database is one tree
  double dataflow_copies = 1;              ///< copies per primitive, over all regions
};

struct Forecast {
  std::vector<ComputerForecast> computers;
  dataflow::Balance balance{};  ///< by which regions were made
  dataflow::CutOrder cuts{};    ///< and which way
  std::uint32_t regions_a_node = 1;
  svm::PageHomes homes{};     ///< for svm's pages
  double region_seconds = 0;  ///< that it took to make them, by the wall clock
};

/// Told (computers done, computers in all).
using ForecastProgress = std::function<void(std::uint64_t, std::uint64_t)>;

/// What `render` with these settings, svm with `pages`, and otherwise default options would plan. Space is cut up for every
/// number of nodes, by `balance`: unless that says equal_size the subsampled picture is rendered once, as dataflow does. Each
/// node count is from 1 to nodes::node_count_max. `database` has its records still. Throws core::UsageError as
/// dataflow::column_loads() does.
Forecast forecast(const core::Database& database, const core::RenderSettings& settings,
                  const std::vector<std::uint32_t>& node_counts, const dataflow::BalanceOptions& balance,
                  const ForecastProgress& progress = {}, const svm::PageOptions& pages = {});

}  // namespace dmpc::apps
