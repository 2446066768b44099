#include "apps/run/layer_options.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/support/text.h"
#include "tests/support/usage.h"

namespace dmpc::apps::layer_options_test {

using core::Layer;
using tests::contains;
using tests::render_usage_complaint;
using tests::typed_render;

TEST_CASE("layers go to files, or several into the picture's own, and each is rendered once") {
  CHECK(typed_render().layers.empty());
  const std::vector<LayerRequest> files = typed_render({"--aov=depth:C:a b.exr", "--aov=id:id.png", "--aov=depth:d.png"}).layers;
  REQUIRE(files.size() == 3);
  CHECK(files[0].layer == Layer::depth);
  CHECK(files[0].path == "C:a b.exr");
  CHECK(layers_of(files) == std::vector{Layer::depth, Layer::id});
  const std::vector<LayerRequest> within = parse_layer_requests("normal,albedo");
  CHECK(layers_of(within) == std::vector{Layer::normal, Layer::albedo});
  CHECK_FALSE(within[0].path);
  CHECK_NOTHROW(check_layers(within, "a.exr"));
}

TEST_CASE("too many layers are refused") {
  std::vector<std::string> many;
  for (int i = 0; i < 9; ++i) {
    many.push_back("--aov=id:" + std::to_string(i) + ".exr");
  }
  CHECK(contains(render_usage_complaint(many), "8 are the most"));
}

}  // namespace dmpc::apps::layer_options_test
