// Counters of runs in a folder, so that a sweep that was stopped goes on and a larger one takes what is there.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/system/opened_files.h"
#include "apps/lab/figures/figures_file.h"
#include "apps/lab/study/sweep/settings.h"

namespace dmpc::apps {

/// KEY.json for each run. The key is a digest of all that the counters depend on: the bytes of the program and of its readers and
/// modules, the options, in whatever order, and the bytes of files that they and the scene are read from. What lies there is
/// believed only as far as it is an ordinary file of counters with all that is asked for; links are not followed, and what is
/// anything else is run again and replaced. Safe to be shared by processes: dmpc writes a file whole or not at all.
class KeptRuns {
 public:
  /// Makes the folder unless there is one, and reads the program and the scene's files. `columns` are the names of figures that
  /// a table has. Throws core::InputError unless files can be made there.
  KeptRuns(const std::filesystem::path& folder, const std::filesystem::path& program, const OpenedFiles& scene,
           std::vector<std::string> columns = {});

  /// Where the run's counters lie, or are to lie.
  std::filesystem::path file_of(const SweepRun& run) const;
  /// Nothing if they are not there, damaged, or not all that is asked for.
  std::optional<std::vector<Figure>> find(const SweepRun& run) const;
  /// Keeps what --stats has written. Throws core::InputError if that fails.
  void keep(const SweepRun& run, const std::filesystem::path& stats) const;

 private:
  std::filesystem::path folder_;
  std::vector<std::string> columns_;
  std::uint64_t common_ = 0;  ///< digest of programs and scene
};

}  // namespace dmpc::apps
