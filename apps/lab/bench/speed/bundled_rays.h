// Rays in one array, bundle after bundle: for those who trace them one by one and for those who trace whole bundles.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/record/ray.h"

namespace dmpc::apps {

/// Some of the bundles, which their owner keeps.
struct BundleSpan {
  std::span<const core::Ray> all;          ///< the owner's rays
  std::span<const std::uint32_t> borders;  ///< of the bundles, in `all`: one more than there are bundles

  std::size_t count() const { return borders.size() - 1; }
  std::span<const core::Ray> bundle(std::size_t index) const { return between(borders[index], borders[index + 1]); }
  /// The rays of all its bundles, in order.
  std::span<const core::Ray> rays() const { return between(borders.front(), borders.back()); }
  /// `most` bundles from the one of this index on, or as many as there are. Requires first <= count().
  BundleSpan part(std::size_t first, std::size_t most) const {
    return {all, borders.subspan(first, std::min(most, count() - first) + 1)};
  }

 private:
  std::span<const core::Ray> between(std::uint32_t begin, std::uint32_t end) const { return all.subspan(begin, end - begin); }
};

struct BundledRays {
  std::vector<core::Ray> rays;
  std::vector<std::uint32_t> borders = {0};  ///< as BundleSpan's

  void add(std::span<const core::Ray> bundle) {
    rays.insert(rays.end(), bundle.begin(), bundle.end());
    borders.push_back(static_cast<std::uint32_t>(rays.size()));
  }
  BundleSpan bundles() const { return {rays, borders}; }
};

}  // namespace dmpc::apps
