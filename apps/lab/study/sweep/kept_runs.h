// Keeps the counters of runs in a folder, so that a stopped sweep can continue and a larger one can reuse them.
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
/// modules, the options in any order, and the bytes of the files from which they and the scene are read. A file is used only if
/// it is an ordinary file of counters with all requested figures; links are not followed, and for anything else the run is
/// repeated and the file replaced. Processes may share a folder: dmpc writes files atomically.
class KeptRuns {
 public:
  /// Makes the folder if needed, and reads the program and the scene's files. `columns` are the names of the table's figures.
  /// Throws core::InputError unless files can be made there.
  KeptRuns(const std::filesystem::path& folder, const std::filesystem::path& program, const OpenedFiles& scene,
           std::vector<std::string> columns = {});

  /// Returns the path of the run's counters.
  std::filesystem::path file_of(const SweepRun& run) const;
  /// Returns nothing if they are absent, damaged, or incomplete.
  std::optional<std::vector<Figure>> find(const SweepRun& run) const;
  /// Keeps the counters that --stats has written. Throws core::InputError on failure.
  void keep(const SweepRun& run, const std::filesystem::path& stats) const;

 private:
  std::filesystem::path folder_;
  std::vector<std::string> columns_;
  std::uint64_t common_ = 0;  ///< digest of programs and scene
};

}  // namespace dmpc::apps
