// The hits of a bundle's rays, shaded side by side: their children of one kind form the next bundle.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>

#include "core/picture/hits/hit_lanes.h"
#include "core/picture/pixel_task.h"
#include "core/trace/bundle.h"

namespace dmpc::core {

/// Finds hits of a bundle's rays, and the records that shading reads. trace() has the contract of core/trace/bundle_traversal.h.
template <class T>
concept BundleTracer = requires(T& tracer, RayBundle& bundle, Operations& operations, Address address) {
  { tracer.trace(bundle, operations) } -> std::same_as<bool>;
  { tracer.find(address) } -> std::same_as<const std::byte*>;
};

/// The hits of a bundle's rays, all of one depth, shaded side by side: all read what they need, then each light sends its bundle
/// of shadow rays, then the mirrored rays form a bundle, then the refracted ones; with paths the shadow rays to sampled emitters
/// form one, those to the sky another, and then the rays that continue.
struct BundleHit {
  enum class Phase : std::uint8_t { surface, light, emitter, sky, reflected, refracted, continued, finished };

  std::array<HitState, bundle_rays_max> hit;
  std::array<std::uint8_t, bundle_rays_max> place;  ///< the pixel's slot of each hit
  std::uint32_t count = 0;
  std::uint32_t next = 0;   ///< the next hit to continue, while surfaces or emitters are read
  std::uint32_t light = 0;  ///< the light whose shadow rays are next
  Phase phase = Phase::surface;

  bool has_unread_surface() const {
    return std::any_of(hit.begin(), hit.begin() + count, [](const HitState& state) { return !state.has_surface(); });
  }
  /// Whether no hit sends more rays.
  bool is_finished() const { return phase == Phase::finished; }
  /// Removes all hits.
  void clear() {
    count = next = light = 0;
    phase = Phase::surface;
  }
  /// Requires a free slot, and that no phase has ended.
  void add(const Ray& ray, const Hit& met, std::size_t its_place) {
    place[count] = static_cast<std::uint8_t>(its_place);
    begin_shading(hit[count++], ray, met);
  }
  /// For a ray that hits nothing, with a sky's picture.
  void add_sky(const Ray& ray, std::size_t its_place) {
    place[count] = static_cast<std::uint8_t>(its_place);
    hit[count++] = begin_sky(ray);
  }
  bool has_any_at(HitState::Stage stage) const {
    return std::any_of(hit.begin(), hit.begin() + count, [stage](const HitState& state) { return state.stage == stage; });
  }
  /// Whether some hit is about to sample an emitter, or has done so.
  bool aims() const { return has_any_at(HitState::Stage::emitter_choice) || has_any_at(HitState::Stage::emitter); }
  /// Whether some hit is about to sample a tile of the sky, or has done so.
  bool aims_at_sky() const { return has_any_at(HitState::Stage::sky_choice) || has_any_at(HitState::Stage::sky_aim); }
  /// Goes to the next phase: while hits wait for one of their lights, for an emitter, or for the sky, and then to the first that
  /// sends rays on.
  void end_phase(Phase first_sending) {
    if (phase == Phase::surface || phase == Phase::light) {
      light += phase == Phase::light ? 1 : 0;
      phase = has_any_at(HitState::Stage::light) ? Phase::light
              : aims()                           ? Phase::emitter
              : aims_at_sky()                    ? Phase::sky
                                                 : first_sending;
    } else if (phase == Phase::emitter || phase == Phase::sky) {
      phase = phase == Phase::emitter && aims_at_sky() ? Phase::sky : first_sending;
    } else {
      phase = phase == Phase::reflected ? Phase::refracted : Phase::finished;
    }
  }
};

/// Shades the hits of a bundle, phase by phase. The constructor's arguments outlive it; costs nothing to make.
template <BundleTracer T>
class BundleShader {
 public:
  BundleShader(BundleHit& hits, T& tracer, const RenderSettings& settings, Operations& operations)
      : hits_(hits),
        tracer_(tracer),
        settings_(settings),
        operations_(operations),
        shader_(settings.header, settings.shade, settings.skips, operations, &settings.camera) {}

  /// Ends the phase that the hits are in: calls shoot(i, make) for each hit i that may have a child, which make(ray) builds in
  /// any given ray or reports absent (false); and, where hits glow, shine(light, i) once for each when all surfaces are known.
  /// False if a record is absent, whose address is then `absent`: call it again once that is present. Requires a phase other than
  /// finished.
  template <class Shoot, class Shine>
  bool step(Address& absent, const Shoot& shoot, const Shine& shine) {
    if ((hits_.phase == Phase::surface && !read_surfaces(absent)) ||
        (hits_.phase == Phase::light && !shoot_at_light(absent, shoot)) ||
        (hits_.phase == Phase::emitter && !(read_choices(HitState::Stage::emitter_choice, absent, shoot) &&
                                            read_stage(HitState::Stage::emitter, absent, shoot))) ||
        (hits_.phase == Phase::sky &&
         !(read_choices(HitState::Stage::sky_choice, absent, shoot) && read_stage(HitState::Stage::sky_aim, absent, shoot)))) {
      return false;
    }
    if (hits_.phase == Phase::surface && shader_.hits_glow()) {
      for (std::uint32_t i = 0; i < hits_.count; ++i) {
        shine(shader_.glow(hits_.hit[i]), i);
      }
    }
    if (hits_.phase == Phase::reflected) {
      shoot_children(HitState::Stage::reflected, shoot);
    } else if (hits_.phase == Phase::refracted) {
      shoot_children(HitState::Stage::refracted, shoot);
    } else if (hits_.phase == Phase::continued) {
      send_on(shoot);
    }
    hits_.end_phase(settings_.shade.transport.is_by_paths() ? Phase::continued : Phase::reflected);
    return true;
  }

