// How a path goes on from a hit: by one of the ways in which the surface sends light on.
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
  Vec3d towards;                      ///< of unit length
  Color weight;                       ///< what the path's own is multiplied by
  RayKind kind = RayKind::scattered;  ///< of the ray
  /// With which the direction was chosen, per steradian: response_towards() there. Of a mirror and of glass, which leave no
  /// choice, infinite.
  double density = std::numeric_limits<double>::infinity();
};

/// The kind of what a ray sends on by a mirror or through glass: what has been scattered stays so.
inline RayKind kind_after(const Ray& ray, RayKind kind) { return ray.kind == RayKind::scattered ? RayKind::scattered : kind; }

/// What a hit's chances are for, each with a pair of numbers of its own: the way in which its path goes on and roulette, whither,
/// further digits of the emitter to aim at, and that with the place on it.
enum class Purpose : std::uint32_t { choice, direction, emitter, place };
/// The pair of a hit at `depth`, 1 or more; pair 0 of a sample is its place in the pixel.
SamplePair pair_of(std::uint32_t pixel, std::uint32_t sample, int depth, Purpose purpose);
inline SamplePair pair_of(const Ray& ray, Purpose purpose) { return pair_of(ray.pixel, ray.sample, ray.depth, purpose); }
/// Hits before this one always go on, unless a transport says otherwise.
inline constexpr int roulette_from = Transport().roulette_from;

/// A direction of unit length about the unit vector `normal`, as likely as its cosine with that, for a pair that is as likely
/// anywhere: the place on the unit disc below it, by P. Shirley, K. Chiu, "A Low Distortion Map Between Disk and Square",
/// Journal of Graphics Tools 2 (3), 1997; axes by T. Duff and others, "Building an Orthonormal Basis, Revisited", Journal of
/// Computer Graphics Techniques 6 (1), 2017.
Vec3d cosine_direction(const SamplePair& pair, const Vec3d& normal);

/// Whither a hit scatters its ray. Nothing if that leads into the surface, as it may where a blended normal says how light falls:
/// such light is lost, none leaks.
std::optional<Vec3d> scattered_direction(const HitState& state);

/// One of the surface's diffuse part, its mirror and what it lets through is chosen, in proportion to the brightest channel of
/// each, and counts for all. Nothing if all are black, or by roulette: from the hit of this number on the path goes on as often
/// as the brightest channel of its weight says, if that is below 1, and counts for those that do not (J. Arvo, D. Kirk, "Particle
/// Transport and Image Synthesis", SIGGRAPH 1990). Whatever is chosen is a function of the ray's pixel, sample and depth.
/// Requires a hit of which all is known.
std::optional<PathStep> path_step(const HitState& state, int roulette_from = core::roulette_from);

}  // namespace dmpc::core
