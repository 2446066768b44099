// A render in which every ray is traced twice, by our grid and by the oracle; the referee judges differences.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "apps/lab/oracle/exact.h"
#include "apps/lab/oracle/referee.h"
#include "apps/oracle/oracle.h"
#include "core/database/database.h"
#include "core/picture/pixel_task.h"
#include "core/trace/operations.h"

namespace dmpc::apps {

struct TracedRay {
  core::Ray ray;
  Answer grid, oracle;
  core::Hit hit;             ///< the grid's first hit, also for shadow rays
  std::uint32_t number = 0;  ///< number of the ray within its pixel, in shooting order
};

struct SettledRay {
  TracedRay traced;
  Ruling ruling;
};

struct CertifiedRay {
  TracedRay traced;
  CertifiedHit certified;
};

/// The results, with the same bits for every number of threads.
struct Inspection {
  core::Operations operations;          ///< our grid's operations; the render follows its answers
  std::vector<SettledRay> differences;  ///< all, by pixel and shot
  /// Pixels whose sums have other bits with Embree's primitives (EmbreeTracer): only some of those with a differing ray, as the
  /// same surface may have two names.
  std::uint64_t differing_pixels = 0;
  std::vector<CertifiedRay> certified;   ///< random hits and their certificates, by pixel and shot
  std::vector<SettledRay> brute_forced;  ///< the random rays, whose ruling says whether both answers can be explained
};

struct InspectionOptions {
  std::uint64_t brute_force = 0;  ///< rays that the referee judges whether they differ or not, drawn uniformly from all rays
  std::uint64_t certify = 0;  ///< hits whose certificates are checked against rational arithmetic, drawn uniformly from all hits
  /// Called between bands of pixels, by one thread at a time: (pixels done, pixels in all).
  std::function<void(std::uint64_t, std::uint64_t)> progress = [](std::uint64_t, std::uint64_t) {};
};

/// Renders with all cores. `scene` is made from `database.primitives()`.
Inspection inspect(const core::Database& database, const EmbreeScene& scene, const core::RenderSettings& settings,
                   const InspectionOptions& options);

}  // namespace dmpc::apps
