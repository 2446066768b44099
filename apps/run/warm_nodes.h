// Nodes that render pictures of one scene and one size, one after the other.
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

/// A picture with another camera and what depends on it.
core::RenderSettings seen_from(const core::View& view, const core::RenderSettings& settings, const core::Database& database);

/// They keep memories, caches and regions from picture to picture, unless one was stopped: then the next begins on new ones.
/// Thread safety: none.
class WarmNodes {
 public:
  /// Options and database outlive it.
  WarmNodes(const StrategyOptions& options, const core::Database& database, core::RenderSettings settings)
      : options_(options), database_(database), settings_(std::move(settings)) {}
  WarmNodes(const WarmNodes&) = delete;
  WarmNodes& operator=(const WarmNodes&) = delete;

  const core::Camera& camera() const { return settings_.camera; }
  /// From where the next picture is seen.
  void move_to(const core::View& view) { settings_ = seen_from(view, settings_, database_); }

  /// As make_ready(), whose notes it returns. Not needed where nobody looks on.
  std::vector<std::string> plan(const nodes::Watching& watching = {}, const core::Continuation& continuation = {},
                                const std::stop_token& stop = {});
  /// Renders; says by `progress` how far it is. Throws as make_ready(), ReadyRun::start() and go_on() do.
  Report render(const nodes::Progress& progress, const std::stop_token& stop);

 private:
  const StrategyOptions& options_;
  const core::Database& database_;
  core::RenderSettings settings_;
  std::optional<ReadyRun> ready_;  ///< while it is good for a further picture
  bool is_started_ = false;
  nodes::Progress progress_;
};

}  // namespace dmpc::apps
