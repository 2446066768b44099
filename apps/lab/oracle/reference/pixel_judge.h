// Explains why a pixel of the product's picture differs from the reference renderer's.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "apps/lab/oracle/reference/camera.h"
#include "apps/lab/oracle/reference/ray_log.h"
#include "apps/lab/oracle/reference/step_audit.h"
#include "core/picture/film/rounding_loss.h"

namespace dmpc::apps {

/// The first point at which the rays of the two renderers differ, if they do.
enum class PixelCause : std::uint8_t {
  tie,                ///< two surfaces lie so near to each other that rounding orders them
  silhouette,         ///< a ray passes a surface's silhouette within rounding
  shadow_silhouette,  ///< a shadow ray does so
  ray_end,            ///< an occluder lies within rounding of the shadow ray's start or end
  terminator,         ///< the surface all but turns away from a light, and rounding decides whether a shadow ray is sent
  critical_angle,     ///< rounding decides whether a ray still leaves glass
  rounding,           ///< the surfaces are the same all the way, and the colours differ by rounding alone
  warned,             ///< a surface is farther off than pixels may be without a warning, but no farther than was warned of
  unexplained         ///< none of these: an error of one of the renderers
};
inline constexpr std::size_t pixel_cause_count = 9;
std::string_view name_of(PixelCause cause);

struct Judgement {
  PixelCause cause{};
  double largest_step = 0;  ///< from the pixel's Audit
  std::string error;        ///< of an unexplained pixel
};

/// Follows a pixel's rays in both renderers to the first point where they differ. The pixel is explained if its light is that of
/// its rays and StepAudit reports no error: then each step is right except for rounding, and the difference is within the
/// accumulated rounding up to that point. Thread-safe.
class PixelJudge {
 public:
  /// All outlive the judge; `database` was built from `scene`, and `finder` is made from it; `loss` is the loss that was reported
  /// before.
  PixelJudge(const core::Database& database, const core::RenderSettings& settings, const ReferenceScene& scene,
             const ReferenceFinder& finder, const ReferenceCamera& camera, const core::RoundingLoss& loss = {});

  /// Judges a pixel with this linear radiance, of a picture with one sample a pixel.
  Judgement judge(std::uint32_t pixel, const core::Vec3d& radiance) const;

 private:
  bool is_light_of(const ProductLog& product, const Audit& audit, const core::Vec3d& radiance) const;
  PixelCause cause_of_parting(const ProductLog& product, const RayLog& reference, const Audit& audit) const;
  PixelCause cause_of_answers(const LoggedRay& product, const LoggedRay& reference, const std::optional<Verdict>& doubt) const;

  ProductLogger logger_;
  StepAudit audit_;
  core::ShadeOptions options_;
  const ReferenceScene& scene_;
  const ReferenceFinder& finder_;
  const ReferenceCamera& camera_;
  double unit_;  ///< the product's grid-local unit in world units
};

}  // namespace dmpc::apps
