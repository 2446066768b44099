#include "apps/lab/check/inspection.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <memory>

#include "apps/lab/crowd/side_by_side.h"
#include "core/base/counts.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"
#include "core/base/sampling.h"
#include "core/base/units.h"
#include "core/picture/render.h"

namespace dmpc::apps {
namespace {

/// A random draw of at most `size` rays: those with the least hashes, so it does not depend on order or number of threads.
class Draw {
 public:
  explicit Draw(std::uint64_t size) : size_(size) {}

  void offer(const TracedRay& traced) {
    const std::uint64_t key = core::mix(core::mix(std::uint64_t{traced.ray.pixel} << 32U | traced.number) + 1);
    if (size_ > 0 && (drawn_.size() < size_ || key < limit_)) {
      drawn_.push_back({key, traced});
      shrink(2 * size_);
    }
  }
  void join(const Draw& other) {
    drawn_.insert(drawn_.end(), other.drawn_.begin(), other.drawn_.end());
    shrink(size_);
  }
  /// Returns them by pixel and shot.
  std::vector<TracedRay> finish() {
    shrink(size_);
    std::vector<TracedRay> rays = core::mapped<TracedRay>(drawn_, &Keyed::traced);
    std::sort(rays.begin(), rays.end(), [](const TracedRay& a, const TracedRay& b) {
      return a.ray.pixel < b.ray.pixel || (a.ray.pixel == b.ray.pixel && a.number < b.number);
    });
    return rays;
  }

 private:
  struct Keyed {
    std::uint64_t key;
    TracedRay traced;
  };

  /// Keeps the size_ least once there are more than `most`.
  void shrink(std::uint64_t most) {
    if (size_ == 0 || drawn_.size() <= most || drawn_.size() <= size_) {
      return;
    }
    const auto last = drawn_.begin() + static_cast<std::ptrdiff_t>(size_ - 1);
    std::nth_element(drawn_.begin(), last, drawn_.end(), [](const Keyed& a, const Keyed& b) { return a.key < b.key; });
    limit_ = last->key;
    drawn_.resize(size_);
  }

  std::uint64_t size_;
  std::uint64_t limit_ = ~std::uint64_t{0};
  std::vector<Keyed> drawn_;
};

/// A core::Tracer that traces with both and continues with the grid's answer.
class BothTracer {
 public:
  using Grid = core::GridTracer<core::LocalRecords>;

  BothTracer(Grid& grid, const EmbreeScene& scene, const core::BackgroundTiles& background, std::vector<TracedRay>& differences,
             Draw& draw, Draw& hits)
      : grid_(grid), scene_(scene), background_(background), differences_(differences), draw_(draw), hits_(hits) {}

  template <class Cursor>
  core::Traced trace(const core::Ray& ray, Cursor& cursor, core::Operations& operations) {
    const core::Traced result = grid_.trace(ray, cursor, operations);
    const bool shadow = ray.kind == core::RayKind::shadow;
    const core::Hit& best = cursor.best;
    const bool hit = result == core::Traced::hit;
    core::expect(!hit || ray.kind != core::RayKind::primary || !background_.has(ray.pixel),
                 "no primary ray hits anything where the background shows");
    const TracedRay traced{ray, {hit, shadow ? core::no_primitive : best.primitive, best.t}, ask_oracle(ray), best, number_++};
    if (!(traced.grid == traced.oracle)) {
      differences_.push_back(traced);
    }
    draw_.offer(traced);
    if (hit) {
      hits_.offer(traced);
    }
    return result;
  }
  const std::byte* find(core::Address address) { return grid_.find(address); }
  void start_pixel() { number_ = 0; }

 private:
  Answer ask_oracle(const core::Ray& ray) const {
    if (ray.kind == core::RayKind::shadow) {
      return {scene_.occluded(ray), core::no_primitive, 0};
    }
    const core::Hit hit = scene_.closest(ray);
    return {hit.found(), hit.primitive, hit.t};
  }

  Grid& grid_;
  const EmbreeScene& scene_;
  const core::BackgroundTiles& background_;
  std::vector<TracedRay>& differences_;
  Draw &draw_, &hits_;
  std::uint32_t number_ = 0;
};

/// The result for some pixels; results are joined from left to right, so that differences stay in the order of the pixels.
struct Harvest {
  explicit Harvest(const InspectionOptions& options) : draw(options.brute_force), hits(options.certify) {}

  core::Operations operations;
  std::vector<TracedRay> differences;
  Draw draw, hits;

