// The study `frames`: what nodes that keep what they have fetch and send of a frame, beside nodes that begin with nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/edge/table/plot.h"
#include "apps/lab/study/engine/study_line.h"
#include "apps/lab/study/runs.h"
#include "apps/scene/subject.h"
#include "core/scene/scene.h"
#include "nodes/machine.h"

namespace dmpc::apps {

/// For pages with caches of several sizes, for questions and for rays that travel, the mean over frames 2 to the last of a
/// camera's path, on modelled machines: each frame by nodes that have rendered those before it (warm), and by others that have
/// rendered none (cold).
struct FramesStudy {
  static constexpr const char* name = "frames";
  static constexpr const char* description = "What frames of a moving camera fetch and send, with caches warm and cold";

  std::vector<std::uint32_t> node_counts = {8};      ///< each at least 2
  std::uint32_t frame_count = 6;                     ///< at least 2
  bool has_each_frame = false;                       ///< rows for single frames, too
  double turntable_degrees = 1;                      ///< a frame
  std::optional<std::filesystem::path> camera_path;  ///< in place of the turntable
  std::vector<nodes::Machine> machines = {*on_usual_machine().computer.machine};
  RunnerOptions runner;                    ///< of the command line, by which the machines were chosen
  std::vector<std::string> machine_names;  ///< likewise, if there are several
  core::View own_view;                     ///< the scene's, which it is given
  core::Box bounds;                        ///< likewise, in the world's coordinates
  /// The scene and its picture as one tree, of which questions are asked. Must be there to measure().
  std::function<Subject()> build_tree;

  void add_options(StudyLine line);
  std::vector<Column> columns() const;
  std::vector<Plot> plots() const;
  void measure(StudyRuns& runs, Table& table) const;
  std::vector<std::string> notes(const std::string& scene) const;
  std::string conclusion(const Table& table) const;
};

}  // namespace dmpc::apps
