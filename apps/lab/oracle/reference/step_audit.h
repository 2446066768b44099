// Checks that each step of the product's path through a pixel is right except for rounding, however much the errors of the steps
// add up.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "apps/lab/oracle/reference/ray_log.h"
#include "apps/lab/oracle/reference/witness.h"

namespace dmpc::apps {

struct Audit {
  /// For each ray of the log: why rounding let the product's answer differ from exact geometry, where it did.
  std::vector<std::optional<Verdict>> doubts;
  /// The farthest that a ray lies from its right position, in units of the disturbances (disturbance.h) of it.
  double largest_step = 0;
  bool is_warned = false;  ///< an answer is farther off than pixels may be without a warning, and no farther than was warned of
  std::string error;       ///< what cannot be explained, in words; empty if all is explained
  /// The light that the hits send by themselves, and how much disturbances change it.
  core::Vec3d glow, glow_doubt;
};

/// Takes the product's rays as they are, including their float rounding, and checks each in double precision against the scene as
/// its file has it:
/// - Is the answer right? If the reference renderer answers the very same ray otherwise, a ray beside it must have the product's
///   answer (witness.h), no farther off than core::rounding_allowed_pixels, as pixels are seen there from the eye. If it is
///   farther off, but by no more than the product warned of, the pixel is warned. Where a ray meets its body, it or a ray beside
///   it must do so.
/// - Do the right rays start from the hit: those towards lights, mirrored and refracted ones, with start, direction and weight?
///   They may be off by `steps_allowed` times as much as disturbances move them; a ray may be present or missing only where a
///   disturbance decides so, too. A ray's offset from its surface must skip nothing: nothing lies between its start and the
///   surface, or between the eye and the start of its ray.
///
/// So the result does not depend on how mirrors and glass multiply errors: a picture that passes is the exact picture of rays
/// that were rounded at each step. Immutable, thread-safe.
class StepAudit {
 public:
  static constexpr double steps_allowed = 4;
  /// An error that is larger is never just warned of: things a sixteenth of the side of 256 pixels from their right position make
  /// another picture. The narrowest ring of witnesses is then still a quarter of what is allowed without a warning.
  static constexpr double warned_pixels_max = 16;

  /// All outlive the audit; `database` was built from `scene`, and `finder` is made from it. `warned_pixels`: how far off the
  /// product warned that anything may be, or how large what it leaves out may be.
  StepAudit(const core::Database& database, const core::ShadeOptions& options, const ReferenceScene& scene,
            const ReferenceFinder& finder, double warned_pixels = 0)
      : unit_(1 / database.header().frame.scale),
        warned_pixels_(std::min(warned_pixels, warned_pixels_max)),
        options_(options),
        scene_(scene),
        finder_(finder),
        witnesses_(scene, finder) {}

  /// `primary` is the ray with which the log should begin.
  Audit of(const ProductLog& log, const ReferenceRay& primary) const;

 private:
  class Case;

  double unit_;  ///< the product's grid-local unit in world units
  double warned_pixels_;
  core::ShadeOptions options_;
  const ReferenceScene& scene_;
  const ReferenceFinder& finder_;
  WitnessFinder witnesses_;
};

}  // namespace dmpc::apps
