// Frames on several ranks: what nodes elsewhere have is kept for the next picture, as what nodes here have is.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "dataflow/frames.h"
#include "dataflow/ranks.h"
#include "nodes/ranks/dismissal.h"
#include "nodes/ranks/rank_links.h"
#include "svm/forest/strategy.h"
#include "svm/frames.h"
#include "svm/ranks.h"
#include "tests/support/loopback_ranks.h"
#include "tests/support/walk.h"

namespace frames_on_ranks_test {

namespace {

using namespace dmpc;
using tests::Walk;

/// The last frame is the first again.
Walk there_and_back(const core::BuildOptions& build = {.page_size_bytes = 512}) { return Walk(24, build, {0, 0.02, 0.04, 0}); }

/// What one frame came to.
struct Seen {
  std::uint64_t film = 0, faults = 0, rays = 0, packets = 0;
  bool operator==(const Seen&) const = default;
};

template <class Report>
std::uint64_t packets_between_ranks(const Report& report) {
  std::uint64_t sent = 0;
  for (const nodes::RankFigures& rank : report.ranks) {
    sent += rank.traffic.packets_sent;
  }
  return sent;
}

std::vector<Seen> by_pages(const svm::Strategy& strategy, const Walk& walk, nodes::RankLinks* links) {
  svm::RunOptions options{.computer = {.node_count = 5, .ranks = links}, .pages = {.in_flight = 1, .work_item_side = 0}};
  if (&strategy == svm::svm_strategy()) {
    options.pages.cache_pages = 40;
  }
  svm::Frames frames(strategy, walk.database, walk.frames[0], options, {});
  std::vector<Seen> seen;
  for (const core::RenderSettings& frame : walk.frames) {
    const svm::Report report = frames.render(frame, {});
    seen.push_back({report.film.hash(), report.pages().faults, report.operations().ray_count(), packets_between_ranks(report)});
  }
  return seen;
}

std::vector<Seen> by_rays(const Walk& walk, nodes::RankLinks* links) {
  const dataflow::RunOptions options{.computer = {.node_count = 5, .ranks = links}, .are_frames = true};
  const dataflow::Prepared prepared = dataflow::prepare(walk.database, walk.frames[0], options);
  dataflow::Frames frames(prepared, walk.frames[0], options, {});
  std::vector<Seen> seen;
  for (std::size_t i = 0; i < walk.frames.size(); ++i) {
    const dataflow::Report report = i == 0 ? frames.render({}) : frames.render(walk.frames[i], {}, {});
    seen.push_back({report.film.hash(), 0, report.operations().ray_count(), packets_between_ranks(report)});
  }
  return seen;
}

/// What rank 0 has seen; the others are dismissed at the end, and have had nothing to say.
template <class Lead, class Follow>
std::vector<Seen> on_ranks(std::uint32_t rank_count, const Lead& lead, const Follow& follow) {
  const auto results = tests::on_ranks(rank_count, {}, [&](nodes::Fabric& fabric) {
    nodes::RankLinks links(fabric);
    std::vector<Seen> seen;
    if (fabric.rank() == 0) {
      seen = lead(links);
      nodes::dismiss(links, 0);
      return seen;
    }
    try {
      follow(links);
    } catch (const nodes::Dismissed&) {
    }
    return seen;
  });
  for (const auto& result : results) {
    CHECK(result.failure_text() == "");
  }
  return results.front().value.value();
}

std::vector<Seen> pages_on_ranks(std::uint32_t rank_count, const svm::Strategy& strategy, const Walk& walk) {
  return on_ranks(
      rank_count, [&](nodes::RankLinks& links) { return by_pages(strategy, walk, &links); },
      [](nodes::RankLinks& links) {
        svm::WorkerCallbacks callbacks;
        callbacks.strategies.push_back(svm::forest_strategy());
        svm::follow(links, {}, callbacks);
      });
}

std::vector<Seen> rays_on_ranks(std::uint32_t rank_count, const Walk& walk) {
  return on_ranks(
      rank_count, [&](nodes::RankLinks& links) { return by_rays(walk, &links); },
      [](nodes::RankLinks& links) { dataflow::follow(links, {}); });
}

/// Except for packets between ranks, of which one process has none.
std::vector<Seen> without_packets(std::vector<Seen> seen) {
  for (Seen& one : seen) {
    one.packets = 0;
  }
  return seen;
}

}  // namespace

TEST_CASE("frames on ranks have the films, rays and page faults of those in one process, by every strategy") {
  const Walk walk = there_and_back(), tree = there_and_back({.page_size_bytes = 512, .structure = core::Structure::extents});
  for (const std::uint32_t ranks : {1U, 2U, 5U}) {
    CAPTURE(ranks);
    for (const svm::Strategy* const strategy : {svm::svm_strategy(), svm::replicated_strategy(), svm::forest_strategy()}) {
      CAPTURE(strategy->name());
      const Walk& of = strategy == svm::forest_strategy() ? tree : walk;
      CHECK(without_packets(pages_on_ranks(ranks, *strategy, of)) == by_pages(*strategy, of, nullptr));
    }
    CHECK(without_packets(rays_on_ranks(ranks, walk)) == by_rays(walk, nullptr));
  }
}

TEST_CASE("what is counted on ranks is a frame's own: the caches stay warm elsewhere, too, and fewer pages travel") {
  const Walk walk = there_and_back();
  const std::vector<Seen> seen = pages_on_ranks(3, *svm::svm_strategy(), walk);
  REQUIRE(seen.size() == 4);
  CHECK(seen[0].faults > 0);
  CHECK(seen[1].faults < seen[0].faults);
  CHECK(seen[1].packets < seen[0].packets);
  CHECK(seen[3].film == seen[0].film);
}

TEST_CASE("nodes that begin anew after frames are made of another job, by the same ranks") {
  const Walk walk = there_and_back(), other = there_and_back({.page_size_bytes = 1024});
  const std::vector<Seen> first = by_pages(*svm::svm_strategy(), walk, nullptr),
                          second = by_pages(*svm::svm_strategy(), other, nullptr);
  std::vector<Seen> again;
  const std::vector<Seen> seen = on_ranks(
      3,
      [&](nodes::RankLinks& links) {
        const std::vector<Seen> before = by_pages(*svm::svm_strategy(), walk, &links);
        again = by_pages(*svm::svm_strategy(), other, &links);
        return before;
      },
      [](nodes::RankLinks& links) { svm::follow(links, {}); });
  CHECK(without_packets(seen) == first);
  CHECK(without_packets(again) == second);
}

}  // namespace frames_on_ranks_test
