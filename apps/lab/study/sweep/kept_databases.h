// Keeps the databases of large scenes in a folder, each for all runs that need it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "apps/frontend/system/opened_files.h"
#include "apps/lab/study/sweep/settings.h"

namespace dmpc::apps {

/// SCENE-KEY.pages for each set of options that decide a database (apps/scene/database_facts.h). A file is used only if this
/// program reads it and the scene's files have not changed since; another one is removed, which is said.
class KeptDatabases {
 public:
  /// `scene`: the files that it is read from. The folder for kept counters exists. `say` prints a sentence.
  KeptDatabases(const SweepSettings& settings, const OpenedFiles& scene, std::function<void(const std::string&)> say);

  /// Builds the database that the run needs, unless it is kept; a small one is not worth a file. Throws as build_file() does.
  void provide(const SweepRun& run);
  /// The run's words, with its database in place of the scene if there is one.
  std::vector<std::string> words_for(const SweepRun& run) const;

 private:
  std::filesystem::path file_of(const SweepRun& run) const;
  bool is_current(const std::filesystem::path& file) const;

  std::filesystem::path folder_;
  std::size_t bytes_min_;
  std::uint64_t source_;
  std::function<void(const std::string&)> say_;
  std::map<std::filesystem::path, bool> is_there_;  ///< files that were looked for or built
};

}  // namespace dmpc::apps
