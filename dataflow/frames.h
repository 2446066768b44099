// Frames: pictures of one scene from one place after another, on nodes that keep their regions.
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

/// A run of one frame, or of many. The film of each is that of a run of it alone. Regions are those that were prepared, or where
/// they have moved since; what else there is of a frame nodes do not keep. The camera comes to the nodes as their regions did,
/// before the start, in no virtual time. Thread safety: none.
class Frames {
 public:
  /// Makes nodes and host for what prepare() has prepared with these settings, those of the first frame, and options; all of
  /// these but options outlive it. On ranks it hands out. `stop` is that of the run.
  Frames(const Prepared& prepared, const core::RenderSettings& first, const RunOptions& options, const std::stop_token& stop);
  Frames(const Frames&) = delete;
  Frames& operator=(const Frames&) = delete;

  /// The first frame. Throws core::InternalError if a law of conservation is broken.
  Report render(std::stop_token stop);
  /// The next, after one that has finished, where the options say that there are several: `settings` differ from the first ones
  /// in the camera, and what follows from it, alone. `detail` is its picture's.
  Report render(const core::RenderSettings& settings, const core::FineDetail& detail, std::stop_token stop);

 private:
  /// What programs and host had counted when the frame began.
  struct Before {
    std::vector<ProgramReport> nodes;
    HostCounters host;
  };

  void add_shares(Report& report);

  const Prepared& prepared_;
  RunOptions options_;
  core::RenderSettings settings_;  ///< of the frame under way
  core::FineDetail detail_;
  Plan plan_;
  std::optional<pictures::Computer> computer_;
  Before before_;
};

}  // namespace dmpc::dataflow
