// Frames: pictures of one scene from one place after another, on nodes that keep what they have.
#pragma once

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

/// Any programs of this family under a plan, on a computer. Thread safety: none.
class PictureComputer {
 public:
  /// Makes nodes and host. `plan` and what `make_program` was made with outlive this.
  PictureComputer(const Plan& plan, const MakeProgram& make_program, const RunOptions& options);

  /// As pictures::Computer's. Not where programs are others than pictures::PictureProgram.
  void begin_frame(const core::RenderSettings& settings, const core::FineDetail* detail);

  /// Runs, checks the laws of conservation and reports: what is counted is this picture's.
  Report render(std::stop_token stop);

 private:
  const Plan& plan_;
  pictures::Computer computer_;
  std::vector<ProgramReport> before_;  ///< what programs had counted when the picture began
};

/// A run of one frame, or of many. The film of each is that of a run of it alone; what is counted of it, and how long it takes,
/// is not: caches, and which pages are resident, are those that the frames before it have left. The camera comes to the nodes
/// as the scene did, before the start, in no virtual time. Thread safety: none.
class Frames {
 public:
  /// Plans and, on ranks, hands out. `first`: the settings of the first frame. `are_several`: it may not be the only one, which
  /// other ranks have to know. `database` outlives this. Throws as make_plan() does. After a stop is requested it makes haste.
  Frames(const Strategy& strategy, const core::Database& database, const core::RenderSettings& first, const RunOptions& options,
         const std::stop_token& stop, bool are_several = true);
  Frames(const Frames&) = delete;
  Frames& operator=(const Frames&) = delete;

  /// The next frame: of the first, `settings` are those that this was made with, of any other they differ from them in the
  /// camera, and what follows from it, alone. Not after a frame that was interrupted. Throws as run_by() does.
  Report render(const core::RenderSettings& settings, std::stop_token stop);

 private:
  const core::Database& database_;
  RunOptions options_;
  core::RenderSettings settings_;  ///< of the frame under way, to which nodes of a modelled machine refer
  core::FineDetail detail_;
  Plan plan_;
  nodes::ByteSource bytes_;
  std::vector<ReferenceLog> recorded_;  ///< one a node, where references become a part of the report
  MakeProgram maker_;
  std::optional<PictureComputer> computer_;
};

}  // namespace dmpc::svm
