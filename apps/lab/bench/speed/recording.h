// The rays of a real render, by class, which all contenders trace again.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/database/database.h"
#include "core/picture/pixel_task.h"
#include "core/record/ray.h"
#include "core/trace/operations.h"

namespace dmpc::apps {

/// secondary: reflected and refracted. bounce: what a path tracer would shoot from the hits of primary rays, in cosine-weighted
/// directions about the surface's normal.
enum class RayClass : std::uint8_t { primary, shadow, secondary, bounce };
inline constexpr std::size_t ray_class_count = 4;
const char* name_of(RayClass ray_class);

/// Some of the bundles; their owner keeps the rays.
struct BundleSpan {
  std::span<const core::Ray> all;          ///< the owner's rays
  std::span<const std::uint32_t> borders;  ///< borders of the bundles in `all`: one more than there are bundles

  std::size_t count() const { return borders.size() - 1; }
  std::span<const core::Ray> bundle(std::size_t index) const { return between(borders[index], borders[index + 1]); }
  /// Returns the rays of all its bundles, in order.
  std::span<const core::Ray> rays() const { return between(borders.front(), borders.back()); }
  /// Returns `most` bundles from index `first` on, or as many as there are. Requires first <= count().
  BundleSpan part(std::size_t first, std::size_t most) const {
    return {all, borders.subspan(first, std::min(most, count() - first) + 1)};
  }

 private:
  std::span<const core::Ray> between(std::uint32_t begin, std::uint32_t end) const { return all.subspan(begin, end - begin); }
};

/// Rays in one array, bundle after bundle.
struct BundledRays {
  std::vector<core::Ray> rays;
  std::vector<std::uint32_t> borders = {0};  ///< as BundleSpan's

  void add(std::span<const core::Ray> bundle) {
    rays.insert(rays.end(), bundle.begin(), bundle.end());
    borders.push_back(static_cast<std::uint32_t>(rays.size()));
  }
  BundleSpan bundles() const { return {rays, borders}; }
};

/// An even sample of whole bundles, in the order of the shots: those whose numbers, hashed, end in enough zeros. (Every n-th one
/// would favour one light of two.)
class BundleSample {
 public:
  /// Keeps at most `most` rays, or all if there are fewer. Requires that no bundle has more than `most` rays.
  explicit BundleSample(std::size_t most) : most_(most) {}

  /// Offers the next bundle that was shot.
  void offer(std::span<const core::Ray> bundle);
  /// Returns about half of `most` rays or more, once as many have been shot.
  BundledRays bundles() const;

 private:
  struct Numbered {
    std::uint64_t hash = 0;
    std::vector<core::Ray> rays;
  };

  bool is_kept(std::uint64_t hash) const { return (hash & (stride_ - 1)) == 0; }
  void halve();

  std::size_t most_;
  std::uint64_t stride_ = 1;  ///< one bundle in this many is kept: a power of 2
  std::uint64_t shot_ = 0;
  std::size_t rays_buffered_ = 0;
  std::vector<Numbered> kept_;
};

struct Recording {
  std::array<BundledRays, ray_class_count> rays;  ///< by class, each limited in number; empty if the scene has none
  core::Operations operations;                    ///< the whole render's

  const BundledRays& of(RayClass ray_class) const { return rays[static_cast<std::size_t>(ray_class)]; }
};

/// Renders the first pass on one thread, in bundles as nodes of svm do, and keeps at most `most` rays of each class, in whole
/// bundles. The bounces from the hits of one bundle of primary rays form a bundle. Deterministic.
Recording record_rays(const core::Database& database, const core::RenderSettings& settings, std::size_t most);

/// Returns a ray from a primary ray's hit, started as core/picture/shade.h starts child rays. `number` determines its direction.
core::Ray bounce_ray(const core::Ray& primary, const core::Hit& hit, const core::LocalRecords& records,
                     const core::DatabaseHeader& header, std::uint64_t number);

}  // namespace dmpc::apps
