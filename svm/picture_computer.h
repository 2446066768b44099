// The emulated computer as it renders pictures of one scene, one after another: a runner with the programs of a plan.
#pragma once

#include <memory>
#include <stop_token>
#include <vector>

#include "core/picture/film.h"
#include "core/picture/fine_detail.h"
#include "core/picture/pixel_task.h"
#include "nodes/runner.h"
#include "svm/pages/node_program.h"
#include "svm/plan.h"
#include "svm/run.h"
#include "svm/strategy.h"

namespace dmpc::svm {

/// Any programs of this family under a plan. Between two pictures the nodes stay as they are: their homes, caches, forests and
/// shares of the picture, and where they have their memories. Thread safety: none.
class PictureComputer {
 public:
  /// Makes nodes and host. `plan` and what `make_program` was made with outlive this.
  PictureComputer(const Plan& plan, const MakeProgram& make_program, const RunOptions& options);
  PictureComputer(const PictureComputer&) = delete;
  PictureComputer& operator=(const PictureComputer&) = delete;
  ~PictureComputer();

  /// The next picture is that of `settings`, which outlive its render() and are of the same size and samples. After a render()
  /// that has finished; not where programs are others than PictureProgram. On ranks of the nodes that are here.
  void begin_frame(const core::RenderSettings& settings, const core::FineDetail* detail);

  /// Runs, checks the laws of conservation and reports: what is counted is this picture's.
  Report render(std::stop_token stop);

 private:
  const Plan& plan_;
  RunOptions options_;
  core::Film film_;
  std::unique_ptr<nodes::Runner> runner_;
  std::vector<ProgramReport> before_;  ///< what programs had counted when the picture began
};

}  // namespace dmpc::svm
