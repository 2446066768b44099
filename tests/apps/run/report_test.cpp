#include "apps/run/report.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <string>

#include "dataflow/packets.h"
#include "svm/packets.h"
#include "tests/apps/show/rendered.h"

namespace dmpc::apps::run_report_test {

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
    CHECK_FALSE(account.virtual_time);
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

TEST_CASE("an account of a modelled machine has its virtual times and says which waits are for what") {
  const Rendered pages(modelled()), rays(modelled(Strategy::dataflow));
  const Account of_pages = account_of(*pages.report), of_rays = account_of(*rays.report);
  REQUIRE(of_pages.virtual_time);
  CHECK(of_pages.virtual_time->nodes.size() == 4);
  CHECK(of_pages.waits.data_kinds == 1U << svm::number_of(svm::Kind::page_reply));
  CHECK(of_pages.waits.end_kinds == 1U << svm::number_of(svm::Kind::stop));
  REQUIRE(of_rays.virtual_time);
  CHECK(std::string(of_rays.waits.data) == "ray");
  CHECK((of_rays.waits.data_kinds & 1U << dataflow::number_of(dataflow::Kind::rays)) != 0);
}

TEST_CASE("saturated sums of the host's film are found in every report") {
  Rendered pages(small()), rays(small(Strategy::dataflow));
  std::get<svm::Report>(*pages.report).host_deposits_saturated = 7;
  std::get<dataflow::Report>(*rays.report).host_rays.deposits_saturated = 8;
  CHECK(account_of(*pages.report).host_deposits_saturated == 7);
  CHECK(account_of(*rays.report).host_deposits_saturated == 8);
}

}  // namespace dmpc::apps::run_report_test
