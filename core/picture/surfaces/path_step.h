// How a path continues from a hit: by one of the surface's components.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "core/base/vec.h"
#include "core/picture/hits/hit_state.h"
#include "core/picture/sampling/sample_pair.h"
#include "core/picture/surfaces/transport.h"

namespace dmpc::core {

struct PathStep {
  Vec3d towards;                      ///< unit length
  Color weight;                       ///< factor of the path's weight
  RayKind kind = RayKind::scattered;  ///< the ray's
  /// The density with which the direction was chosen, per steradian: that of response_towards(). Infinite for mirrors and glass,
  /// which leave no choice.
  double density = std::numeric_limits<double>::infinity();
};

/// The kind of a ray that a mirror or glass sends on: scattered rays stay scattered.
inline RayKind kind_after(const Ray& ray, RayKind kind) { return ray.kind == RayKind::scattered ? RayKind::scattered : kind; }

/// Uses of a hit's random numbers, each with its own pair: the component by which its path continues, and roulette; the
/// direction; further digits for light sampling; the emitter and the point on it.
enum class Purpose : std::uint32_t { choice, direction, emitter, place };
/// The pair of a hit at `depth`, 1 or more; pair 0 of a sample is its position in the pixel.
SamplePair pair_of(std::uint32_t pixel, std::uint32_t sample, int depth, Purpose purpose);
inline SamplePair pair_of(const Ray& ray, Purpose purpose) { return pair_of(ray.pixel, ray.sample, ray.depth, purpose); }
/// From this hit on, the eye's being the first, paths may end by roulette.
inline constexpr int roulette_from = 3;

/// A cosine-distributed unit direction around the unit vector `normal`, for a uniform pair: the point on the unit disc below it,
/// by P. Shirley, K. Chiu, "A Low Distortion Map Between Disk and Square", Journal of Graphics Tools 2 (3), 1997; axes by T. Duff
/// and others, "Building an Orthonormal Basis, Revisited", Journal of Computer Graphics Techniques 6 (1), 2017.
Vec3d cosine_direction(const SamplePair& pair, const Vec3d& normal);

/// The direction in which a hit scatters its ray. Nothing if that leads into the surface, which happens with interpolated
/// normals: such light is lost, none leaks.
std::optional<Vec3d> scattered_direction(const HitState& state);

/// Chooses the surface's diffuse part, its mirror or its transmission, in proportion to the brightest channel of each, weighted
/// for all. Nothing if all are black, or by roulette: from hit `roulette_from` on the path continues with the probability of the
/// brightest channel of its weight, if that is below 1, and is weighted accordingly (J. Arvo, D. Kirk, "Particle Transport and
/// Image Synthesis", SIGGRAPH 1990). The choice is a function of the ray's pixel, sample and depth. Requires a hit whose surface
/// is known.
std::optional<PathStep> path_step(const HitState& state);

}  // namespace dmpc::core
