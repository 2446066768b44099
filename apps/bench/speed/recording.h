// The rays of a real render, by class, to be traced again by all whose speed is compared.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/build/database.h"
#include "core/picture/pixel_task.h"
#include "core/trace/operations.h"

namespace dmpc::apps {

/// Secondary: reflected and refracted. Bounce: what a path tracer would shoot from the hits of primary rays, in directions that
/// the cosine to the surface's normal weighs.
enum class RayClass : std::uint8_t { primary, shadow, secondary, bounce };
inline constexpr std::size_t ray_class_count = 4;
/// As tables call it.
const char* name_of(RayClass ray_class);

/// An even sample of rays, in the order of the shots: those whose numbers, hashed, end in enough zeros. (Every n-th one would
/// favour one light of two.)
class RaySample {
 public:
  /// Keeps at most `most` rays, and all of fewer. Requires most > 0.
  explicit RaySample(std::size_t most) : most_(most) {}

  /// The next ray that was shot.
  void offer(const core::Ray& ray);
  /// About half of `most` or more, once as many have been shot.
  std::vector<core::Ray> rays() const;

 private:
  struct Numbered {
    std::uint64_t hash = 0;
    core::Ray ray;
  };

  bool is_kept(std::uint64_t hash) const { return (hash & (stride_ - 1)) == 0; }

  std::size_t most_;
  std::uint64_t stride_ = 1;  ///< one of so many rays is kept: a power of 2
  std::uint64_t shot_ = 0;
  std::vector<Numbered> kept_;
};

struct Recording {
  std::array<std::vector<core::Ray>, ray_class_count> rays;  ///< by class, at most so many each; empty if the scene has none
  core::Operations operations;                               ///< of the whole render

  const std::vector<core::Ray>& of(RayClass ray_class) const { return rays[static_cast<std::size_t>(ray_class)]; }
};

/// Renders on one thread and keeps at most `most` rays of each class. Deterministic.
Recording record_rays(const core::Database& database, const core::RenderSettings& settings, std::size_t most);

/// A ray from a primary ray's hit, started as core/picture/shade.h starts its children. Its direction is drawn by `number`.
core::Ray bounce_ray(const core::Ray& primary, const core::Hit& hit, const core::LocalRecords& records,
                     const core::DatabaseHeader& header, std::uint64_t number);

}  // namespace dmpc::apps