  void join(const Harvest& right) {
    core::add_counts(operations, right.operations);
    differences.insert(differences.end(), right.differences.begin(), right.differences.end());
    draw.join(right.draw);
    hits.join(right.hits);
  }
};

void trace_pixels(const core::Database& database, const EmbreeScene& scene, const core::RenderSettings& settings,
                  std::uint32_t first, std::uint32_t last, Harvest& harvest) {
  core::LocalRecords records(database.bytes());
  BothTracer::Grid grid(records, settings.header, settings.skips);
  BothTracer tracer(grid, scene, settings.background, harvest.differences, harvest.draw, harvest.hits);
  std::vector<core::HitState> stack(static_cast<std::size_t>(settings.shade.depth_max));
  const core::RenderSettings every_ray = settings.with_every_ray_traced();
  core::with_pixel_task(settings.header, stack, [&](auto& task) {
    for (std::uint32_t pixel = first; pixel < last; ++pixel) {
      tracer.start_pixel();
      core::render_pixel(task, pixel, settings.first_samples(), tracer, every_ray, harvest.operations);
    }
  });
}

/// Returns the pixels of the rays, once each. `rays` are sorted by pixel.
std::vector<std::uint32_t> pixels_of(const std::vector<TracedRay>& rays) {
  std::vector<std::uint32_t> pixels;
  for (const TracedRay& traced : rays) {
    if (pixels.empty() || pixels.back() != traced.ray.pixel) {
      pixels.push_back(traced.ray.pixel);
    }
  }
  return pixels;
}

/// Returns how many of `pixels` get other sums from Embree than from the grid.
std::uint64_t count_differing(const core::Database& database, const EmbreeScene& scene, const core::RenderSettings& settings,
                              const std::vector<std::uint32_t>& pixels) {
  const std::vector<core::Database::Place> places = database.find_places();
  const auto count = [&](const tbb::blocked_range<std::size_t>& range, std::uint64_t differing) {
    core::LocalRecords records(database.bytes());
    BothTracer::Grid grid(records, settings.header, settings.skips);
    EmbreeTracer embree(scene, places, settings.header.frame, records);
    std::vector<core::HitState> stack(static_cast<std::size_t>(settings.shade.depth_max));
    core::Operations unused;
    const core::RenderSettings every_ray = settings.with_every_ray_traced();
    core::with_pixel_task(settings.header, stack, [&](auto& task) {
      const auto sums = [&](auto& tracer, std::uint32_t pixel) {
        return core::render_pixel(task, pixel, settings.first_samples(), tracer, every_ray, unused);
      };
      for (std::size_t index = range.begin(); index < range.end(); ++index) {
        differing += sums(grid, pixels[index]) == sums(embree, pixels[index]) ? 0 : 1;
      }
    });
    return differing;
  };
  return tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, pixels.size()), std::uint64_t{0}, count, std::plus<>());
}

std::vector<SettledRay> settle(const Referee& referee, const std::vector<TracedRay>& rays) {
  std::vector<SettledRay> settled(rays.size());
  tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t index) {
    const TracedRay& traced = rays[index];
    settled[index] = {traced, referee.settle(traced.ray, traced.grid, traced.oracle)};
  });
  return settled;
}

std::vector<CertifiedRay> certify(const core::Database& database, const std::vector<TracedRay>& rays) {
  std::vector<CertifiedRay> all(rays.size());
  tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t index) {
    const TracedRay& traced = rays[index];
    all[index] = {traced, certified(traced.ray, database.primitives()[traced.hit.primitive], traced.hit.t)};
  });
  return all;
}

}  // namespace

Inspection inspect(const core::Database& database, const EmbreeScene& scene, const core::RenderSettings& settings,
                   const InspectionOptions& options) {
  const std::uint32_t pixel_count = settings.camera.pixel_count();
  const std::uint32_t band = std::max(pixel_count / 200, 1024U);
  Harvest harvest(options);
  options.progress(0, pixel_count);
  side_by_side(core::ceil_divide(pixel_count, band), [&](std::size_t index) -> std::function<void()> {
    const std::uint32_t first = static_cast<std::uint32_t>(index) * band, last = std::min(first + band, pixel_count);
    const auto part = std::make_shared<Harvest>(options);
    trace_pixels(database, scene, settings, first, last, *part);
    return [&, part, last] {
      harvest.join(*part);
      options.progress(last, pixel_count);
    };
  });
  const Referee referee(database);
  return {.operations = harvest.operations,
          .differences = settle(referee, harvest.differences),
          .differing_pixels = count_differing(database, scene, settings, pixels_of(harvest.differences)),
          .certified = certify(database, harvest.hits.finish()),
          .brute_forced = settle(referee, harvest.draw.finish())};
}

}  // namespace dmpc::apps
