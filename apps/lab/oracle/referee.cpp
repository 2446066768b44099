#include "apps/lab/oracle/referee.h"

#include <algorithm>
#include <array>

#include "apps/lab/oracle/fan.h"

namespace dmpc::apps {
namespace {

using core::Ray;

constexpr std::array<std::string_view, verdict_count> verdict_names{"tie",          "silhouette", "ray end",
                                                                    "oracle wrong", "grid wrong", "both wrong"};

bool is_shadow(const Ray& ray) { return ray.kind == core::RayKind::shadow; }

/// Returns whether f certainly lies before e.
bool before(const ExactIntersection& f, const ExactIntersection& e) { return f.t + f.t_error < e.t - e.t_error; }

Answer exact_of(const Ray& ray, const std::vector<ExactIntersection>& met) {
  const ExactIntersection* nearest = nullptr;
  for (const ExactIntersection& exact_intersection : met) {
    // Distances that differ only by the rounding of doubles are equal; they come in ascending order.
    const bool level = nearest != nullptr && exact_intersection.t - nearest->t <= 0x1p-48 * nearest->t;
    if (exact_intersection.exact && (nearest == nullptr || (level && exact_intersection.primitive < nearest->primitive))) {
      nearest = &exact_intersection;
    }
  }
  if (nearest == nullptr) {
    return {};
  }
  return {true, is_shadow(ray) ? core::no_primitive : nearest->primitive, static_cast<float>(nearest->t)};
}

bool same(const Ray& ray, const Answer& a, const Answer& b) {
  return a.hit == b.hit && (is_shadow(ray) || a.primitive == b.primitive);
}

/// Returns why two answers that rounding explains may differ.
Verdict reason(const Ray& ray, const std::vector<ExactIntersection>& met, const std::array<Answer, 3>& answers) {
  bool at_end = false;
  for (const ExactIntersection& exact_intersection : met) {
    const bool involved = is_shadow(ray) || std::any_of(answers.begin(), answers.end(), [&](const Answer& answer) {
                            return answer.hit && answer.primitive == exact_intersection.primitive;
                          });
    if (involved && (exact_intersection.margin[0] < 1 || exact_intersection.margin[1] < 1)) {
      return Verdict::silhouette;
    }
    at_end = at_end || (involved && exact_intersection.at_end);
  }
  return at_end ? Verdict::end : Verdict::tie;
}

}  // namespace

std::string_view name_of(Verdict verdict) { return verdict_names[static_cast<std::size_t>(verdict)]; }

std::vector<ExactIntersection> Referee::exact_intersections(const Ray& ray) const {
  std::vector<ExactIntersection> met;
  if (!is_finite(ray.origin) || !is_finite(ray.direction) || ray.direction == core::Vec3f{}) {
    return met;
  }
  for (std::uint32_t id = 0; id < primitives_.size(); ++id) {
    if (id != ray.ignored_primitive || primitives_[id].kind != core::PrimitiveKind::triangle) {
      add_exact_intersections(ray, primitives_[id], id, met, plane_of(id));
    }
  }
  std::sort(met.begin(), met.end(), [](const ExactIntersection& a, const ExactIntersection& b) {
    return a.t < b.t || (a.t == b.t && a.primitive < b.primitive);
  });
  return met;
}

const core::FacePlane* Referee::plane_of(std::uint32_t id) const {
  if (!primitives_[id].needs_plane() || primitives_[id].plane() > planes_.size()) {
    return nullptr;
  }
  const core::PrimitivePlane& plane = planes_[primitives_[id].plane() - 1];
  return plane.stored_as >= core::LeafHeader::exact_plane ? &plane : nullptr;
}

Answer Referee::exact(const Ray& ray) const { return exact_of(ray, exact_intersections(ray)); }

bool Referee::admissible(const Ray& ray, const Answer& answer, Renderer renderer) const {
  return admissible(ray, exact_intersections(ray), answer, renderer);
}

/// Returns whether `answer`, which lies behind the doubtful `passed`, slipped through a closed fan. `hit` is the answer's exact
/// intersection, if any. At a silhouette a fan's triangles lie one behind the other: a hit between them has not passed all of
/// them.
bool Referee::leaks(const Ray& ray, const std::vector<ExactIntersection>& met, const ExactIntersection& passed,
                    const Answer& answer, const ExactIntersection* hit, Renderer renderer) const {
  if (!passed.possible(renderer) || passed.at_end || primitives_[passed.primitive].kind != core::PrimitiveKind::triangle) {
    return false;
  }
  const std::vector<std::uint32_t> fan = closed_fan(ray, primitives_, passed.primitive);
  const auto holds = [&](std::uint32_t id) { return std::find(fan.begin(), fan.end(), id) != fan.end(); };
  // A triangle of the fan that meets the ray's end may legitimately be rounded away.
  const bool ends_here = std::any_of(met.begin(), met.end(), [&](const ExactIntersection& exact_intersection) {
    return exact_intersection.at_end && holds(exact_intersection.primitive);
  });
  const bool goes_on_behind =
      hit != nullptr && std::any_of(met.begin(), met.end(), [&](const ExactIntersection& exact_intersection) {
        return !before(exact_intersection, *hit) && exact_intersection.possible(renderer) && holds(exact_intersection.primitive);
      });
  return !fan.empty() && !ends_here && !goes_on_behind && !(answer.hit && holds(answer.primitive));
}

bool Referee::admissible(const Ray& ray, const std::vector<ExactIntersection>& met, const Answer& answer,
                         Renderer renderer) const {
  // A hit is judged by the farthest of its exact intersections: the second root of a body that rounding let the ray enter unseen.
  const auto may_pass = [&](const ExactIntersection& f, const ExactIntersection* hit) {
    return !f.certain(renderer) && !leaks(ray, met, f, answer, hit, renderer);
  };
  if (!answer.hit) {
    return std::all_of(met.begin(), met.end(), [&](const ExactIntersection& f) { return may_pass(f, nullptr); });
  }
  return std::any_of(met.begin(), met.end(), [&](const ExactIntersection& e) {
    const bool named = is_shadow(ray) || e.primitive == answer.primitive;
    return named && e.possible(renderer) &&
           (is_shadow(ray) ||
            std::all_of(met.begin(), met.end(), [&](const ExactIntersection& f) { return !before(f, e) || may_pass(f, &e); }));
  });
}

Ruling Referee::settle(const Ray& ray, const Answer& grid, const Answer& oracle) const {
  const std::vector<ExactIntersection> met = exact_intersections(ray);
  Ruling ruling;
  ruling.exact = exact_of(ray, met);
  ruling.favours_grid = same(ray, grid, ruling.exact);
  ruling.favours_oracle = same(ray, oracle, ruling.exact);
  const bool grid_explained = admissible(ray, met, grid, Renderer::grid);
  const bool oracle_explained = admissible(ray, met, oracle, Renderer::embree);
  if (grid_explained && oracle_explained) {
    ruling.verdict = reason(ray, met, {grid, oracle, ruling.exact});
  } else {
    ruling.verdict = grid_explained ? Verdict::oracle_wrong : oracle_explained ? Verdict::grid_wrong : Verdict::both_wrong;
  }
  return ruling;
}

}  // namespace dmpc::apps
