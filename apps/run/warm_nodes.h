// Nodes that render several pictures of one scene and size in succession.
#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "apps/run/report.h"
#include "apps/run/run_strategy.h"
#include "core/database/database.h"
#include "core/picture/film/partial_picture.h"
#include "core/picture/pixel_task.h"
#include "core/scene/scene.h"
#include "nodes/observers/watching.h"

namespace dmpc::apps {

/// Returns the settings with another camera and what depends on it.
core::RenderSettings seen_from(const core::View& view, const core::RenderSettings& settings, const core::Database& database);

/// Nodes keep memory, caches and regions between pictures; after a stopped picture new nodes are made. Thread safety: none.
class WarmNodes {
 public:
  /// `options` and `database` outlive this object.
  WarmNodes(const StrategyOptions& options, const core::Database& database, core::RenderSettings settings)
      : options_(options), database_(database), settings_(std::move(settings)) {}
  WarmNodes(const WarmNodes&) = delete;
  WarmNodes& operator=(const WarmNodes&) = delete;

  const core::Camera& camera() const { return settings_.camera; }
  const core::RenderSettings& settings() const { return settings_; }
  /// Sets the view of the next picture.
  void move_to(const core::View& view) { settings_ = seen_from(view, settings_, database_); }

  /// Calls make_ready() and returns its notes. Only needed with an observer.
  std::vector<std::string> plan(const nodes::Watching& watching = {}, const core::Continuation& continuation = {},
                                const std::stop_token& stop = {});
  /// Renders, and reports to `progress`. Throws as make_ready(), ReadyRun::start() and go_on() do.
  Report render(const nodes::Progress& progress, const std::stop_token& stop);

 private:
  const StrategyOptions& options_;
  const core::Database& database_;
  core::RenderSettings settings_;
  std::optional<ReadyRun> ready_;  ///< if usable for another picture
  bool is_started_ = false;
  nodes::Progress progress_;
};

}  // namespace dmpc::apps
