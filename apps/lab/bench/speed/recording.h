// The rays of a real render, by class, to be traced again by all whose speed is compared.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "apps/lab/bench/speed/bundled_rays.h"
#include "core/database/database.h"
#include "core/picture/pixel_task.h"
#include "core/trace/operations.h"

namespace dmpc::apps {

/// Secondary: reflected and refracted. Bounce: what a path tracer would shoot from the hits of primary rays, in directions that
/// the cosine to the surface's normal weighs.
enum class RayClass : std::uint8_t { primary, shadow, secondary, bounce };
inline constexpr std::size_t ray_class_count = 4;
/// As tables call it.
const char* name_of(RayClass ray_class);

/// An even sample of whole bundles, in the order of the shots: those whose numbers, hashed, end in enough zeros. (Every n-th one
/// would favour one light of two.)
class BundleSample {
 public:
  /// Keeps at most `most` rays, and all of fewer. Requires `most` to be a bundle's rays at least.
  explicit BundleSample(std::size_t most) : most_(most) {}

  /// The next bundle that was shot.
  void offer(std::span<const core::Ray> bundle);
  /// With about half of `most` rays or more, once as many have been shot.
  BundledRays bundles() const;

 private:
  struct Numbered {
    std::uint64_t hash = 0;
    std::vector<core::Ray> rays;
  };

  bool is_kept(std::uint64_t hash) const { return (hash & (stride_ - 1)) == 0; }
  void halve();

  std::size_t most_;
  std::uint64_t stride_ = 1;  ///< one of so many bundles is kept: a power of 2
  std::uint64_t shot_ = 0;
  std::size_t rays_kept_ = 0;
  std::vector<Numbered> kept_;
};

struct Recording {
  std::array<BundledRays, ray_class_count> rays;  ///< by class, at most so many each; empty if the scene has none
  core::Operations operations;                    ///< of the whole render

  const BundledRays& of(RayClass ray_class) const { return rays[static_cast<std::size_t>(ray_class)]; }
};

/// Renders the first pass on one thread, in bundles as nodes of svm do, and keeps at most `most` rays of each class, in whole
/// bundles. The bounces from the hits of one bundle of primary rays are a bundle. Deterministic.
Recording record_rays(const core::Database& database, const core::RenderSettings& settings, std::size_t most);

/// A ray from a primary ray's hit, started as core/picture/shade.h starts its children. Its direction is drawn by `number`.
core::Ray bounce_ray(const core::Ray& primary, const core::Hit& hit, const core::LocalRecords& records,
                     const core::DatabaseHeader& header, std::uint64_t number);

}  // namespace dmpc::apps
