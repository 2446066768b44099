// Why a pixel of the product's picture is not that of the accurate one.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "apps/lab/oracle/reference/camera.h"
#include "apps/lab/oracle/reference/ray_log.h"
#include "apps/lab/oracle/reference/step_audit.h"
#include "core/picture/film/rounding_loss.h"

namespace dmpc::apps {

/// Where the rays of the two renderers part first, if they do.
enum class PixelCause : std::uint8_t {
  tie,                ///< two surfaces lie so near to each other that rounding orders them
  silhouette,         ///< a ray passes one within rounding
  shadow_silhouette,  ///< a shadow ray does
  ray_end,            ///< what hides a light lies within rounding of the shadow ray's start or end
  terminator,         ///< the surface all but turns away from a light, and rounding decides whether it is asked
  critical_angle,     ///< rounding decides whether a ray still leaves glass
  rounding,           ///< the same surfaces all the way: the colours differ by rounding alone
  warned,             ///< something lies farther off than pixels may be without a word, but no farther than was said
  unexplained         ///< none of these: an error of one of the renderers
};
inline constexpr std::size_t pixel_cause_count = 9;
std::string_view name_of(PixelCause cause);

struct Judgement {
  PixelCause cause{};
  double largest_step = 0;  ///< from the pixel's Audit
  std::string error;        ///< an unexplained pixel's
};

/// Follows a pixel's rays in both renderers to the first point where they differ. The pixel is explained if its light is that of
/// its rays and StepAudit reports no error: then each step is right except for rounding, and the difference is within the
/// accumulated rounding up to that point. Thread-safe.
class PixelJudge {
 public:
  /// All outlive the judge; `scene` is what `database` was built of, `finder` is made of it; `loss` is what was said before.
  PixelJudge(const core::Database& database, const core::RenderSettings& settings, const ReferenceScene& scene,
             const ReferenceFinder& finder, const ReferenceCamera& camera, const core::RoundingLoss& loss = {});

  /// Judges a pixel of a picture with one sample a pixel, which has this linear radiance there.
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
  double unit_;  ///< the product's grid-local unit in the world's
};

}  // namespace dmpc::apps
