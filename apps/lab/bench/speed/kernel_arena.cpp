#include "apps/lab/bench/speed/kernel_arena.h"

#include <algorithm>
#include <numeric>

#include "apps/frontend/system/stopwatch.h"
#include "apps/lab/bench/speed/crew.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// Threads take pieces of this many bundles in turn, so that no thread gets all of the picture's hard part.
constexpr std::size_t piece_bundles = 32;

template <core::Records R>
std::uint64_t trace_rays(std::span<const core::Ray> rays, R&& records, const core::DatabaseHeader& header) {
  core::GridTracer tracer(records, header, {});
  core::Operations operations;
  std::uint64_t hits = 0;
  for (const core::Ray& ray : rays) {
    core::Cursor cursor;
    hits += tracer.trace(ray, cursor, operations) == core::Traced::hit ? 1 : 0;
  }
  return hits;
}

template <core::Records R>
std::uint64_t trace_bundles(const BundleSpan& bundles, R&& records, const core::DatabaseHeader& header) {
  core::GridTracer tracer(records, header, {});
  core::Operations operations;
  core::RayBundle bundle;
  std::uint64_t hits = 0;
  for (std::size_t i = 0; i < bundles.count(); ++i) {
    const std::span<const core::Ray> rays = bundles.bundle(i);
    std::copy(rays.begin(), rays.end(), bundle.rays.begin());
    bundle.count = static_cast<std::uint32_t>(rays.size());
    bundle.start();
    core::expect(tracer.trace(bundle, operations), "who is timed has every record");
    hits += core::count_of(bundle.found);
  }
  return hits;
}

}  // namespace

const char* name_of(Contender contender) {
  static constexpr std::array<const char*, contender_count> names = {"grid",          "paged grid",    "bundles",
                                                                     "paged bundles", "Embree robust", "Embree fast"};
  return names[static_cast<std::size_t>(contender)];
}

KernelArena::KernelArena(const std::string& scene, const SpeedSettings& settings)
    : name_(scene),
      subject_(settings.subject_of(SpeedPart::kernel, scene)),
      recording_(record_rays(subject_.database, subject_.settings, settings.rays_max())),
      robust_(subject_.database.primitives(), EmbreeMode::robust),
      fast_(subject_.database.primitives(), EmbreeMode::fast) {
  for (std::uint32_t i = 0; i < settings.thread_counts.back(); ++i) {
    pagers_.push_back(std::make_unique<WarmPager>(subject_.database, subject_.settings));
  }
}

RaysTraced KernelArena::trace(Contender contender, RayClass ray_class, Query query, std::uint32_t threads) {
  ask(ray_class, query);
  const BundleSpan bundles = recording_.of(ray_class).bundles();
  std::vector<RaysTraced> shares(threads);
  on_threads(threads, [&](std::size_t thread) {
    ProcessorStopwatch stopwatch(CLOCK_THREAD_CPUTIME_ID);
    std::uint64_t hits = 0;
    for (std::size_t first = thread * piece_bundles; first < bundles.count(); first += threads * piece_bundles) {
      hits += trace_piece(contender, bundles.part(first, piece_bundles), query, thread);
    }
    shares[thread] = {hits, stopwatch.lap()};
  });
  return std::accumulate(shares.begin(), shares.end(), RaysTraced{}, [](const RaysTraced& a, const RaysTraced& b) {
    return RaysTraced{a.hits + b.hits, std::max(a.seconds, b.seconds)};
  });
}

/// Our grid distinguishes queries by the rays' kind.
void KernelArena::ask(RayClass ray_class, Query query) {
  for (core::Ray& ray : recording_.rays[static_cast<std::size_t>(ray_class)].rays) {
    ray.kind = query == Query::any ? core::RayKind::shadow : core::RayKind::primary;
  }
}

std::uint64_t KernelArena::trace_piece(Contender contender, const BundleSpan& piece, Query query, std::size_t thread) {
  const core::DatabaseHeader& header = subject_.settings.header;
  switch (contender) {
    case Contender::grid:
      return trace_rays(piece.rays(), core::LocalRecords(subject_.database.bytes()), header);
    case Contender::paged_grid:
      return trace_rays(piece.rays(), pagers_[thread]->pager(), header);
    case Contender::bundles:
      return trace_bundles(piece, core::LocalRecords(subject_.database.bytes()), header);
    case Contender::paged_bundles:
      return trace_bundles(piece, pagers_[thread]->pager(), header);
    case Contender::robust:
      return robust_.trace(piece.rays(), query);
    case Contender::fast:
      break;
  }
  return fast_.trace(piece.rays(), query);
}

}  // namespace dmpc::apps
