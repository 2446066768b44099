#include "apps/show/page/render_page.h"

#include <doctest/doctest.h>

#include <sstream>
#include <string>

#include "core/picture/heat_kind.h"
#include "tests/apps/show/watched.h"
#include "tests/support/text.h"

namespace dmpc::apps::html::render_page_test {

namespace {

Origin origin() {
  return {.command = "dmpc render x", .program = "dmpc 1.2", .date = "2026-11-22 21:40 UTC", .computer = "2 processors"};
}

std::string page_of(const RenderOptions& options) {
  std::string text = render_page(Rendered(options).record(), origin());
  return text;
}

}  // namespace

TEST_CASE("the page of a render has its picture, losses, nodes, traffic and memory") {
  for (const RenderOptions& options : {small(), modelled(Strategy::dataflow), small(Strategy::replicated)}) {
    const std::string text = page_of(options);
    for (const char* const part :
         {"Render of balls-1", "16x12 pixels", "Where each node&#39;s time went", "What each node did", "Packets by kind",
          "Memory of each node", "data:image/png", "id=\"plot-losses\"", "dmpc render x", "dmpc 1.2, 2026-11-22, film "}) {
      CHECK_MESSAGE(contains(text, part), part);
    }
    CHECK_FALSE(contains(text, "What each pixel took"));
  }
}

TEST_CASE("pictures and tables of a page can be saved, and each section but the picture's says what it comes to") {
  const std::string text = page_of(modelled());
  const auto count = [&](const std::string& part) { return tests::count(text, part); };
  CHECK(count("class=\"save\"") == count("<img ") + count("<table") + count("<figure class=\"plot\""));
  CHECK(count("class=\"conclusion\"") == 4);  // losses, nodes, traffic, memory
  CHECK(contains(text, "The busiest link, from "));
}

TEST_CASE("links and the run's hash are shown of modelled machines alone") {
  CHECK(contains(page_of(modelled()), "The busiest links"));
  CHECK(contains(page_of(modelled()), "<dt>Run</dt>"));
  CHECK_FALSE(contains(page_of(small()), "The busiest links"));
}

TEST_CASE("heat maps are shown if they are asked for") {
  RenderOptions options = small();
  options.heat_maps = {{core::HeatKind::rays, "r.png"}, {core::HeatKind::faults, "f.exr"}};
  const std::string text = page_of(options);
  CHECK(contains(text, "Heat map of rays"));
  CHECK(contains(text, "Heat map of faults"));
  CHECK_FALSE(contains(text, "Heat map of depth"));
}

TEST_CASE("what observers have seen is shown") {
  const std::string text = render_page(Watched(starved(modelled())).record(), origin());
  for (const char* const part :
       {"Over time", "Who fetched pages from whom", "How busy each node was over time", "The hottest pages",
        "What fetching a page takes", "Faults by the size of the caches", "Plot: What the nodes were busy with over time"}) {
    CHECK_MESSAGE(contains(text, part), part);
  }
  const std::string rays = render_page(Watched(small(Strategy::dataflow)).record(), origin());
  CHECK(contains(rays, "Who sent rays to whom"));
  CHECK_FALSE(contains(rays, "<caption>The hottest pages</caption>"));
}

TEST_CASE("a page of a node that fetches nothing says so") {
  RenderOptions options = modelled();
  options.computer.node_count = 1;
  const std::string text = render_page(Watched(options).record(), origin());
  CHECK(contains(text, "No page was fetched: each node found all that it looked up at home."));
  CHECK_FALSE(contains(text, "Fetching a page"));
}

TEST_CASE("a scene's name is no markup") {
  Rendered rendered(small());
  rendered.options.picture.scene = "<script>alert(1)</script>.nff";
  const std::string text = render_page(rendered.record(), origin());
  CHECK_FALSE(contains(text, "<script>alert"));
  CHECK(contains(text, "&lt;script&gt;alert(1)"));
}

}  // namespace dmpc::apps::html::render_page_test
