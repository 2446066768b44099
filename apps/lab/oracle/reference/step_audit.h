// Checks that each step of the product's way through a pixel is right except for rounding, however far the steps lead together.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "apps/lab/oracle/reference/ray_log.h"
#include "apps/lab/oracle/reference/witness.h"

namespace dmpc::apps {

/// What an audit of a pixel found.
struct Audit {
  /// For each ray of the log: why rounding let the product answer otherwise than exact geometry, where it did.
  std::vector<std::optional<Verdict>> doubts;
  /// The farthest that a ray lies from where it should, in units of what disturbances (disturbance.h) do to it.
  double largest_step = 0;
  bool is_warned = false;  ///< an answer is farther off than pixels may be without a word, and no farther than was said
  std::string error;       ///< what cannot be explained, in words; empty if all can
  /// What the hits send on by themselves, and by how much disturbances change that.
  core::Vec3d glow, glow_doubt;
};

/// Takes the product's rays as they are, floats and all, and asks at each of them in double precision, of the scene as its file
/// has it:
///   - Is the answer right? If the accurate renderer answers the very same ray otherwise, a ray beside it must have the product's
///     answer (witness.h), no farther off than core::rounding_allowed_pixels, as pixels are seen there from the eye; where it is
///     farther off, but no more than the product said before it began, the pixel is warned. And where it meets its body, it or a
///     ray beside it must do so.
///   - Do the right rays start from the hit: those towards lights, mirrored, refracted, with start, direction and weight? They
///     may be off by `steps_allowed` times as much as disturbances move them; a ray may be there or missing only where a
///     disturbance decides so, too. What a ray starts off its surface by must leave nothing out: between there and the surface
///     is nothing, nor between the eye and the start of its ray.
/// So nothing is left to how mirrors and glass multiply errors: a picture that passes is the exact picture of rays that were
/// rounded at each step. Immutable, thread-safe.
class StepAudit {
 public:
  static constexpr double steps_allowed = 4;
  /// Nothing is warned that is farther off, whatever was said: things that are a sixteenth of the side of 256 pixels from where
  /// they should be make another picture. The narrowest ring of witnesses is then still a quarter of what is allowed without a
  /// word.
  static constexpr double warned_pixels_max = 16;

  /// All outlive the audit; `scene` is what `database` was built of, `finder` is made of it. `warned_pixels`: how far the product
  /// said that anything may be off, or how large what it leaves out.
  StepAudit(const core::Database& database, const core::ShadeOptions& options, const ReferenceScene& scene,
            const ReferenceFinder& finder, double warned_pixels = 0)
      : unit_(1 / database.header().frame.scale),
        warned_pixels_(std::min(warned_pixels, warned_pixels_max)),
        options_(options),
        scene_(scene),
        finder_(finder),
        witnesses_(scene, finder) {}

  /// `primary` is the ray that the log should begin with.
  Audit of(const ProductLog& log, const ReferenceRay& primary) const;

 private:
  class Case;

  double unit_;  ///< the product's grid-local unit in the world's
  double warned_pixels_;
  core::ShadeOptions options_;
  const ReferenceScene& scene_;
  const ReferenceFinder& finder_;
  WitnessFinder witnesses_;
};

}  // namespace dmpc::apps
