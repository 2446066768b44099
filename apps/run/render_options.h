// The options of `render`: a scene, a computer, a strategy, and what to look at.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/run/checkpoint_options.h"
#include "apps/run/frame_options.h"
#include "apps/run/heat_options.h"
#include "apps/run/strategy_options.h"
#include "apps/run/systems.h"
#include "apps/run/trace_options.h"
#include "apps/scene/database_options.h"
#include "apps/scene/picture_options.h"

namespace dmpc::apps {

struct RenderOptions : StrategyOptions {
  std::optional<System> system;      ///< whose options the strategy has, if one was named
  bool is_node_count_given = false;  ///< else, on ranks, it follows from their processors
  PictureOptions picture;
  DatabaseOptions database;
  FrameOptions frames;
  std::filesystem::path image;                      ///< where the picture goes
  std::optional<std::filesystem::path> stats;       ///< where the counters go, as JSON
  std::optional<std::filesystem::path> report;      ///< where the page goes that shows all of it
  std::vector<HeatRequest> heat_maps;               ///< what else is to be shown of each pixel
  TraceOptions trace;                               ///< what is recorded of the run
  std::optional<std::filesystem::path> references;  ///< where the nodes' page references go, as CSV
  CheckpointOptions checkpoint;                     ///< what is kept on the way
  std::string serve_port;                           ///< the port at which browsers may look on, 0: any; empty: nobody may
  bool quiet = false;                               ///< no progress and no closing lines
};

/// Whether the nodes' pagers count the pages of each pixel, for --count-pages or a heat map: then they do not note references.
bool counts_pages(const RenderOptions& render);

/// For OptionSet::check_in_the_end(): throws core::UsageError for an option that does not go with the runner.
void check_runner(const OptionSet& options, RunnerKind runner);

/// Declares them, and which go together.
void add_options(OptionSet options, RenderOptions& render);

}  // namespace dmpc::apps
