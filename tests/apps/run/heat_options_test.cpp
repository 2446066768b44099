#include "apps/run/heat_options.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "core/picture/heat_kind.h"
#include "tests/support/text.h"
#include "tests/support/usage.h"

namespace dmpc::apps::heat_options_test {

using core::HeatKind;
using tests::contains;
using tests::render_usage_complaint;
using tests::typed_render;

TEST_CASE("heat maps may be asked for several times, of every kind") {
  CHECK(typed_render().heat_maps.empty());
  std::vector<std::string> arguments;
  for (const std::string_view kind : core::heat_kind_names) {
    arguments.push_back("--heatmap=" + std::string(kind) + ":" + std::string(kind) + ".png");
  }
  arguments.push_back("--heatmap=rays:C:a b.exr");
  const std::vector<HeatRequest> requests = typed_render(arguments).heat_maps;
  REQUIRE(requests.size() == 10);
  CHECK(requests[0].kind == HeatKind::faults);
  CHECK(requests[7].kind == HeatKind::samples);
  CHECK(requests[7].path == "samples.png");
  CHECK_FALSE(holds_numbers(requests[7]));
  CHECK(requests[9].path == "C:a b.exr");
  CHECK(holds_numbers(requests[9]));
  CHECK(kinds_of(requests).size() == 10);
}

TEST_CASE("there may be 32 heat maps and no more") {
  std::vector<std::string> arguments;
  for (std::size_t i = 0; i < heat_requests_max; ++i) {
    arguments.push_back("--heatmap=rays:" + std::to_string(i) + ".png");
  }
  CHECK(typed_render(arguments).heat_maps.size() == 32);
  arguments.push_back("--heatmap=rays:last.png");
  CHECK(contains(render_usage_complaint(arguments), "given 33 times"));
}

TEST_CASE("kinds of pages are svm's, all others every strategy's") {
  for (const std::string kind : {"faults", "references", "pages"}) {
    const std::string option = "--heatmap=" + kind + ":a.png";
    CHECK(render_usage_complaint({option}).empty());
  }
  for (const std::string kind : {"rays", "time", "node", "depth", "samples"}) {
    CHECK(render_usage_complaint({"--heatmap=" + kind + ":a.png", "--strategy=dataflow"}).empty());
    CHECK(render_usage_complaint({"--heatmap=" + kind + ":a.png", "--strategy=replicated"}).empty());
  }
}

}  // namespace dmpc::apps::heat_options_test
