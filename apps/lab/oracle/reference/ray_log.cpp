#include "apps/lab/oracle/reference/ray_log.h"

#include <algorithm>

#include "core/base/ranges.h"
#include "core/base/sampling.h"
#include "core/picture/film/film.h"
#include "core/picture/render.h"
#include "core/record/coordinate.h"
#include "core/scene/frame.h"

namespace dmpc::apps {
namespace {

using core::RayKind;
using core::Vec3d;

std::uint64_t joined(std::uint64_t path, std::uint64_t step) { return core::mix(path * 0x9e3779b97f4a7c15ULL + step + 1); }

/// Names rays in depth-first order.
class PathNamer {
 public:
  PathNamer() : levels_(1) {}

  /// Sets path and maker of a ray of this depth.
  void name(LoggedRay& ray, std::size_t depth) const {
    const Level& from = levels_[ray.kind == RayKind::shadow ? depth : depth - 1];
    ray.maker = from.path;
    ray.path = joined(joined(from.hit, static_cast<std::uint64_t>(ray.kind)), ray.light);
  }
  void note_hit(const LoggedRay& ray, std::size_t depth) {
    levels_.resize(std::max(levels_.size(), depth + 1));
    levels_[depth] = {ray.path, joined(ray.path, ray.body)};
  }

 private:
  struct Level {
    std::uint64_t path = 0, hit = 0;
  };
  std::vector<Level> levels_;  ///< by depth: the last ray that hit, and the prefix of its children's names
};

/// A core::Tracer that records the grid's answers.
class NotingTracer {
 public:
  using Grid = core::GridTracer<core::LocalRecords>;

  NotingTracer(Grid& grid, ProductLog& log, std::span<const Vec3d> lights, std::span<const std::uint32_t> bodies,
               const core::GridFrame& frame)
      : grid_(grid), log_(log), lights_(lights), bodies_(bodies), frame_(frame) {}

  core::Traced trace(const core::Ray& ray, core::Cursor& cursor, core::Operations& operations) {
    const core::Traced result = grid_.trace(ray, cursor, operations);
    LoggedRay noted{.kind = ray.kind, .hit = result == core::Traced::hit};
    const std::size_t depth = ray.depth;
    noted.light = ray.kind == RayKind::shadow ? next_light(ray) : 0;
    noted.t_max = static_cast<double>(ray.t_max) / frame_.scale;
    namer_.name(noted, depth);
    if (noted.hit) {
      note_hit(noted, cursor.best, depth);
    }
    log_.rays.push_back(noted);
    log_.shots.push_back(in_world(ray, noted));
    return result;
  }
  const std::byte* find(core::Address address) { return grid_.find(address); }

 private:
  void note_hit(LoggedRay& noted, const core::Hit& best, std::size_t depth) {
    noted.t = static_cast<double>(best.t) / frame_.scale;
    noted.body = best.found() ? bodies_[best.primitive] : core::no_primitive;
    if (noted.kind != RayKind::shadow) {
      namer_.note_hit(noted, depth);
      light_ = 0;
    }
  }
  ReferenceRay in_world(const core::Ray& ray, const LoggedRay& noted) const {
    const Vec3d origin = ray.full_origin() * (1 / frame_.scale) + frame_.origin, direction = normalize(ray.full_direction());
    return {.origin = origin,
            .direction = direction,
            .t_max = noted.t_max,
            .ignored_body = ray.ignored_primitive == core::no_primitive ? core::no_primitive : bodies_[ray.ignored_primitive],
            .weight = Vec3d(ray.weight),
            .depth = ray.depth,
            .kind = ray.kind,
            .light = noted.light,
            .cone = core::cone_width(ray) / frame_.scale};
  }
  /// Returns the light of a shadow ray: of those after the last one of this hit, the one nearest to the ray's end.
  std::uint32_t next_light(const core::Ray& ray) {
    const Vec3d end = ray.full_origin() + ray.full_direction() * static_cast<double>(ray.t_max);
    std::uint32_t nearest = light_;
    for (std::uint32_t light = light_; light < lights_.size(); ++light) {
      nearest = length(lights_[light] - end) < length(lights_[nearest] - end) ? light : nearest;
    }
    light_ = nearest + 1;
    return nearest;
  }

