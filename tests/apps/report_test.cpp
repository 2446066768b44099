#include "apps/report.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <string>

#include "tests/apps/rendered.h"

namespace dmpc::apps {

TEST_CASE("an account of any strategy says what the report says") {
  for (const Strategy strategy : {Strategy::svm, Strategy::replicated, Strategy::dataflow}) {
    const Rendered rendered(small(strategy));
    const Account account = account_of(*rendered.report);
    CHECK(account.end == nodes::RunEnd::finished);
    CHECK(account.film.width() == 16);
    CHECK(account.nodes.size() == 3);
    CHECK(account.operations.rays[0] == 192);
    CHECK(account.node_memory_max_bytes >= account.nodes[0].memory_used.total());
    CHECK(account.nodes[0].memory_planned.total() > 0);
    CHECK_FALSE(account.chaos);
  }
}

TEST_CASE("an account sums up what nodes and host sent and how it is called") {
  const Rendered pages(small()), rays(small(Strategy::dataflow));
  const Account of_pages = account_of(*pages.report), of_rays = account_of(*rays.report);
  CHECK(std::string(of_pages.kind_names[0]) == "page_request");
  CHECK(std::string(of_rays.kind_names[0]) == "rays");
  std::uint64_t sent = of_rays.host.sent[0].packets;
  for (const NodeAccount& node : of_rays.nodes) {
    sent += node.counters.sent[0].packets;
  }
  CHECK(of_rays.sent[0].packets == sent);
  CHECK(sent > 0);
}

TEST_CASE("saturated sums of the host's film are found in every report") {
  Rendered pages(small()), rays(small(Strategy::dataflow));
  std::get<svm::Report>(*pages.report).host_deposits_saturated = 7;
  std::get<dataflow::Report>(*rays.report).host_rays.deposits_saturated = 8;
  CHECK(account_of(*pages.report).host_deposits_saturated == 7);
  CHECK(account_of(*rays.report).host_deposits_saturated == 8);
}

}  // namespace dmpc::apps
