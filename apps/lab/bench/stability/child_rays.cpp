// R10: child rays of a hit meet neither its own surface nor anything that lies wholly behind it, and no light passes two sheets
// close together.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "apps/lab/bench/stability/bodies.h"
#include "apps/lab/bench/stability/case.h"
#include "apps/lab/bench/stability/children.h"
#include "apps/lab/bench/stability/judge.h"
#include "apps/lab/bench/stability/rays.h"
#include "apps/lab/bench/stability/targets.h"
#include "apps/oracle/curved.h"
#include "core/families/scenes.h"
#include "core/record/curved_values.h"
#include "core/scene/frame.h"

namespace dmpc::apps {
namespace {

using core::Hit;
using core::PrimitiveKind;
using core::PrimitiveValues;
using core::Ray;
using core::Scene;
using core::Vec3d;
using Must = StabilityExpectation::Must;

/// A body that reaches less than this in front of a surface cannot block its child rays: triangles have float accuracy and start
/// their child rays as far off; curved bodies are known and solved in double.
double reach_in_front(PrimitiveKind surface, PrimitiveKind met) {
  constexpr double flat = 0x1p-22, curved = 0x1p-32;
  return surface == PrimitiveKind::triangle && met == PrimitiveKind::triangle ? flat : curved;
}

/// The tangent plane of a hit's surface, with the side on which a child ray starts in front.
struct Tangent {
  Vec3d point, normal;

  double height(const Vec3d& at) const { return dot(at - point, normal); }
};

/// Returns the normal of a sphere or cone there: the implicit function's gradient, not normalised.
Vec3d curved_normal(const core::CurvedValues& body, PrimitiveKind kind, const Vec3d& at) {
  const Vec3d from = at - body.vector(0);
  if (kind == PrimitiveKind::sphere) {
    return from;
  }
  const Vec3d axis = body.axis();
  const double low = std::fabs(body.value(3)), widening = std::fabs(body.value(7)) - low;
  const double height = dot(from, axis) / dot(axis, axis), radius = low + widening * height;
  return from - axis * height - axis * (radius * widening / dot(axis, axis));
}

/// A curved body's point is the referee's, since the kernels round its distance.
Tangent tangent_at(const PrimitiveValues& body, const Ray& parent, const Hit& hit, const Ray& child) {
  Tangent tangent;
  if (body.kind == PrimitiveKind::triangle) {
    tangent.point = body.vector(0);
    tangent.normal = cross(body.vector(3) - tangent.point, body.vector(6) - tangent.point);
  } else {
    const double t = nearest_on_curved(body, parent).value_or(double{hit.t});
    tangent.point = parent.full_origin() + parent.full_direction() * t;
    tangent.normal = curved_normal(body.curved(), body.kind, tangent.point);
  }
  tangent.normal = normalize(tangent.normal);
  if (dot(tangent.normal, child.full_direction()) < 0) {
    tangent.normal = -tangent.normal;
  }
  return tangent;
}

/// Returns how far the body reaches in front, at most: exact for triangles and spheres, an upper bound for cones.
double reach_of(const PrimitiveValues& body, const Tangent& tangent) {
  if (body.kind == PrimitiveKind::triangle) {
    return std::max({tangent.height(body.vector(0)), tangent.height(body.vector(3)), tangent.height(body.vector(6))});
  }
  const core::CurvedValues curved = body.curved();
  const double first = tangent.height(curved.vector(0)), radius = std::fabs(curved.value(3));
  if (body.kind == PrimitiveKind::sphere) {
    return first + radius;
  }
  const Vec3d axis = normalize(curved.axis());
  const double slant = std::sqrt(std::max(0.0, 1 - dot(axis, tangent.normal) * dot(axis, tangent.normal)));
  return std::max(first + slant * radius, tangent.height(curved.apex()) + slant * std::fabs(curved.value(7)));
}

/// A child ray that leaves its surface at a smaller cosine almost stays in it, as an interpolated normal may cause. Near an edge
/// its offset is limited by the space there, so rounding decides whether it hits the neighbour that begins there.
constexpr double grazing_cosine = 0x1p-14;

/// Counts the kernels' answers to a child ray: a hit on something behind its surface is acne.
class ChildJudge {
 public:
  ChildJudge(const StabilitySubject& subject, KernelCounts& counts) : subject_(subject), counts_(counts) {}

  void judge_children(const Ray& parent) {
    const Hit hit = shoot(subject_.database, parent);
    for (const Ray& child : children_of(subject_.database, parent, hit)) {
      const PrimitiveValues& surface = subject_.database.primitives()[hit.primitive];
      judge_child(child, surface.kind, tangent_at(surface, parent, hit, child));
    }
  }

 private:
  bool lies_behind(const Hit& hit, PrimitiveKind surface, const Tangent& tangent) const {
    const PrimitiveValues& met = subject_.database.primitives()[hit.primitive];
    return reach_of(met, tangent) < reach_in_front(surface, met.kind);
  }

  bool is_by_rounding(const Ray& child, const Hit& hit, const Tangent& tangent, StabilityKernel kernel) const {
    return dot(child.full_direction(), tangent.normal) < grazing_cosine &&
           subject_.referee.examine(child, hit.primitive).possible(is_embree(kernel) ? Renderer::embree : Renderer::grid);
  }