 private:
  using Phase = BundleHit::Phase;

  bool read_surfaces(Address& absent);
  template <class Shoot>
  bool shoot_at_light(Address& absent, const Shoot& shoot);
  template <class Shoot>
  bool read_stage(HitState::Stage stage, Address& absent, const Shoot& shoot);
  /// Goes down a tree of choices with all hits at once, node by node.
  template <class Shoot>
  bool read_choices(HitState::Stage stage, Address& absent, const Shoot& shoot) {
    while (hits_.has_any_at(stage)) {
      if (!read_stage(stage, absent, shoot)) {
        return false;
      }
    }
    return true;
  }
  template <class Shoot>
  void shoot_children(HitState::Stage stage, const Shoot& shoot);
  template <class Shoot>
  void send_on(const Shoot& shoot);

  BundleHit& hits_;
  T& tracer_;
  const RenderSettings& settings_;
  Operations& operations_;
  Shader shader_;
};

/// Does one step of each hit per round, so that neighbours, which often need the same record, find it together.
template <BundleTracer T>
bool BundleShader<T>::read_surfaces(Address& absent) {
  Address found = no_address;
  const std::byte* record = nullptr;
  TriangleLanes triangles;
  for (; hits_.has_unread_surface(); hits_.next = 0) {
    for (; hits_.next < hits_.count; ++hits_.next) {
      HitState& state = hits_.hit[hits_.next];
      if (state.has_surface()) {
        continue;
      }
      absent = record_needed(state, settings_.header);
      operations_.skipped.bundles += absent == found ? 1 : 0;
      record = absent == found ? record : tracer_.find(absent);
      if (record == nullptr) {
        triangles.read_all();
        return false;
      }
      found = absent;
      if (Ray none; !shader_.reads_beside() || !triangles.take(state, record)) {
        shader_.step(state, record, none);
      }
    }
    triangles.read_all();
  }
  return true;
}

/// Reads the light's record once for all hits, which it lights side by side. Hits on the sky are not lit.
template <BundleTracer T>
template <class Shoot>
bool BundleShader<T>::shoot_at_light(Address& absent, const Shoot& shoot) {
  absent = advance(settings_.header.lights, hits_.light * sizeof(LightRecord));
  const std::byte* const record = tracer_.find(absent);
  if (record == nullptr) {
    return false;
  }
  const auto light = read<LightRecord>(record);
  std::array<std::uint32_t, bundle_rays_max> lit;
  std::uint32_t count = 0;
  LitLanes lanes;
  for (std::uint32_t i = 0; i < hits_.count; ++i) {
    if (hits_.hit[i].stage == HitState::Stage::light) {
      lanes.add(hits_.hit[i]);
      lit[count++] = i;
    }
  }
  operations_.skipped.bundles += count - 1;
  lanes.light(Vec3d(light.position));
  for (std::uint32_t lane = 0; lane < count; ++lane) {
    shoot(lit[lane], [&](Ray& child) {
      const bool shines = shader_.shine(hits_.hit[lit[lane]], light, lanes.fall(lane), lanes.highlight(lane), child);
      if (shines) {
        lanes.set_way(lane, child);
      }
      return shines;
    });
  }
  return true;
}

/// One step of every hit that is at `stage` and reads its own record. What was shot before a record was absent stays shot.
template <BundleTracer T>
template <class Shoot>
bool BundleShader<T>::read_stage(HitState::Stage stage, Address& absent, const Shoot& shoot) {
  for (; hits_.next < hits_.count; ++hits_.next) {
    HitState& state = hits_.hit[hits_.next];
    if (state.stage != stage) {
      continue;
    }
    absent = record_needed(state, settings_.header);
    const std::byte* const record = tracer_.find(absent);
    if (record == nullptr) {
      return false;
    }
    shoot(hits_.next, [&](Ray& child) { return shader_.step(state, record, child); });
  }
  hits_.next = 0;
  return true;
}

/// One step of every hit at `stage`; the order does not affect the picture.
template <BundleTracer T>
template <class Shoot>
void BundleShader<T>::shoot_children(HitState::Stage stage, const Shoot& shoot) {
  const bool is_bent = stage == HitState::Stage::refracted;
  std::array<std::uint32_t, bundle_rays_max> sender;
  std::uint32_t count = 0;
  ChildLanes lanes;
  for (std::uint32_t i = 0; i < hits_.count; ++i) {
    const HitState& state = hits_.hit[i];
    if (state.stage == stage) {
      lanes.add(state, is_bent ? relative_index(state) : 0.0);
      sender[count++] = i;
    }
  }
  if (count > 0) {
    is_bent ? lanes.bend() : lanes.mirror();
  }
  for (std::uint32_t lane = 0; lane < count; ++lane) {
    shoot(sender[lane], [&](Ray& child) {
      const bool sends = shader_.send(hits_.hit[sender[lane]], child);
      if (sends) {
        lanes.set_way(lane, child);
      }
      return sends;
    });
  }
}

/// The rays by which paths continue, in any direction.
template <BundleTracer T>
template <class Shoot>
void BundleShader<T>::send_on(const Shoot& shoot) {
  for (std::uint32_t i = 0; i < hits_.count; ++i) {
    if (hits_.hit[i].stage == HitState::Stage::continued) {
      shoot(i, [&](Ray& child) { return shader_.send_on(hits_.hit[i], child); });
    }
  }
}

}  // namespace dmpc::core
