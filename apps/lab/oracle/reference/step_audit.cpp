#include "apps/lab/oracle/reference/step_audit.h"

#include <cmath>
#include <sstream>

#include "apps/lab/oracle/reference/disturbance.h"
#include "core/picture/film/rounding_loss.h"

namespace dmpc::apps {
namespace {

using core::RayKind;
using core::Vec3d;
using Rays = std::vector<ReferenceRay>;

constexpr std::size_t trial_count = 16;
/// Relative rounding error of a weight that is a product of some floats, including the effect of a light's rounded position on a
/// highlight.
constexpr double weight_rounding = 8e-6;
/// The product's shadow rays end this share of their length before the light.
constexpr double end_rounding = 4e-6;
/// The product's rays store the width of their cones in two bytes.
constexpr double cone_rounding = 0x1p-7;
/// A body's own distance is used if it is so near to the product's, in sizes of both.
constexpr double same_hit = 1e-4;

/// Returns the ray of this kind and light, or null.
const ReferenceRay* find(const Rays& rays, const ReferenceRay& like) {
  const auto at = std::find_if(rays.begin(), rays.end(),
                               [&](const ReferenceRay& ray) { return ray.kind == like.kind && ray.light == like.light; });
  return at == rays.end() ? nullptr : &*at;
}

/// The distance of a ray from another in each respect.
struct Distance {
  double start = 0, direction = 0, weight = 0;

  static Distance between(const ReferenceRay& a, const ReferenceRay& b) {
    return {length(a.origin - b.origin), length(a.direction - b.direction), length(a.weight - b.weight)};
  }
  void include(const Distance& other) {
    start = std::max(start, other.start);
    direction = std::max(direction, other.direction);
    weight = std::max(weight, other.weight);
  }
  double over(const Distance& other) const {
    return std::max({start / other.start, direction / other.direction, weight / other.weight});
  }
};

std::string ray_text(const ReferenceRay& ray) {
  constexpr std::array<const char*, core::ray_kind_count> kinds{"primary", "reflected", "refracted", "shadow", "scattered"};
  return std::string("a ") + kinds[static_cast<std::size_t>(ray.kind)] + " ray of depth " + std::to_string(ray.depth);
}

}  // namespace

class StepAudit::Case {
 public:
  Case(const StepAudit& audit, const ProductLog& log, const ReferenceRay& primary) : audit_(audit), log_(log), primary_(primary) {
    result_.doubts.resize(log.rays.size());
  }

  Audit run() {
    check_primary(primary_);
    for (std::size_t index = 0; index < log_.rays.size(); ++index) {
      check_answer(index);
      if (log_.rays[index].hit && log_.rays[index].kind != RayKind::shadow) {
        check_spawned(index);
      }
    }
    return std::move(result_);
  }

 private:
  void complain(const std::string& error) { result_.error = result_.error.empty() ? error : result_.error; }

  /// The ray of a distant eye starts nearer, which must not skip anything.
  void check_primary(ReferenceRay primary) {
    check_start(0, primary);
    const double ahead = dot(log_.shots.front().origin - primary.origin, primary.direction);
    primary.cone += ahead;
    primary.origin = primary.origin + primary.direction * ahead;
    std::vector<Rays> trials;
    for (std::uint64_t seed = 0; seed < trial_count; ++seed) {
      trials.push_back({primary});
      Disturbance(audit_.unit_, seed).shoot(trials.back().front());
    }
    compare(log_.shots.front(), primary, trials);
  }

  ReferenceHit answer_of(const ReferenceRay& ray) const {
    return ray.kind == RayKind::shadow ? audit_.finder_.any(ray) : audit_.finder_.closest(ray);
  }
  static bool is_same(const LoggedRay& logged, const ReferenceHit& hit) {
    return hit.found() == logged.hit && (logged.kind == RayKind::shadow || hit.body == logged.body);
  }

