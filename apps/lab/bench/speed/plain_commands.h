// Whole commands of part plain: as processes of their own, beside busy processes, and over ranks.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/edge/system/interrupt.h"
#include "apps/edge/system/scratch_folder.h"
#include "apps/lab/bench/speed/plain_contender.h"
#include "apps/lab/bench/speed/timed_process.h"

namespace dmpc::apps {

/// Runs `dmpc render` on one scene. Not thread-safe.
class PlainCommands {
 public:
  /// Ranks of which part plain has its rows.
  static constexpr int rank_count = 2;

  /// What is given outlives it. Each picture goes to a file.
  PlainCommands(const std::filesystem::path& program, const std::string& scene, const Resolution& size,
                const Interrupt& interrupt);

  /// Four figures in seconds: by the wall clock and by processor time what the command takes beyond the fastest of some that
  /// render 8x8 pixels, which start, load and build as it does, or no_figure where it took no longer than that; then what all of
  /// it takes. Throws as time_process().
  std::vector<double> figures_of_command(const PlainContender& contender) const;
  /// What the phase render takes by the wall clock, as the command's counters say: in one process, or with its nodes over ranks
  /// that mpirun starts, which takes too long and too differently for a difference. Throws core::InputError, too, if they do not.
  double render_seconds(const PlainContender& contender, bool is_over_ranks) const;
  /// Why no mpirun gets such a command to its end; empty if one does.
  std::string why_no_ranks() const;
  /// Where a picture may be written.
  std::filesystem::path picture() const { return folder_ / "picture.exr"; }

 private:
  Times times_of(const PlainContender& contender, const Resolution& size) const;
  Times least_times_of(const PlainContender& contender) const;
  void run(const PlainContender& contender, const Resolution& size, bool is_over_ranks) const;

  const std::filesystem::path& program_;
  const std::string& scene_;
  Resolution size_;
  const Interrupt& interrupt_;
  ScratchFolder folder_;
};

}  // namespace dmpc::apps
