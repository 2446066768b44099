// Frames: pictures of one scene from several viewpoints, on nodes that keep their data.
#pragma once

#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/database/database.h"
#include "core/picture/pixel_task.h"
#include "core/picture/sampling/fine_detail.h"
#include "nodes/byte_source.h"
#include "nodes/pictures/computer.h"
#include "svm/pages/node_program.h"
#include "svm/pages/observers/reference_log.h"
#include "svm/plan.h"
#include "svm/run.h"
#include "svm/strategy.h"

namespace dmpc::svm {

/// Any programs of this family under a plan, on a computer. Not thread-safe.
class PictureComputer {
 public:
  /// Makes nodes and host. `plan` and the arguments of `make_program`'s maker outlive this.
  PictureComputer(const Plan& plan, const MakeProgram& make_program, const RunOptions& options);

  /// As pictures::Computer's. Only for programs that are a pictures::PictureProgram.
  void begin_frame(const core::RenderSettings& settings, const core::FineDetail* detail);

  /// Runs, checks the conservation laws and reports: counters are of this picture.
  Report render(std::stop_token stop);

 private:
  const Plan& plan_;
  pictures::Computer computer_;
  std::vector<ProgramReport> before_;  ///< counters at the start of the picture
};

/// A run of one frame, or of many. The film of each is that of a single run; its counters and its time are not: caches and
/// resident pages are left as they were by the frames before. The camera comes to the nodes as the scene did, before the start,
/// in no virtual time. Not thread-safe.
class Frames {
 public:
  /// Plans and, on ranks, hands out. `first`: the settings of the first frame. `are_several`: it may not be the only one, which
  /// other ranks have to know. `database` outlives this. Throws as make_plan() does. Returns early after a stop is requested.
  Frames(const Strategy& strategy, const core::Database& database, const core::RenderSettings& first, const RunOptions& options,
         const std::stop_token& stop, bool are_several = true);
  Frames(const Frames&) = delete;
  Frames& operator=(const Frames&) = delete;

  /// Renders the next frame: for the first, `settings` are those of the constructor, for others they differ only in the camera
  /// and what follows from it. Not after a frame that was interrupted. Throws as run_by() does.
  Report render(const core::RenderSettings& settings, std::stop_token stop);

 private:
  const core::Database& database_;
  RunOptions options_;
  core::RenderSettings settings_;  ///< the current frame's; nodes may refer to it
  core::FineDetail detail_;
  Plan plan_;
  std::unique_ptr<OwnPolicyRun> own_policy_;  ///< of the user's, if there is one
  nodes::ByteSource bytes_;
  std::vector<ReferenceLog> recorded_;  ///< one per node, if references are recorded for the report
  MakeProgram maker_;
  std::optional<PictureComputer> computer_;
};

}  // namespace dmpc::svm
