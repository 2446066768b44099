// Rough metal and rough plastic against Cycles, of Blender 3.4.1 as Debian 12 has it, made as in cycles_test.cpp, glossy bounces
// as many as the others.
//
// A metal is a Glossy BSDF (GGX) of its colour and roughness; a plastic is one of grey .04, and added to it a diffuse BSDF of
// 1.05 * .96 times its colour. Neither scatters twice between tiny mirrors, as ours does not. What differs by definition is next
// to nothing here, since light and camera stand above what is seen. By Schlick's Fresnel ours reflect more beside the mirror's
// angle, and let less through to the plastic's colour: 2e-4 of the rest where the mirror is tilted by 35 degrees. Heights hide
// and shadow together; if each did so for itself, that would be 2e-4 of the light less at 45 degrees, with roughness .5.
#include <doctest/doctest.h>

#include "tests/support/cycles_pictures.h"

namespace cycles_metals_test {

using namespace dmpc::core;
using namespace dmpc::tests::cycles;

namespace {

void add_boxes(Model& model, const Vec3d& one, const Microfacets& facets, const Vec3d& other) {
  model.fill(one, facets);
  model.box({.9, 1.2, 0}, {1.7, 2, .5});
  model.fill(other);
  model.box({2.4, 2.2, 0}, {3.1, 2.9, .35});
  model.shine({70, 60, 50});
  model.face({{1, 2.5, 6}, {3.2, 2.5, 6}, {3.2, 4.5, 6}, {1, 4.5, 6}});
}

/// Rough copper below matt boxes.
Model forge() {
  Model model({2, -1.2, 7}, {2, 1.9, 0}, 30);
  model.fill({.95, .64, .54}, {.roughness = .45, .metallic = 1});
  model.floor(0, 4);
  add_boxes(model, {.7, .7, .3}, {}, {.3, .5, .8});
  return model;
}

/// Plastic of two kinds.
Model desk() {
  Model model({2, -1.5, 7}, {2, 1.9, 0}, 30);
  model.fill({.15, .35, .6}, {.roughness = .5});
  model.floor(0, 4);
  add_boxes(model, {.7, .2, .1}, {.roughness = .3}, {.6, .6, .6});
  return model;
}

}  // namespace

TEST_CASE("rough copper below a panel that shines is as bright as Cycles has it after two bounces") {
  check(film_of(forge().scene(), samples, 2, {.kind = TransportKind::paths}), {{{0.57318, 0.33096, 0.23266},
                                                                                {1.27767, 0.73775, 0.51866},
                                                                                {1.31198, 0.76576, 0.54706},
                                                                                {0.63182, 0.36565, 0.25796},
                                                                                {1.81939, 1.07146, 0.73078},
                                                                                {4.23287, 2.54795, 1.67965},
                                                                                {3.50334, 2.27328, 1.86286},
                                                                                {1.98372, 1.17779, 0.86235},
                                                                                {2.24318, 1.33067, 0.89703},
                                                                                {4.36694, 2.66712, 1.71168},
                                                                                {8.99052, 5.19107, 3.64926},
                                                                                {3.35131, 1.93517, 1.36063},
                                                                                {1.80978, 1.04498, 0.73469},
                                                                                {4.40525, 2.54361, 1.78829},
                                                                                {4.65630, 2.68865, 1.89030},
                                                                                {2.05562, 1.18698, 0.83456}}});
}

TEST_CASE("rough plastic below a panel that shines is as bright as Cycles has it") {
  check(film_of(desk().scene(), samples, 0, {.kind = TransportKind::paths}), {{{0.18365, 0.34104, 0.47548},
                                                                               {0.28696, 0.51803, 0.71509},
                                                                               {0.29150, 0.52503, 0.72416},
                                                                               {0.19065, 0.35266, 0.49102},
                                                                               {0.41051, 0.61609, 0.82455},
                                                                               {0.90589, 0.86814, 1.02716},
                                                                               {0.86329, 0.94544, 1.00190},
                                                                               {0.39801, 0.64549, 0.85492},
                                                                               {0.43105, 0.56068, 0.72313},
                                                                               {0.95121, 0.65587, 0.64673},
                                                                               {0.58884, 0.86016, 1.08706},
                                                                               {0.40594, 0.66675, 0.88771},
                                                                               {0.26673, 0.44750, 0.60092},
                                                                               {0.36369, 0.54914, 0.70491},
                                                                               {0.37253, 0.55858, 0.71472},
                                                                               {0.27967, 0.46363, 0.61960}}});
}

}  // namespace cycles_metals_test
