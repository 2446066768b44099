// The options of `render`: a scene, a computer, and what to look at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "apps/command_line.h"
#include "apps/picture_options.h"
#include "svm/run.h"

namespace dmpc::apps {

/// Who finds what a ray hits: our grid, or Embree (with strategy replicated only).
enum class TracerChoice : std::uint8_t { grid, embree };

struct RenderOptions {
  PictureOptions picture;
  svm::Strategy strategy = svm::Strategy::svm;
  svm::RunOptions run;                 ///< progress is left unset
  std::size_t page_size_bytes = 1024;  ///< a power of two, 512 B to 64 KiB
  TracerChoice tracer = TracerChoice::grid;
  std::filesystem::path image;                 ///< where the picture goes
  std::optional<std::filesystem::path> stats;  ///< where the counters go, as JSON
  bool quiet = false;                          ///< no progress and no closing lines
};

/// Declares them, and which go together.
void add_options(OptionSet options, RenderOptions& render);

}  // namespace dmpc::apps
