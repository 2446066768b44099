// Light that surfaces scatter under a sky, or from emitters, compared with an independent integrator: Cycles, of Blender 3.4.1
// from Debian 12.
//
// Its figures are means over eight runs of 8,192 samples, each of 4x4 pixels, whose own errors are below 2e-4: `blender -b
// --factory-startup -P script`, engine CYCLES on one thread, max_bounces and diffuse_bounces as below, pixel filter BOX of width
// 1, no adaptive sampling, no denoising, clamps 0, light_sampling_threshold 0, use_fast_gi off, view transform Raw, EXR of 32
// bits; materials a diffuse BSDF of roughness 0; the world's colour a MixRGB of horizon and zenith by the maximum of 0 and z of
// the generated coordinates. A camera's angle spans its pixels there, from side to side; of an NFF view it spans their middles.
#include <doctest/doctest.h>

#include "tests/support/cycles_pictures.h"

namespace cycles_test {

using namespace dmpc::core;
using namespace dmpc::tests::cycles;

namespace {

Model corner() {
  Model model({5, -6, 3}, {1.5, 1.5, 1}, 40);
  model.fill({.8, .8, .8});
  model.floor(0, 4);
  model.fill({.7, .2, .15});
  model.face({{0, 0, 0}, {0, 4, 0}, {0, 4, 2.5}, {0, 0, 2.5}});
  model.fill({.2, .6, .3});
  model.face({{0, 4, 0}, {4, 4, 0}, {4, 4, 2.5}, {0, 4, 2.5}});
  model.fill({.6, .6, .9});
  model.box({1, 1.5, 0}, {2.2, 2.7, 1.3});
  return model;
}

Model court() {
  Model model({2, 2.2, 9}, {2, 2, 0}, 34);
  model.fill({.75, .7, .6});
  model.floor(0, 4);
  model.fill({.8, .8, .8});
  model.face({{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}});
  model.fill({.7, .3, .2});
  model.face({{4, 0, 0}, {4, 4, 0}, {4, 4, 3}, {4, 0, 3}});
  model.fill({.5, .5, .8});
  model.face({{4, 4, 0}, {0, 4, 0}, {0, 4, 3}, {4, 4, 3}});
  model.fill({.4, .7, .4});
  model.face({{0, 4, 0}, {0, 0, 0}, {0, 0, 3}, {0, 4, 3}});
  model.fill({.9, .9, .9});
  model.box({1.6, 1.6, 0}, {2.4, 2.4, 1.5});
  return model;
}

Model steps() {
  Model model({4, -7, 4}, {1.5, 1.5, .9}, 36);
  for (int step = 0; step < 5; ++step) {
    model.fill(step % 2 == 0 ? Vec3d{.8, .5, .3} : Vec3d{.7, .7, .7});
    model.box({0, .6 * step, 0}, {3, .6 * (step + 1), .4 * (step + 1)});
  }
  model.fill({.5, .5, .5});
  model.floor(-20, 20);
  return model;
}

Model arcade() {
  Model model({2, -5, 1.2}, {2, 2, 1.1}, 45);
  model.fill({.7, .7, .7});
  model.floor(-20, 20);
  model.fill({.85, .85, .8});
  model.box({-.5, 0, 2}, {4.5, 4, 2.3});
  model.fill({.8, .6, .4});
  model.face({{-.5, 4, 0}, {4.5, 4, 0}, {4.5, 4, 2}, {-.5, 4, 2}});
  model.fill({.6, .7, .8});
  for (const double x : {0.0, 1.8, 3.6}) {
    model.box({x, .2, 0}, {x + .4, .6, 2});
  }
  return model;
}

/// A room with walls of several colours, a box and a panel below its ceiling.
Model vault() {
  Model model({2, -3.2, 1.6}, {2, 2, 1.1}, 50);
  model.fill({.7, .7, .7});
  model.floor(0, 4);
  model.fill({.8, .8, .8});
  model.face({{0, 0, 2.5}, {4, 0, 2.5}, {4, 4, 2.5}, {0, 4, 2.5}});
  model.fill({.75, .75, .7});
  model.face({{0, 4, 0}, {4, 4, 0}, {4, 4, 2.5}, {0, 4, 2.5}});
  model.fill({.7, .2, .15});
  model.face({{0, 0, 0}, {0, 4, 0}, {0, 4, 2.5}, {0, 0, 2.5}});
  model.fill({.2, .6, .3});
  model.face({{4, 0, 0}, {4, 4, 0}, {4, 4, 2.5}, {4, 0, 2.5}});
  model.fill({.6, .6, .9});
  model.box({1, 1.5, 0}, {2, 2.5, 1.2});
  model.shine({8, 7, 5});
  model.face({{1.5, 1.5, 2.4}, {2.5, 1.5, 2.4}, {2.5, 2.5, 2.4}, {1.5, 2.5, 2.4}});
  return model;
}

/// The steps, lit by a small bright box before them and a large dim panel beside them.
Model lit_steps() {
  Model model = steps();
  model.shine({30, 20, 10});
  model.box({.2, -1, 1}, {.5, -.7, 1.3});
  model.shine({.5, 1, 2});
  model.face({{3.4, 0, .5}, {3.4, 3, .5}, {3.4, 3, 2}, {3.4, 0, 2}});
  return model;
}

Film under_sky(Scene scene, int samples, int bounces, const Vec3d& horizon, const Color& zenith) {
  scene.background = horizon;
  return film_of(scene, samples, bounces,
                 {.kind = TransportKind::paths, .has_sky = true, .has_gradient = true, .zenith = zenith, .up = {0, 0, 1}});
}

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

TEST_CASE("a corner under a white sky is as bright as Cycles has it after three bounces") {
  check(under_sky(corner().scene(), samples, 3, {1, 1, 1}, {1, 1, 1}), "corner");
}

TEST_CASE("a court under a sky of two colours is as bright as Cycles has it after six bounces") {
  check(under_sky(court().scene(), samples, 6, {1, .8, .6}, {.2F, .4F, 1}), "court");
}

TEST_CASE("steps under a sky of two colours are as bright as Cycles has them after one bounce") {
  check(under_sky(steps().scene(), samples, 1, {1, .9, .7}, {.3F, .5F, .9F}), "steps");
}

TEST_CASE("an arcade under a sky of two colours is as bright as Cycles has it after four bounces") {
  check(under_sky(arcade().scene(), samples, 4, {.9, .9, 1}, {.4F, .6F, 1}), "arcade");
}

TEST_CASE("a room below a panel that shines is as bright as Cycles has it after four bounces") {
  check(film_of(vault().scene(), samples, 4, {.kind = TransportKind::paths}), "vault");
}

TEST_CASE("steps between a small bright box and a large dim panel are as bright as Cycles has them after two bounces") {
  check(film_of(lit_steps().scene(), samples, 2, {.kind = TransportKind::paths}), "lit_steps");
}

TEST_CASE("rough copper below a panel that shines is as bright as Cycles has it after two bounces") {
  check(film_of(forge().scene(), samples, 2, {.kind = TransportKind::paths}), "forge");
}

TEST_CASE("rough plastic below a panel that shines is as bright as Cycles has it") {
  check(film_of(desk().scene(), samples, 0, {.kind = TransportKind::paths}), "desk");
}

}  // namespace cycles_test
