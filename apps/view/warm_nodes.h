// Nodes that render pictures of one scene and one size, one after the other.
#pragma once

#include <optional>
#include <stop_token>

#include "apps/run/report.h"
#include "apps/run/run_strategy.h"
#include "core/database/database.h"
#include "core/picture/pixel_task.h"
#include "core/scene/scene.h"
#include "nodes/watch/watching.h"

namespace dmpc::apps {

/// They keep memories, caches and regions from picture to picture, unless one was stopped: then the next begins on new ones.
/// Thread safety: none.
class WarmNodes {
 public:
  /// `settings` of a picture, whose camera alone changes. Options and database outlive it.
  WarmNodes(const StrategyOptions& options, const core::Database& database, const core::RenderSettings& settings)
      : options_(options), database_(database), settings_(settings) {}
  WarmNodes(const WarmNodes&) = delete;
  WarmNodes& operator=(const WarmNodes&) = delete;

  const core::Camera& camera() const { return settings_.camera; }
  /// What is seen from there; nothing if a stop was requested before it was done. The first call says by `progress` how far it
  /// is, and so do those that follow it. Throws as make_ready() and ReadyRun::start() do.
  std::optional<Report> render(const core::View& view, const nodes::Progress& progress, const std::stop_token& stop);

 private:
  Report run(const nodes::Progress& progress, const std::stop_token& stop);

  const StrategyOptions& options_;
  const core::Database& database_;
  core::RenderSettings settings_;
  std::optional<ReadyRun> ready_;  ///< while it is good for a further picture
  nodes::Progress progress_;
};

}  // namespace dmpc::apps
