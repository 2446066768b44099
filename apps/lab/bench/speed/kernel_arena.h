// A scene's rays and the contenders that trace them, for the kernel part of `bench speed`.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "apps/lab/bench/speed/embree_tree.h"
#include "apps/lab/bench/speed/part.h"
#include "apps/lab/bench/speed/recording.h"
#include "apps/lab/bench/speed/warm_pager.h"
#include "apps/scene/subject.h"

namespace dmpc::apps {

/// The tracer: our grid over records in an array, or through a pager, with single rays or bundles; Embree with single rays.
enum class Contender : std::uint8_t { grid, paged_grid, bundles, paged_bundles, robust, fast };
inline constexpr std::size_t contender_count = 6;
const char* name_of(Contender contender);

struct RaysTraced {
  std::uint64_t hits = 0;
  double seconds = 0;  ///< processor time of the busiest thread
};

class KernelArena {
 public:
  /// Renders the scene, and builds what the contenders need. Throws core::InputError for an unsuitable scene.
  KernelArena(const std::string& scene, const SpeedSettings& settings);

  const std::string& name() const { return name_; }
  bool has(RayClass ray_class) const { return ray_count(ray_class) > 0; }
  std::size_t ray_count(RayClass ray_class) const { return recording_.of(ray_class).rays.size(); }

  /// Traces all rays of the class, on at most as many threads as the settings have.
  RaysTraced trace(Contender contender, RayClass ray_class, Query query, std::uint32_t threads);

 private:
  void ask(RayClass ray_class, Query query);
  std::uint64_t trace_piece(Contender contender, const BundleSpan& piece, Query query, std::size_t thread);

  std::string name_;
  Subject subject_;
  Recording recording_;
  EmbreeTree robust_, fast_;
  std::vector<std::unique_ptr<WarmPager>> pagers_;  ///< one node each, by thread
};

}  // namespace dmpc::apps
