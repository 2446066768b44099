// The options of `render`: a scene, a computer, a strategy, and outputs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/run/checkpoint_options.h"
#include "apps/run/frame_options.h"
#include "apps/run/heat_options.h"
#include "apps/run/layer_options.h"
#include "apps/run/strategy_options.h"
#include "apps/run/systems.h"
#include "apps/run/trace_options.h"
#include "apps/scene/database_options.h"
#include "apps/scene/picture_options.h"

namespace dmpc::apps {

struct RenderOptions : StrategyOptions {
  std::optional<System> system;      ///< the named system, whose options the strategy has
  bool is_node_count_given = false;  ///< otherwise, with ranks, it follows from their processors
  PictureOptions picture;
  DatabaseOptions database;
  FrameOptions frames;
  std::filesystem::path image;
  std::optional<std::filesystem::path> stats;   ///< JSON file of the counters
  std::optional<std::filesystem::path> report;  ///< HTML file of the report
  std::vector<HeatRequest> heat_maps;
  std::vector<LayerRequest> layers;
  TraceOptions trace;
  std::optional<std::filesystem::path> references;  ///< CSV file of the nodes' page references
  CheckpointOptions checkpoint;                     ///< checkpoint of the unfinished picture
  std::optional<double> seconds_max;                ///< of a refined picture, from the start of its rendering; above 0
  std::string serve_port;                           ///< port for browsers, 0: any free port; empty: none
  bool quiet = false;                               ///< no progress and no closing lines
};

/// Returns whether the pagers count the pages of each pixel, for --count-pages or a heat map; then they do not record references.
bool counts_pages(const RenderOptions& render);

/// For OptionSet::check_in_the_end(): throws core::UsageError for an option that contradicts the runner.
void check_runner(const OptionSet& options, RunnerKind runner);

/// Declares the options and the checks of their combinations.
void add_options(OptionSet options, RenderOptions& render);

}  // namespace dmpc::apps
