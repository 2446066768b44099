// Who looks on at a render over ranks sees what is to be seen in one process: several ranks in one, by the loopback fabric.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "apps/render/ranks.h"
#include "apps/run/heat_options.h"
#include "apps/show/page/render_page.h"
#include "apps/show/trace/file.h"
#include "core/picture/heat_kind.h"
#include "tests/apps/show/watched.h"
#include "tests/support/loopback_ranks.h"

namespace dmpc::apps::watched_over_ranks_test {

namespace {

using core::HeatKind;

constexpr std::uint32_t rank_counts[] = {1, 2, 3};

/// Renders over ranks with all that looks on, and calls look(watched) on rank 0.
template <class Look>
void watch_over(std::uint32_t rank_count, const RenderOptions& options, const Look& look) {
  CAPTURE(rank_count);
  const auto render_here = [&](nodes::Fabric& fabric) {
    const auto render = [&](nodes::RankLinks& links) {
      RenderOptions here = options;
      here.computer.ranks = &links;
      look(Watched(here));
      return 0;
    };
    return render_as_rank(fabric, options, render, {});
  };
  for (const auto& result : tests::on_ranks(rank_count, {}, render_here, nodes::frame_bytes_for(payload_bytes_max(options)))) {
    CHECK(result.failure_text() == "");
    CHECK(result.value == 0);
  }
}

RenderOptions heated(Strategy strategy, std::initializer_list<const char*> kinds) {
  RenderOptions options = strategy == Strategy::svm ? starved(small()) : small(strategy);
  options.computer.node_count = 5;
  for (const char* const kind : kinds) {
    options.heat_maps.push_back(parse_heat_request(std::string(kind) + ":heat.exr"));
  }
  return options;
}

std::vector<std::uint64_t> values(const Watched& watched, HeatKind kind) {
  const auto values = watched.heat->values(kind);
  return {values.begin(), values.end()};
}

std::uint64_t quanta_of(const Account& account) {
  std::uint64_t quanta = account.host.quanta;
  for (const NodeAccount& node : account.nodes) {
    quanta += node.counters.quanta;
  }
  return quanta;
}

RenderOptions traced(Strategy strategy) {
  RenderOptions options = strategy == Strategy::svm ? starved(small()) : small(strategy);
  options.computer.node_count = 5;
  options.trace.path = "trace.pftrace";
  return options;
}

std::uint64_t count_of(const nodes::Trace& trace, nodes::Activity activity) {
  std::uint64_t count = 0;
  for (const nodes::TraceNode& node : trace.nodes) {
    count += static_cast<std::uint64_t>(
        std::count_if(node.spans.begin(), node.spans.end(), [&](const auto& span) { return span.activity == activity; }));
  }
  return count;
}

std::uint64_t clock_error_ns(const Watched& watched) {
  std::uint64_t error_ns = 0;
  for (const nodes::RankFigures& rank : account_of(*watched.report).ranks) {
    error_ns = std::max(error_ns, rank.clock.error_ns());
  }
  return error_ns;
}

}  // namespace

TEST_CASE("heat that another run repeats is the same over ranks, for every strategy") {
  for (const Strategy strategy : {Strategy::svm, Strategy::replicated, Strategy::dataflow, Strategy::forest}) {
    CAPTURE(name_of(strategy));
    const bool paged = strategy == Strategy::svm;
    const RenderOptions options =
        paged ? heated(strategy, {"rays", "depth", "references", "pages"}) : heated(strategy, {"rays", "depth"});
    const Watched alone(options);
    for (const std::uint32_t ranks : rank_counts) {
      watch_over(ranks, options, [&](const Watched& watched) {
        for (const HeatKind kind : kinds_of(options.heat_maps)) {
          CAPTURE(name_of(kind));
          CHECK(values(watched, kind) == values(alone, kind));
        }
        CHECK(watched.heat->sum(HeatKind::rays) == account_of(*watched.report).operations.ray_count());
      });
    }
  }
}

TEST_CASE("where pixels stay and wait alone, faults and nodes of pixels are the same over ranks, too, and add up") {
  RenderOptions options = heated(Strategy::svm, {"faults", "node", "time"});
  options.pages.work_item_side = 0;
  options.pages.in_flight = 1;
  const Watched alone(options);
  for (const std::uint32_t ranks : rank_counts) {
    watch_over(ranks, options, [&](const Watched& watched) {
      CHECK(values(watched, HeatKind::faults) == values(alone, HeatKind::faults));
      CHECK(values(watched, HeatKind::node) == values(alone, HeatKind::node));
      CHECK(watched.heat->sum(HeatKind::faults) == std::get<svm::Report>(*watched.report).pages().faults);
      CHECK(watched.heat->sum(HeatKind::time) > 0);
    });
  }
}

TEST_CASE("over ranks each pixel is done once, within the run") {
  for (const Strategy strategy : {Strategy::svm, Strategy::dataflow}) {
    for (const std::uint32_t ranks : rank_counts) {
      const auto before = std::chrono::steady_clock::now();
      watch_over(ranks, heated(strategy, {}), [&](const Watched& watched) {
        const auto gone = std::chrono::steady_clock::now() - before;
        const auto gone_ns = static_cast<std::uint64_t>(std::chrono::nanoseconds(gone).count());
        const std::vector<std::uint64_t> done = values(watched, HeatKind::done);
        CHECK(done.size() == 16 * 12);
        CHECK(std::count(done.begin(), done.end(), 0U) == 0);
        CHECK(*std::max_element(done.begin(), done.end()) <= gone_ns + clock_error_ns(watched));
      });
    }
  }
}

TEST_CASE("a trace over ranks has every quantum and every packet, and none is received before it is sent") {
  for (const Strategy strategy : {Strategy::svm, Strategy::dataflow}) {
    for (const std::uint32_t ranks : rank_counts) {
      watch_over(ranks, traced(strategy), [&](const Watched& watched) {
        const nodes::Trace& trace = *watched.run_profile.trace;
        const Account account = account_of(*watched.report);
        REQUIRE(trace.nodes.size() == 6);
        CHECK(trace.events_lost == 0);
        CHECK(count_of(trace, nodes::Activity::work) == quanta_of(account));
        CHECK(count_of(trace, nodes::Activity::receive) == nodes::total(account.sent).packets);
        CHECK(trace.messages.size() == nodes::total(account.sent).packets);
        CHECK(trace.moved_ns_max <= 2 * clock_error_ns(watched));
        for (const nodes::TraceMessage& message : trace.messages) {
          REQUIRE(message.sent_ns <= message.received_ns);
        }
        for (const nodes::TraceNode& node : trace.nodes) {
          CHECK_FALSE(node.level_names.empty());
        }
      });
    }
  }
}

TEST_CASE("a trace over ranks says how far its clocks may be compared, one of a single process does not") {
  const auto text = [](const Watched& watched) {
    RenderRecord record = watched.record();
    record.trace = &*watched.run_profile.trace;
    std::ostringstream stream;
    write_trace(record, stream);
    return stream.str();
  };
  const std::string words = "of 3 ranks, compared with that of rank 0 before and after the run: wrong by ";
  watch_over(3, traced(Strategy::svm), [&](const Watched& watched) { CHECK(contains(text(watched), words)); });
  CHECK_FALSE(contains(text(Watched(traced(Strategy::svm))), "clocks"));
}

TEST_CASE("a page over ranks has every fetch, reference and activity of all nodes") {
  RenderOptions options = starved(small());
  options.computer.node_count = 5;
  options.pages.work_item_side = 0;  // else the clock would say which node renders what
  options.pages.in_flight = 1;
  for (const std::uint32_t ranks : rank_counts) {
    watch_over(ranks, options, [&](const Watched& watched) {
      const svm::PageCounters pages = std::get<svm::Report>(*watched.report).pages();
      const svm::Fetches& fetches = *watched.view().fetches;
      CHECK(pages.faults > 20);
      CHECK(std::accumulate(fetches.by_pair.begin(), fetches.by_pair.end(), std::uint64_t{0}) == pages.faults);
      CHECK(std::accumulate(fetches.by_page.begin(), fetches.by_page.end(), std::uint64_t{0}) == pages.faults);
      CHECK(fetches.sample.size() == pages.faults);
      REQUIRE(watched.view().misses);
      CHECK(watched.view().misses->misses(4) == static_cast<double>(pages.faults));
      REQUIRE(watched.view().steps.nodes.size() == 6);
      for (std::size_t node = 0; node < 5; ++node) {
        CHECK_FALSE(watched.view().steps.nodes[node].empty());
      }
    });
  }
}

TEST_CASE("over ranks a file of references has those of every node, and all of them") {
  RenderOptions options = starved(small());
  options.computer.node_count = 5;
  options.references = "references.csv";
  for (const std::uint32_t rank_count : rank_counts) {
    watch_over(rank_count, options, [&](const Watched& watched) {
      REQUIRE(watched.run_profile.references.size() == 5);
      for (const svm::ReferenceLog& log : watched.run_profile.references) {
        CHECK(log.every() == 1);
        CHECK_FALSE(log.pages().empty());
      }
    });
  }
}

}  // namespace dmpc::apps::watched_over_ranks_test
