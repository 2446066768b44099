// POV-Ray, where it is installed, as a rival.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "apps/edge/system/interrupt.h"
#include "apps/edge/system/scratch_folder.h"
#include "apps/edge/system/stopwatch.h"
#include "apps/lab/bench/speed/plain_renderer.h"

namespace dmpc::apps {

/// One scene, as POV-Ray renders it: by rays from pixels' middles, without antialiasing. Not thread-safe.
class PovRival {
 public:
  /// Writes the scene; `subject` is needed no longer. Throws core::InputError if it cannot be written.
  explicit PovRival(const Subject& subject);

  /// Whether the program `povray` is there.
  static bool is_installed();
  /// Renders, and returns what POV-Ray says that tracing took: not parsing, nor its tree. Throws core::InputError if it fails or
  /// says nothing of that; Interrupted after a signal.
  Times render(std::uint32_t thread_count, const Interrupt& interrupt) const;
  /// What was rendered last. Throws core::InputError if it cannot be read.
  PlainPicture picture() const;

 private:
  ScratchFolder folder_;
  int width_, height_;
};

/// "Trace Time: ... (0.470 seconds) using 2 thread(s) with 0.850 CPU-seconds total" among what POV-Ray says; nothing if it is not
/// there.
std::optional<Times> trace_times_in(std::string_view statistics);

/// The most, root mean square, that its picture may lie from ours, both cut off at 1. What remains lies in single pixels: at
/// edges of things and of shadows, since vertices are rounded to float on their way into the file and rays start elsewhere beside
/// surfaces; and where blended normals would send a reflected ray below a coarse mesh's surface, which POV-Ray bends back.
inline constexpr double pov_error_max = 5.0 / 255;

/// How far it lies from our film of `scene`. Throws core::InternalError if that is more than pov_error_max.
double pov_distance_to_ours(const PlainPicture& picture, const core::Film& film, const std::string& scene);

}  // namespace dmpc::apps
