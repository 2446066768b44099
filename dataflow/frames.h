// Frames: pictures of one scene from several viewpoints, on nodes that keep their regions.
#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "core/picture/pixel_task.h"
#include "core/picture/sampling/fine_detail.h"
#include "dataflow/host.h"
#include "dataflow/program.h"
#include "dataflow/run.h"
#include "nodes/pictures/computer.h"

namespace dmpc::dataflow {

/// A run of one frame, or of many. The film of each is that of a single run. Regions are those that were prepared, or where they
/// have moved since; nodes keep nothing else of a frame. The camera comes to the nodes as their regions did, before the start, in
/// no virtual time. Not thread-safe.
class Frames {
 public:
  /// Makes nodes and host for the result of prepare() with these settings, those of the first frame, and options; all of these
  /// except options outlive it. On ranks it hands out. `stop`: the run's.
  Frames(const Prepared& prepared, const core::RenderSettings& first, const RunOptions& options, const std::stop_token& stop);
  Frames(const Frames&) = delete;
  Frames& operator=(const Frames&) = delete;

  /// The first frame. Throws core::InternalError if a conservation law is broken.
  Report render(std::stop_token stop);
  /// The next frame, after one that has finished, if the options say that there are several: `settings` differ from the first
  /// ones only in the camera, and what follows from it. `detail`: its picture's.
  Report render(const core::RenderSettings& settings, const core::FineDetail& detail, std::stop_token stop);

 private:
  /// Counters of programs and host at the start of the frame.
  struct Before {
    std::vector<ProgramReport> nodes;
    HostCounters host;
  };

  void add_shares(Report& report);

  const Prepared& prepared_;
  RunOptions options_;
  core::RenderSettings settings_;  ///< the current frame's
  core::FineDetail detail_;
  Plan plan_;
  std::optional<pictures::Computer> computer_;
  Before before_;
};

}  // namespace dmpc::dataflow
