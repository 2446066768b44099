#include "apps/show/page/conclusions.h"

#include <doctest/doctest.h>

#include <vector>

#include "apps/show/page/render_tables.h"
#include "core/picture/heat_kind.h"
#include "tests/apps/show/watched.h"

namespace dmpc::apps::html::page_conclusions_test {

TEST_CASE("rays between nodes are concluded with the pair that has most of them") {
  CHECK(
      ray_conclusion(std::vector<std::uint64_t>{0, 3, 1, 0}, 8) ==
      "A ray went to another node 0.50 times on average. Most went from node 0 to node 1: 75 % of all, where an even share were "
      "50 %.");
  CHECK(ray_conclusion(std::vector<std::uint64_t>{0}, 8) == "No ray left the node on which it began.");
}

TEST_CASE("every section of every kind of run has a conclusion, of one node, too") {
  for (const Strategy strategy : {Strategy::svm, Strategy::dataflow, Strategy::replicated}) {
    for (const std::uint32_t node_count : {1U, 3U}) {
      for (RenderOptions options : {small(strategy), modelled(strategy)}) {
        options.computer.node_count = node_count;
        const Rendered rendered(options);
        const Account account = account_of(*rendered.report);
        for (const std::string& sentence :
             {loss_conclusion(losses_of(account)), node_conclusion(account), traffic_conclusion(packets_of(account), nullptr),
              memory_conclusion(account, rendered.database.page_count())}) {
          CAPTURE(sentence);
          CHECK(sentence.ends_with("."));
          CHECK_FALSE(contains(sentence, "nan"));
          CHECK_FALSE(contains(sentence, "inf"));
        }
      }
    }
  }
}

TEST_CASE("a heat map is concluded with the share of its hottest pixels, where its numbers add up") {
  const HeatField rays{.kind = core::HeatKind::rays, .width = 10, .height = 1, .values = {9, 1, 1, 1, 1, 1, 1, 1, 1, 1}};
  CHECK(heat_conclusion(rays) == "The tenth of the pixels with the most rays had 50 % of all.");
  CHECK(heat_conclusion({.kind = core::HeatKind::depth, .width = 1, .height = 1, .values = {2}}).empty());
  CHECK(heat_conclusion({.kind = core::HeatKind::rays, .width = 1, .height = 1, .values = {0}}).empty());
}

}  // namespace dmpc::apps::html::page_conclusions_test
