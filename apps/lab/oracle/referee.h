// The double-precision referee: brute force over all primitives, to decide where grid and oracle disagree.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "apps/lab/oracle/exact_intersection.h"
#include "core/database/database.h"
#include "core/record/ray.h"

namespace dmpc::apps {

/// A renderer's answer for a ray: the closest hit, or only whether a shadow ray is blocked.
struct Answer {
  bool hit = false;
  std::uint32_t primitive = core::no_primitive;  ///< of a closest hit; unused for shadow rays
  float t = 0;                                   ///< as the renderer gave it, for reports

  bool operator==(const Answer& other) const { return hit == other.hit && primitive == other.primitive; }
};

/// Causes of a difference. The first four are explained; the others are errors of our grid.
enum class Verdict : std::uint8_t {
  tie,           ///< both name a primitive that is surely hit, and rounding may order the two distances either way
  silhouette,    ///< the ray passes an edge or a tangent within rounding
  end,           ///< a hit lies within rounding of the ray's start or end
  oracle_wrong,  ///< our grid's answer can be explained by rounding, Embree's cannot (it leaks where triangles meet)
  grid_wrong,    ///< Embree's answer can be explained by rounding, our grid's cannot
  both_wrong     ///< neither can
};
inline constexpr std::size_t verdict_count = 6;
constexpr bool explained(Verdict verdict) { return verdict < Verdict::grid_wrong; }
std::string_view name_of(Verdict verdict);

struct Ruling {
  Verdict verdict{};
  Answer exact;               ///< by exact geometry: edges belong to their triangle, and the lower id wins at equal distances
  bool favours_grid = false;  ///< its answer is the exact one
  bool favours_oracle = false;
};

/// Brute force over primitives whose index is their id; they and their planes outlive the referee. Immutable, thread-safe; a ray
/// costs some 10 ns a primitive.
class Referee {
 public:
  explicit Referee(std::span<const core::PrimitiveValues> primitives, std::span<const core::PrimitivePlane> planes = {})
      : primitives_(primitives), planes_(planes) {}
  explicit Referee(const core::Database& database) : Referee(database.primitives(), database.planes()) {}

  /// Returns every primitive that rounding may let `ray` hit (without its ignored triangle), by distance and then id.
  std::vector<ExactIntersection> exact_intersections(const core::Ray& ray) const;
  /// Returns the exact answer; for a shadow ray only `hit` has a meaning. NaN or infinite rays miss.
  Answer exact(const core::Ray& ray) const;
  /// Returns whether `renderer` may have found `answer` after rounding, whatever the other renderer answered.
  bool admissible(const core::Ray& ray, const Answer& answer, Renderer renderer) const;
  /// Judges two answers that differ, or are equal.
  Ruling settle(const core::Ray& ray, const Answer& grid, const Answer& oracle) const;
  /// Returns how near `ray` is to hitting primitive `id`, whether it does or not.
  ExactIntersection examine(const core::Ray& ray, std::uint32_t id) const {
    return apps::examine(ray, primitives_[id], id, plane_of(id));
  }

 private:
  bool leaks(const core::Ray& ray, const std::vector<ExactIntersection>& met, const ExactIntersection& passed,
             const Answer& answer, const ExactIntersection* hit, Renderer renderer) const;
  bool admissible(const core::Ray& ray, const std::vector<ExactIntersection>& met, const Answer& answer, Renderer renderer) const;

  /// Returns nullptr for a triangle that does not need doubles to be distinguished from others.
  const core::FacePlane* plane_of(std::uint32_t id) const;

  std::span<const core::PrimitiveValues> primitives_;
  std::span<const core::PrimitivePlane> planes_;
};

}  // namespace dmpc::apps