  void judge_child(const Ray& child, PrimitiveKind surface, const Tangent& tangent) {
    const StabilityAnswers answers = ask_kernels(subject_, child);
    const Hit& grid = answers[index_of(StabilityKernel::grid)];
    for (std::size_t k = 0; k < answers.size(); ++k) {
      const auto kernel = static_cast<StabilityKernel>(k);
      const bool any_hit = kernel == StabilityKernel::any_hit;
      ++counts_[k].tried;
      if (answers[k].found() && lies_behind(answers[k], surface, tangent)) {
        ++(is_by_rounding(child, answers[k], tangent, kernel) ? counts_[k].explained : counts_[k].wrong_hits);
      } else if (!is_embree(kernel) && !(any_hit ? answers[k].found() == grid.found() : same_hit(answers[k], grid))) {
        ++counts_[k].unexplained;
      } else if (is_embree(kernel) && answers[k].primitive != grid.primitive) {
        ++counts_[k].explained;
      }
    }
  }

  const StabilitySubject& subject_;
  KernelCounts& counts_;
};

/// Returns rays near the surfaces of random primitives, at all angles down to some 10^-4 radians.
Ray ray_onto(const core::Database& database, Random& random) {
  const PrimitiveValues& body = database.primitives()[random.below(database.primitives().size())];
  const Vec3d at = surface_point(body, random);
  const Vec3d normal = body.kind == PrimitiveKind::triangle
                           ? cross(body.vector(3) - body.vector(0), body.vector(6) - body.vector(0))
                           : curved_normal(body.curved(), body.kind, at);
  const Vec3d up = normalize(normal), along = normalize(cross(up, random.direction()));
  const double rise = std::pow(10.0, random.between(-4, 0));
  return ray_through(at + normalize(along + up * rise) * random.between(0.05, 1.0), at);
}

ShootRays children_in(const Scene& scene) {
  const auto subject = std::make_shared<const StabilitySubject>(scene);
  return each_ray([subject](Random& random, std::uint64_t, KernelCounts& counts) {
    ChildJudge(*subject, counts).judge_children(ray_onto(subject->database, random));
  });
}

/// Returns a mirror under eight lights that surround it.
Scene lit(Scene scene) {
  for (std::uint32_t i = 0; i < 8; ++i) {
    scene.lights.push_back({{(i & 1U) != 0 ? 9.0 : -8.0, (i & 2U) != 0 ? 7.0 : -9.0, (i & 4U) != 0 ? 8.0 : -7.0}});
  }
  for (core::Material& material : scene.materials) {
    material.specular = 0.5;
    material.shine = 10;
  }
  return scene;
}

void add_bodies(const StabilityAmount& amount, StabilityCases& cases) {
  const auto bodies = closed_bodies();
  for (const ClosedBody& body : bodies) {
    cases.push_back({"R10 children of bodies", body.name, amount.share(1'000'000, bodies.size()),
                     [body] { return children_in(lit(body.scene)); }});
  }
}

void add_spd_children(const StabilityAmount& amount, StabilityCases& cases) {
  constexpr std::array<double, 3> scales{1e-6, 1, 1e6};
  constexpr std::array<const char*, 11> names{"balls-2",  "gears-1",    "jacks-2",  "lattice-2", "mount-4", "rings-2",
                                              "shells-2", "sombrero-1", "teapot-6", "tetra-5",   "tree-5"};
  for (const char* name : names) {
    for (const double scale : scales) {
      const int exponent = static_cast<int>(std::lround(std::log10(scale)));
      cases.push_back({"R10 children in the SPD", std::string(name) + " 1e" + std::to_string(exponent),
                       amount.share(1'000'000, names.size() * scales.size()), [name, scale] {
                         return children_in(transformed(core::built_in_scene(core::parse_scene_name(name)), scale, {}));
                       }});
    }
  }
}

Scene two_sheets() {
  Scene scene;
  scene.view = {.from = {0, 0, 3}, .at = {0, 0, 0}, .up = {0, 1, 0}};
  core::SceneBuilder builder(scene);
  builder.light({.position = {0.3, 0.2, 5}});
  builder.material({.specular = 0.5, .shine = 10});
  for (const double z : {0.0, 1e-4}) {
    builder.polygon({{-0.5, -0.5, z}, {0.5, -0.5, z}, {0.5, 0.5, z}, {-0.5, 0.5, z}});
  }
  return scene;
}

/// Between the sheets every child ray hits; above them none does.
ShootRays children_of_sheets(double scale) {
  const auto subject = std::make_shared<const StabilitySubject>(transformed(two_sheets(), scale, {}));
  return each_ray([subject, scale](Random& random, std::uint64_t i, KernelCounts& counts) {
    const Vec3d at{random.between(-0.45, 0.45), random.between(-0.45, 0.45), 5e-5};
    const bool between = i % 2 == 0;
    const Vec3d from = between ? at : Vec3d{at.x, at.y, 1}, to = between ? Vec3d{at.x, at.y, -1} : at;
    const Ray parent = ray_through(to_local(subject->frame(), from * scale), to_local(subject->frame(), to * scale));
    for (const Ray& child : children_of(subject->database, parent, shoot(subject->database, parent))) {
      judge(*subject, child, ask_kernels(*subject, child), {between ? Must::hit : Must::miss}, counts);
    }
  });
}

void add_sheets(const StabilityAmount& amount, StabilityCases& cases) {
  constexpr std::array<double, 3> scales{1e-6, 1, 1e6};
  for (const double scale : scales) {
    cases.push_back({"R10 sheets 1e-4 apart", "scale " + std::to_string(scale), amount.share(1'000'000, scales.size()),
                     [scale] { return children_of_sheets(scale); }});
  }
}

}  // namespace

StabilityCases child_cases(const StabilityAmount& amount) {
  StabilityCases cases;
  add_bodies(amount, cases);
  add_spd_children(amount, cases);
  add_sheets(amount, cases);
  return cases;
}

}  // namespace dmpc::apps
