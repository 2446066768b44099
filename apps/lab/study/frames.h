// The study `frames`: what nodes that keep what they have fetch and send of a frame, beside nodes that begin with nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/edge/table/plot.h"
#include "apps/effort/planned_run.h"
#include "apps/lab/study/engine/study_line.h"
#include "apps/lab/study/runs.h"
#include "apps/scene/camera_path.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// For caches of several sizes, and for rays that travel, the mean over frames 2 to the last of a camera's path, on a modelled
/// machine: each frame by nodes that have rendered those before it (warm), and by others that have rendered none (cold).
struct FramesStudy {
  static constexpr const char* name = "frames";
  static constexpr const char* description = "What frames of a moving camera fetch and send, with caches warm and cold";

  std::uint32_t node_count = 8;
  std::uint32_t frame_count = 6;                     ///< at least 2
  double turntable_degrees = 1;                      ///< a frame
  std::optional<std::filesystem::path> camera_path;  ///< in place of the turntable
  StrategyOptions run = on_usual_machine();          ///< whose machine it is
  core::View own_view;                               ///< the scene's, which it is given
  core::Box bounds;                                  ///< likewise, in the world's coordinates

  void add_options(StudyLine line);
  std::vector<Column> columns() const;
  std::vector<Plot> plots() const;
  std::vector<PlannedRun> planned() const;
  void measure(StudyRuns& runs, Table& table) const;
  std::vector<std::string> notes(const std::string& scene) const;
  std::string conclusion(const Table& table) const;
};

}  // namespace dmpc::apps