  void check_answer(std::size_t index) {
    const ReferenceRay& ray = log_.shots[index];
    const LoggedRay& logged = log_.rays[index];
    const ReferenceHit hit = answer_of(ray);
    if (is_same(logged, hit)) {
      return;
    }
    const double met = logged.hit ? logged.t : hit.found() ? hit.t : 0;
    result_.doubts[index] = cause_of(ray, {logged.hit, logged.body}, ray.origin + ray.direction * met);
    if (!result_.doubts[index]) {
      complain(ray_text(ray) + " whose answer no ray has that runs beside it");
    }
  }

  /// Returns the size of a pixel in world units, at `place` or at the ray's origin if that is farther.
  double pixel_at(const Vec3d& place, const ReferenceRay& ray) const {
    const Vec3d eye = primary_.origin - primary_.direction * primary_.cone;
    return narrow_angle(primary_) * std::max(length(place - eye), length(ray.origin - eye));
  }

  /// Explains a ray's answer at a point that one of the two hit.
  std::optional<Verdict> cause_of(const ReferenceRay& ray, const ClaimedAnswer& claimed, const Vec3d& place) {
    const double pixel = pixel_at(place, ray);
    std::optional<Verdict> why = audit_.witnesses_.find(ray, claimed, core::rounding_allowed_pixels * pixel, pixel);
    if (!why && audit_.warned_pixels_ > core::rounding_allowed_pixels) {
      why = audit_.witnesses_.find(ray, claimed, audit_.warned_pixels_ * pixel, std::max(audit_.warned_pixels_, 1.0) * pixel);
      result_.is_warned = result_.is_warned || why;
    }
    return why;
  }

  /// A surface between the hit and the offset start of a ray that leaves it is invisible to that ray, which may miss it.
  void check_start(std::size_t index, const ReferenceRay& right) {
    const ReferenceRay& found = log_.shots[index];
    const double ahead = dot(found.origin - right.origin, right.direction);
    ReferenceRay passed = right;
    passed.kind = RayKind::shadow;
    passed.t_max = std::min(ahead, right.t_max);
    if (ahead > 0 && answer_of(passed).found() && !is_same(log_.rays[index], answer_of(right)) &&
        !audit_.witnesses_.is_beside(passed, {}, core::rounding_allowed_pixels * pixel_at(found.origin, right))) {
      complain(ray_text(found) + " that starts behind something");
    }
  }

  /// Returns where the ray, or a ray beside it, meets the body; in the latter case at the product's distance.
  ReferenceHit hit_of(std::size_t index) {
    const LoggedRay& logged = log_.rays[index];
    const ReferenceRay& ray = log_.shots[index];
    const double rounding = same_hit * (logged.t + audit_.unit_);
    const std::optional<double> t = distance_to(audit_.scene_.bodies[logged.body], ray);
    if (t && std::fabs(*t - logged.t) < rounding) {
      return {*t, logged.body};
    }
    const double pixel = pixel_at(ray.origin + ray.direction * logged.t, ray);
    const auto is_met = [&](double pixels) {
      return audit_.witnesses_.is_met(ray, {logged.t, logged.body}, rounding, pixels * pixel);
    };
    if (!is_met(core::rounding_allowed_pixels)) {
      const bool is_warned = audit_.warned_pixels_ > core::rounding_allowed_pixels && is_met(audit_.warned_pixels_);
      result_.is_warned = result_.is_warned || is_warned;
      if (!is_warned) {
        complain(ray_text(ray) + " that hits its body where no ray does that runs beside it");
      }
    }
    return {logged.t, logged.body};
  }

  void check_spawned(std::size_t index) {
    ReferenceRay from = log_.shots[index];
    from.apart = primary_.apart;
    if (log_.rays[index].body == core::no_primitive) {
      return complain(ray_text(from) + " hits what double precision leaves out");
    }
    const ReferenceHit hit = hit_of(index);
    add_glow(from, hit);
    const Rays exact = ReferenceTracer(audit_.scene_, audit_.finder_, audit_.options_).spawned(from, hit);
    const std::vector<Rays> trials = disturbed(from, hit);
    Rays found;
    for (std::size_t child = index + 1; child < log_.rays.size(); ++child) {
      if (log_.rays[child].maker == log_.rays[index].path) {
        found.push_back(log_.shots[child]);
        check_child(child, find(exact, found.back()), trials);
      }
    }
    for (const ReferenceRay& ray : exact) {
      if (find(found, ray) == nullptr) {
        check_decision(ray, trials, false);
      }
    }
  }

