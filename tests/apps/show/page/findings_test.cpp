#include "apps/show/page/findings.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/show/page/shares.h"
#include "apps/show/page/render_page.h"
#include "apps/show/stats/stats.h"
#include "nodes/packet.h"
#include "tests/apps/show/watched.h"

namespace dmpc::apps::html::findings_test {

namespace {

using nlohmann::json;
using tests::contains;

/// A run of two nodes and a host for 100 ns, as counted on paper: node 0 computes for 60 and waits for pages for 40, node 1
/// computes for 20, sends for 30, serves others for 10 in its idle time and idles for 40.
Account on_paper(const Account& like, const std::optional<nodes::VirtualReport>& report) {
  return {.film = like.film,
          .end = like.end,
          .node_memory_max_bytes = 0,
          .chaos = like.chaos,
          .nodes = std::vector<NodeAccount>(like.nodes.begin(), like.nodes.begin() + 2),
          .operations = {},
          .host = like.host,
          .host_deposits_saturated = 0,
          .sent = {},
          .kind_names = like.kind_names,
          .virtual_time = report,
          .waits = like.waits,
          .refinement = {},
          .ranks = like.ranks};
}

nodes::VirtualReport counted_times(nodes::PacketKind page_reply) {
  nodes::VirtualReport report;
  report.total_ns = 100;
  report.nodes.resize(3);
  report.nodes[0].computing_ns = 60;
  report.nodes[0].waiting_ns[page_reply] = 40;
  report.nodes[1].computing_ns = 20;
  report.nodes[1].sending_ns = 30;
  report.nodes[1].service_idle_ns = 10;
  report.nodes[1].end_ns = 40;
  report.nodes[2].end_ns = 100;  // nobody's loss
  return report;
}

nodes::PacketKind first_in(std::uint32_t kinds) {
  nodes::PacketKind kind = 0;
  while ((kinds >> kind & 1U) == 0) {
    ++kind;
  }
  return kind;
}

}  // namespace

TEST_CASE("the first sentence names what nodes computed and lost most by, as counted on paper") {
  const Rendered rendered(small());
  const Account like = account_of(*rendered.report);
  std::optional<nodes::VirtualReport> times = counted_times(first_in(like.waits.data_kinds));
  const auto sentence = [&] { return time_finding(on_paper(like, times)).sentence; };
  CHECK(sentence() == "2 nodes computed for 40 % of 100 ns; the largest loss: they waited for pages for 20 %.");
  times->nodes[1].end_ns = 0;
  times->nodes[1].sending_ns = 70;
  CHECK(sentence() == "2 nodes computed for 40 % of 100 ns; the largest loss: they sent and received messages for 35 %.");
  times->nodes[0] = times->nodes[1] = {.computing_ns = 100};
  CHECK(sentence() == "2 nodes computed for 100 % of 100 ns.");
  CHECK(time_finding(on_paper(like, times)).place == "plot-losses");
}

TEST_CASE("of threads it names nothing that they do not know") {
  const Rendered rendered(starved(small()));
  const std::string sentence = time_finding(account_of(*rendered.report)).sentence;
  CHECK((contains(sentence, "slept for want of packets") || contains(sentence, "waited for a core of this computer")));
  CHECK_FALSE(contains(sentence, "pages"));
}

TEST_CASE("the three sentences' figures are those of --stats, and each leads to what its page has") {
  const Watched watched(starved(modelled()));
  const json stats = json::parse(stats_json(watched.record()));
  const std::vector<Finding> findings = findings_of(watched.record(), account_of(*watched.report));
  REQUIRE(findings.size() == 3);
  CHECK(contains(findings[0].sentence,
                 "computed for " + share_text(stats["time_percent"]["computing"].get<double>() / 100) + " of "));
  const MissEstimate& misses = *watched.view().misses;
  const auto cache = stats["options"]["cache_pages"].get<std::uint32_t>();
  CHECK(findings[1].sentence ==
        "Twice the cache would fault " + times_text(misses.misses(2 * cache) / misses.misses(cache)) + " as often.");
  double rays = 0, most = 0;
  for (const json& node : stats["nodes"]) {
    rays += node["rays"]["total"].get<double>();
    most = std::max(most, node["rays"]["total"].get<double>());
  }
  CHECK(contains(findings[2].sentence,
                 times_text(most / rays * static_cast<double>(stats["nodes"].size())) + " the mean number of rays"));
  const std::string page = render_page(watched.record(), {.command = "dmpc"});
  for (const Finding& finding : findings) {
    CHECK(contains(page, "<a href=\"#" + finding.place + "\">"));
    CHECK(contains(page, "id=\"" + finding.place + "\""));
  }
}

TEST_CASE("where rays travel they are told of, and where nothing does, what was sent") {
  const Watched rays(modelled(Strategy::dataflow)), nothing(modelled(Strategy::replicated));
  CHECK(findings_of(rays.record(), account_of(*rays.report))[1].place == "Rays between nodes");
  CHECK(findings_of(nothing.record(), account_of(*nothing.report))[1].place == "Traffic");
}

}  // namespace dmpc::apps::html::findings_test
