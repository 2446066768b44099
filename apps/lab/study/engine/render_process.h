// Runs `dmpc render` as a separate process, and reads its results.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/system/interrupt.h"
#include "apps/frontend/system/scratch_folder.h"
#include "apps/lab/figures/figures_file.h"

namespace dmpc::apps {

/// Turns "dmpc: there is no room\n" into "there is no room".
std::string sentence_of(std::string complaint);

struct RenderEnd {
  std::optional<std::vector<Figure>> figures;  ///< of its --stats; nothing if there was not enough memory
  std::string misfit;                          ///< the reason if there are no figures, without a full stop
};

/// Thread-safe if no two renders at a time have the same name.
class RenderProcesses {
 public:
  /// Both outlive it.
  RenderProcesses(const std::filesystem::path& program, const Interrupt& interrupt) : program_(program), interrupt_(interrupt) {}

  using Keep = std::function<void(const std::filesystem::path& stats)>;

  /// Runs `words`, a line of `render` without its outputs, to its end. Its counters go to a scratch file, which `keep` may copy
  /// once they are read; its picture is discarded. A computer out of memory kills a process with SIGKILL, which also counts as
  /// not enough memory. Throws Interrupted after a signal, core::InputError if the program cannot be started or its input is bad,
  /// core::InternalError for any other end.
  RenderEnd run(std::vector<std::string> words, const std::string& name, const Keep& keep = {}) const;

  /// Adds the words for the destinations of counters and picture.
  static std::vector<std::string> with_outputs(std::vector<std::string> words, const std::string& stats,
                                               const std::string& picture);

 private:
  const std::filesystem::path& program_;
  const Interrupt& interrupt_;
  ScratchFolder folder_;
};

}  // namespace dmpc::apps