  void add_glow(const ReferenceRay& from, const ReferenceHit& hit) {
    if (!audit_.scene_.hits_glow()) {
      return;
    }
    const Vec3d exact = ReferenceTracer(audit_.scene_, audit_.finder_, audit_.options_).glow(from, hit);
    Vec3d doubt = exact * weight_rounding;
    for (std::uint64_t seed = 0; seed < trial_count; ++seed) {
      Disturbance disturbance(audit_.unit_, seed);
      const Vec3d other = ReferenceTracer(audit_.scene_, audit_.finder_, audit_.options_, &disturbance).glow(from, hit);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        doubt[axis] = std::max(doubt[axis], steps_allowed * std::fabs(other[axis] - exact[axis]));
      }
    }
    result_.glow = result_.glow + exact;
    result_.glow_doubt = result_.glow_doubt + doubt;
  }

  /// `right` is the exact ray, or null.
  void check_child(std::size_t child, const ReferenceRay* right, const std::vector<Rays>& trials) {
    if (right == nullptr) {
      return check_decision(log_.shots[child], trials, true);
    }
    compare(log_.shots[child], *right, trials);
    check_start(child, *right);
  }

  std::vector<Rays> disturbed(const ReferenceRay& from, const ReferenceHit& hit) const {
    std::vector<Rays> trials;
    for (std::uint64_t seed = 0; seed < trial_count; ++seed) {
      Disturbance disturbance(audit_.unit_, seed);
      trials.push_back(ReferenceTracer(audit_.scene_, audit_.finder_, audit_.options_, &disturbance).spawned(from, hit));
      for (ReferenceRay& ray : trials.back()) {
        disturbance.shoot(ray);
      }
    }
    return trials;
  }

  /// Checks a ray that only one of the two shot.
  void check_decision(const ReferenceRay& ray, const std::vector<Rays>& trials, bool was_shot) {
    if (std::none_of(trials.begin(), trials.end(),
                     [&](const Rays& trial) { return (find(trial, ray) != nullptr) == was_shot; })) {
      complain(ray_text(ray) + (was_shot ? " that should not be there" : " that is missing"));
    }
  }

  void compare(const ReferenceRay& found, const ReferenceRay& right, const std::vector<Rays>& trials) {
    Distance spread{.start = float_rounding * audit_.unit_ / 4,
                    .direction = float_rounding / 4,
                    .weight = weight_rounding * (length(right.weight) + weight_rounding)};
    for (const Rays& trial : trials) {
      if (const ReferenceRay* const ray = find(trial, right)) {
        spread.include(Distance::between(*ray, right));
      }
    }
    const double step = Distance::between(found, right).over(spread);
    result_.largest_step = std::max(result_.largest_step, step);
    if (!(step <= steps_allowed)) {
      std::ostringstream text;
      text << ray_text(found) << " that is off by " << step << " times what rounding does";
      complain(text.str());
    }
    if (std::isfinite(right.t_max) && !(std::fabs(found.t_max - right.t_max) <= end_rounding * (right.t_max + audit_.unit_))) {
      complain(ray_text(found) + " with another end");
    }
    if (!(std::fabs(found.cone - right.cone) <= cone_rounding * right.cone + float_rounding * audit_.unit_)) {
      complain(ray_text(found) + " with another cone");
    }
  }

  const StepAudit& audit_;
  const ProductLog& log_;
  const ReferenceRay& primary_;
  Audit result_;
};

Audit StepAudit::of(const ProductLog& log, const ReferenceRay& primary) const { return Case(*this, log, primary).run(); }

}  // namespace dmpc::apps
