// A `dmpc render` as a process of its own, and what it tells.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/system/interrupt.h"
#include "apps/frontend/system/scratch_folder.h"
#include "apps/lab/figures/figures_file.h"

namespace dmpc::apps {

/// "dmpc: there is no room\n" as "there is no room".
std::string sentence_of(std::string complaint);

/// What became of it.
struct RenderEnd {
  std::optional<std::vector<Figure>> figures;       ///< of its --stats; nothing if there was no room for it
  std::string misfit;                               ///< without figures: why, without a full stop
  std::optional<std::size_t> peak_anonymous_bytes;  ///< if it was seen with any
};

/// Thread-safe, if no two renders at a time have one name.
class RenderProcesses {
 public:
  /// Both outlive it.
  RenderProcesses(const std::filesystem::path& program, const Interrupt& interrupt) : program_(program), interrupt_(interrupt) {}

  using Keep = std::function<void(const std::filesystem::path& stats)>;

  /// Runs `words`, of a line of `render` but for its outputs, to its end. Its counters go to a scratch file, which `keep` may
  /// copy once they are read, its picture nowhere. A computer out of memory ends a process by the signal that cannot be caught:
  /// that is no room, too. Throws Interrupted after a signal, core::InputError if the program cannot be started or its input is
  /// bad, core::InternalError for any other end.
  RenderEnd run(std::vector<std::string> words, const std::string& name, const Keep& keep = {}) const;

  /// With the words that say where counters and picture go.
  static std::vector<std::string> with_outputs(std::vector<std::string> words, const std::string& stats,
                                               const std::string& picture);

 private:
  const std::filesystem::path& program_;
  const Interrupt& interrupt_;
  ScratchFolder folder_;
};

}  // namespace dmpc::apps
