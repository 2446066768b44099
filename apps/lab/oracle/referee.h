// The double-precision referee: brute force over all primitives, to settle what grid and oracle disagree on.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "apps/lab/oracle/exact_intersection.h"
#include "core/database/database.h"
#include "core/record/ray.h"

namespace dmpc::apps {

/// What a renderer said of a ray: a closest hit by name, or only whether a shadow ray is blocked.
struct Answer {
  bool hit = false;
  std::uint32_t primitive = core::no_primitive;  ///< a closest hit's; unused for shadow rays
  float t = 0;                                   ///< as the renderer gave it, for reports

  bool operator==(const Answer& other) const { return hit == other.hit && primitive == other.primitive; }
};

/// How a difference comes about. The first four are explained; the others are errors of our grid.
enum class Verdict : std::uint8_t {
  tie,           ///< both name a primitive that is surely hit, and rounding may order the two distances either way
  silhouette,    ///< the ray passes an edge or a tangent within what rounding may move it by
  end,           ///< a hit lies within rounding of the ray's start or end
  oracle_wrong,  ///< our grid's answer can be explained by rounding, Embree's cannot (it leaks where triangles meet)
  grid_wrong,    ///< Embree's answer can be explained by rounding, our grid's cannot
  both_wrong     ///< neither can
};
inline constexpr std::size_t verdict_count = 6;
constexpr bool explained(Verdict verdict) { return verdict < Verdict::grid_wrong; }
/// One word or two for tables.
std::string_view name_of(Verdict verdict);

struct Ruling {
  Verdict verdict{};
  Answer exact;               ///< by exact geometry: edges belong to their triangle, equal distances go to the lower id
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

  /// Every primitive that rounding may let `ray` hit (its ignored triangle left out), by distance and then id.
  std::vector<ExactIntersection> exact_intersections(const core::Ray& ray) const;
  /// The exact answer; for a shadow ray only `hit` is meant. NaN or infinite rays miss.
  Answer exact(const core::Ray& ray) const;
  /// Whether `answer` is what `renderer` may have found after rounding, no matter what the other one said.
  bool admissible(const core::Ray& ray, const Answer& answer, Renderer renderer) const;
  /// Judges two answers; meant for different ones, but equal ones are judged as well.
  Ruling settle(const core::Ray& ray, const Answer& grid, const Answer& oracle) const;
  /// How near `ray` is to hitting primitive `id`, whether it does or not.
  ExactIntersection examine(const core::Ray& ray, std::uint32_t id) const {
    return apps::examine(ray, primitives_[id], id, plane_of(id));
  }

 private:
  bool leaks(const core::Ray& ray, const std::vector<ExactIntersection>& met, const ExactIntersection& passed,
             const Answer& answer, const ExactIntersection* hit, Renderer renderer) const;
  bool admissible(const core::Ray& ray, const std::vector<ExactIntersection>& met, const Answer& answer, Renderer renderer) const;

  /// None of a triangle that doubles do not tell from others.
  const core::FacePlane* plane_of(std::uint32_t id) const;

  std::span<const core::PrimitiveValues> primitives_;
  std::span<const core::PrimitivePlane> planes_;
};

}  // namespace dmpc::apps
