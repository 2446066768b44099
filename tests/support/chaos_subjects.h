// The small pictures among which a seed of chaos chooses: one pixel or hundreds, one page or hundreds, with all that scenes can
// have.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "tests/support/small_scenes.h"
#include "tests/support/subject.h"

namespace dmpc::tests {

struct ChaosSubject {
  std::string name;
  std::function<core::Scene()> scene;
  Subject::Size size;
  std::size_t page_size_bytes = 512;
};

/// One triangle under one light, in the middle of nothing.
inline core::Scene one_small_triangle() {
  core::Scene scene;
  scene.name = "one small triangle";
  scene.view = {.from = {0, -3, 1}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 40};
  scene.lights = {{{0.5, -2, 3}}};
  core::SceneBuilder builder(scene);
  builder.material({.color = {1, 0.5, 0.2}, .diffuse = 1});
  builder.polygon({{-0.3, 0, -0.2}, {0.3, 0, -0.2}, {0, 0.1, 0.2}});
  return scene;
}

inline const std::array<ChaosSubject, 16>& chaos_subjects() {
  const auto named = [](const char* name) { return [name] { return built_in(name); }; };
  static const std::array<ChaosSubject, 16> subjects = {{
      {"mirrors and glass", mirrors_and_glass, {16, 16}},
      {"mirrors and glass, refined", mirrors_and_glass, {.width = 12, .height = 9, .samples = 2, .refinement = {.error = 0.03}}},
      {"mirrors and glass, two pixels", mirrors_and_glass, {2, 1}, 65536},
      {"mirrors and glass, a column", mirrors_and_glass, {1, 37}, 1024},
      {"mirrors and glass, cut off", mirrors_and_glass, {.width = 9, .height = 6, .samples = 3, .cutoff = 0.02}, 2048},
      {"everything", everything, {12, 8}},
      {"everything, refined", everything, {.width = 7, .height = 5, .samples = 2, .refinement = {.error = 0.02}}},
      {"everything, background", everything, {.width = 11, .height = 7, .samples = 2, .knows_background = true}, 4096},
      {"a thousand lights", thousand_lights, {3, 2}},
      {"tetra-3", named("tetra-3"), {.width = 19, .height = 13, .knows_background = true}},
      {"tetra-3, refined", named("tetra-3"), {.width = 12, .height = 12, .samples = 2, .refinement = {.error = 0.02}}, 1024},
      {"balls-2", named("balls-2"), {13, 7}, 4096},
      {"rings-1", named("rings-1"), {10, 10}},
      {"teapot-3", named("teapot-3"), {14, 9}},
      {"one small triangle", one_small_triangle, {.width = 21, .height = 5, .knows_background = true}},
      {"one small triangle, one pixel", one_small_triangle, {1, 1}, 65536},
  }};
  return subjects;
}

/// The subject with this number, made when it is first asked for. Not thread-safe.
inline const Subject& chaos_subject(std::size_t number, core::Structure structure = core::Structure::grid) {
  static std::array<std::array<std::unique_ptr<const Subject>, 16>, 3> made;
  const ChaosSubject& wanted = chaos_subjects().at(number);
  std::unique_ptr<const Subject>& subject = made.at(static_cast<std::size_t>(structure)).at(number);
  if (!subject) {
    subject = std::make_unique<const Subject>(
        wanted.scene(), wanted.size, core::BuildOptions{.page_size_bytes = wanted.page_size_bytes, .structure = structure});
  }
  return *subject;
}

}  // namespace dmpc::tests
