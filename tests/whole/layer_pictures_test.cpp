// Layers beside a picture, and pictures whose indirect light is limited: the same bits by every strategy.
#include <doctest/doctest.h>

#include <cstdint>

#include "core/picture/camera/layer_settings.h"
#include "nodes/chaos.h"
#include "tests/support/faceted_surfaces.h"
#include "tests/support/film_of.h"
#include "tests/support/mesh_surfaces.h"
#include "tests/support/scaled.h"
#include "tests/support/small_scenes.h"
#include "tests/support/strategies.h"

namespace dmpc::tests::layer_pictures_test {

namespace {

using core::Layer;

constexpr core::Transport under_sky{.kind = core::TransportKind::paths, .has_sky = true};

Subject::Size size_of(const core::Transport& transport, int samples) {
  return {.width = scaled_edge(22),
          .height = scaled_edge(18),
          .samples = samples,
          .knows_background = true,
          .transport = transport,
          .depth_max = 4};
}

void check_layer(Layer layer, const Subject& subject, const Subject& extents) {
  const core::RenderSettings settings = core::layer_settings(layer, subject.settings());
  const core::RenderSettings on_extents = core::layer_settings(layer, extents.settings());
  const std::uint64_t expected = film_of(subject.database(), settings.with_every_ray_traced()).hash();
  CHECK(film_of(extents.database(), on_extents.with_every_ray_traced()).hash() == expected);
  for (const std::uint32_t nodes : {1U, 3U, 16U}) {
    for (int kind = 0; kind < 4; ++kind) {
      CAPTURE(nodes);
      CAPTURE(kind);
      const nodes::ComputerRequest computer = computer_of_kind(kind, nodes, 7);
      CHECK(svm::run_svm(subject.database(), settings, {.computer = computer, .pages = {.cache_pages = 4}}, {}).film.hash() ==
            expected);
      CHECK(svm::run_replicated(subject.database(), settings, {.computer = computer}, {}).film.hash() == expected);
      CHECK(svm::run_forest(extents.database(), on_extents, {.computer = computer}, {}).film.hash() == expected);
      CHECK(dataflow::run_dataflow(subject.database(), settings, {.computer = computer}, {}).film.hash() == expected);
    }
  }
}

void check_layers(const core::Scene& scene, const Subject::Size& size) {
  const bool for_paths = size.transport.is_by_paths();
  const Subject subject(scene, size, {.page_size_bytes = 512, .for_paths = for_paths});
  const Subject extents(scene, size, {.structure = core::Structure::extents, .for_paths = for_paths});
  for (const Layer layer : {Layer::albedo, Layer::normal, Layer::depth, Layer::id}) {
    CAPTURE(scene.name);
    CAPTURE(core::name_of(layer));
    check_layer(layer, subject, extents);
  }
}

}  // namespace

TEST_CASE("layers of mirrors, glass, textures, and what alpha leaves out are the same to the bit on every computer") {
  core::Scene textured = mirrors_and_glass();
  add_textured_walls(textured);
  check_layers(textured, size_of({}, 3));
  check_layers(mesh_surfaces(), size_of(under_sky, 1));
}

TEST_CASE("layers of metals and of rough surfaces are the same to the bit on every computer") {
  check_layers(faceted_surfaces(), size_of(under_sky, 3));
}

TEST_CASE("a picture whose indirect light is clamped is darker, and one by every strategy") {
  const Subject subject(mesh_surfaces(), size_of(under_sky, 3), {.for_paths = true});
  core::RenderSettings settings = subject.settings();
  settings.shade.clamp = 0.05F;
  const core::Film clamped = film_of(subject.database(), settings.with_every_ray_traced()),
                   all = film_of(subject.database(), subject.settings().with_every_ray_traced());
  double darker = 0;
  for (std::uint32_t pixel = 0; pixel < all.pixel_count(); ++pixel) {
    CHECK(clamped.radiance(pixel).y <= all.radiance(pixel).y);
    darker += all.radiance(pixel).y - clamped.radiance(pixel).y;
  }
  CHECK(darker > 1e-3 * static_cast<double>(all.pixel_count()));
  for (int kind = 0; kind < 4; ++kind) {
    const nodes::ComputerRequest computer = computer_of_kind(kind, 3, 5);
    CHECK(svm::run_svm(subject.database(), settings, {.computer = computer}, {}).film.hash() == clamped.hash());
    CHECK(dataflow::run_dataflow(subject.database(), settings, {.computer = computer}, {}).film.hash() == clamped.hash());
  }
}

TEST_CASE("the picture beside which layers are rendered stays as it is") {
  const Subject subject(mesh_surfaces(), size_of(under_sky, 2), {.for_paths = true});
  const core::RenderSettings picture = core::layer_settings(Layer::albedo, subject.settings());
  CHECK(film_of(subject.database(), picture).hash() != subject.outcome().film_hash);
  CHECK(outcome_of(run_svm(subject, {.computer = {.node_count = 3}})) == subject.outcome());
}

}  // namespace dmpc::tests::layer_pictures_test