  Grid& grid_;
  ProductLog& log_;
  std::span<const Vec3d> lights_;
  std::span<const std::uint32_t> bodies_;
  const core::GridFrame& frame_;
  PathNamer namer_;
  std::uint32_t light_ = 0;  ///< the first that the next shadow ray can go to
};

class NotingWatcher final : public RayWatcher {
 public:
  explicit NotingWatcher(RayLog& log) : log_(log) {}

  void end(const ReferenceRay& ray, const ReferenceHit& hit) override {
    LoggedRay noted{.kind = ray.kind, .light = ray.light, .hit = hit.found(), .body = hit.body, .t_max = ray.t_max};
    noted.t = noted.hit ? hit.t : 0;
    namer_.name(noted, static_cast<std::size_t>(ray.depth));
    if (noted.hit && ray.kind != RayKind::shadow) {
      namer_.note_hit(noted, static_cast<std::size_t>(ray.depth));
    }
    log_.rays.push_back(noted);
  }

 private:
  RayLog& log_;
  PathNamer namer_;
};

/// Returns whether rounding the body's corners gives the primitive's floats; spheres and cones are one for each object.
bool same_values(const ReferenceBody& body, const core::PrimitiveValues& values, const core::GridFrame& frame) {
  if (body.kind != core::PrimitiveKind::triangle || values.kind != body.kind) {
    return values.kind == body.kind;
  }
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const core::Vec3f rounded = core::coordinates_of(to_local(frame, body.place[corner]));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (rounded[axis] != values.value[3 * corner + axis]) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

const LoggedRay* RayLog::find(std::uint64_t path) const { return core::find_in(rays, path, &LoggedRay::path); }

Vec3d ProductLog::light(const Vec3d& background) const {
  Vec3d sum;
  for (std::size_t index = 0; index < rays.size(); ++index) {
    if (!rays[index].hit) {
      sum = sum + (rays[index].kind == RayKind::shadow ? shots[index].weight : shots[index].weight * background);
    }
  }
  return sum;
}

std::vector<std::uint32_t> bodies_of_primitives(const ReferenceScene& scene, const core::Database& database) {
  std::vector<std::uint32_t> bodies(database.primitives().size(), core::no_primitive);
  std::vector<std::uint32_t> next;  // by object: its first body without a primitive so far
  for (std::uint32_t body = 0; body < scene.bodies.size(); ++body) {
    const std::uint32_t object = scene.bodies[body].object;
    next.resize(std::max<std::size_t>(next.size(), object + std::size_t{1}), body);
  }
  for (std::size_t primitive = 0; primitive < bodies.size(); ++primitive) {
    const std::uint32_t object = database.sources()[primitive].object;
    std::uint32_t candidate = object < next.size() ? next[object] : core::no_primitive;
    while (candidate < scene.bodies.size() && scene.bodies[candidate].object == object &&
           !same_values(scene.bodies[candidate], database.primitives()[primitive], database.header().frame)) {
      ++candidate;
    }
    if (candidate < scene.bodies.size() && scene.bodies[candidate].object == object) {
      bodies[primitive] = candidate;
      next[object] = candidate + 1;
    }
  }
  return bodies;
}

ProductLogger::ProductLogger(const core::Database& database, const core::RenderSettings& settings, const ReferenceScene& scene)
    : database_(database), settings_(settings.with_every_ray_traced()), bodies_(bodies_of_primitives(scene, database)) {
  for (const ReferenceLight& light : scene.lights) {
    lights_.push_back(to_local(database.header().frame, light.position));
  }
}

ProductLog ProductLogger::log_of(std::uint32_t pixel) const {
  ProductLog log;
  core::LocalRecords records(database_.bytes());
  NotingTracer::Grid grid(records, settings_.header, settings_.skips);
  NotingTracer tracer(grid, log, lights_, bodies_, settings_.header.frame);
  std::vector<core::HitState> stack(static_cast<std::size_t>(settings_.shade.depth_max));
  core::PixelTask task(stack);
  core::Operations operations;
  core::Film film(1, 1, settings_.shade.film_scale);
  film.deposit(0, core::render_pixel(task, pixel, {0, 1}, tracer, settings_, operations));
  film.add_samples(0, 1);
  log.radiance = film.radiance(0);
  return log;
}

RayLog reference_log_of_rays(const ReferenceScene& scene, const ReferenceFinder& finder, const core::ShadeOptions& options,
                             const ReferenceRay& primary) {
  RayLog log;
  NotingWatcher watcher(log);
  ReferenceTracer tracer(scene, finder, options, &watcher);
  log.radiance = tracer.radiance(primary);
  return log;
}

}  // namespace dmpc::apps
