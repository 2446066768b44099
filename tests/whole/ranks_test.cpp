// One picture on several ranks, too, of which rank 0 alone has the scene: the same node programs over the loopback fabric.
#include <doctest/doctest.h>

#include <cstdint>
#include <exception>
#include <optional>
#include <stop_token>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/expect.h"
#include "core/picture/film/partial_picture.h"
#include "dataflow/ranks.h"
#include "nodes/byte_source.h"
#include "nodes/ranks/dismissal.h"
#include "nodes/ranks/failure.h"
#include "nodes/ranks/rank_links.h"
#include "nodes/ranks/ranks_runner.h"
#include "svm/ranks.h"
#include "tests/support/base_mesh_scenes.h"
#include "tests/support/loopback_ranks.h"
#include "tests/support/scaled.h"
#include "tests/support/small_scenes.h"
#include "tests/support/strategies.h"
#include "tests/support/subject.h"

namespace ranks_test {

namespace {

using namespace dmpc;
using tests::outcome_of;
using tests::scaled_edge;
using tests::Subject;

constexpr std::uint32_t rank_counts[] = {1, 2, 3, 5};

/// What has come of a run: the report of rank 0, and the bytes that each other rank was sent before it.
template <class Report>
struct OnRanks {
  Report report;
  std::vector<std::uint64_t> bytes_received;
};

/// Rank 0 calls render(computer), the others follow(links), which is that of its strategy.
template <class Render, class Follow>
auto on_ranks(std::uint32_t rank_count, std::uint32_t node_count, const Render& render, const Follow& follow) {
  using Report = std::invoke_result_t<const Render&, nodes::ComputerRequest>;
  struct Result {
    std::optional<Report> report;
    std::uint64_t bytes_received = 0;
  };
  auto results = tests::on_ranks(rank_count, {}, [&](nodes::Fabric& fabric) {
    nodes::RankLinks links(fabric);
    Result result;
    if (fabric.rank() == 0) {
      result.report.emplace(render(nodes::ComputerRequest{.node_count = node_count, .ranks = &links}));
    } else {
      result.bytes_received = follow(links, {}).bytes_received;
    }
    return result;
  });
  std::vector<std::uint64_t> bytes_received;
  for (const auto& result : results) {
    CHECK(result.failure_text() == "");
    bytes_received.push_back(result.value.value().bytes_received);
  }
  return OnRanks<Report>{std::move(*results.front().value->report), std::move(bytes_received)};
}

constexpr auto follow_pages = [](nodes::RankLinks& links, std::stop_token stop) {
  svm::WorkerCallbacks callbacks;
  callbacks.strategies.push_back(svm::forest_strategy());
  return svm::follow(links, std::move(stop), callbacks);
};
constexpr auto follow_rays = [](nodes::RankLinks& links, std::stop_token stop) {
  return dataflow::follow(links, std::move(stop));
};

template <class Render>
auto pages_on_ranks(std::uint32_t rank_count, std::uint32_t node_count, const Render& render) {
  return on_ranks(rank_count, node_count, render, follow_pages);
}
template <class Render>
auto rays_on_ranks(std::uint32_t rank_count, std::uint32_t node_count, const Render& render) {
  return on_ranks(rank_count, node_count, render, follow_rays);
}

Subject subject_of(const core::Scene& scene) {
  return Subject(scene, {.width = scaled_edge(40), .height = scaled_edge(32), .samples = 2}, {.page_size_bytes = 1024});
}

TEST_CASE("every strategy gives one picture on any number of ranks, and the reports of all nodes") {
  for (const core::Scene& scene : {tests::mirrors_and_glass(), tests::built_in("gears-1")}) {
    const Subject subject = subject_of(scene);
    for (const std::uint32_t ranks : rank_counts) {
      for (const std::uint32_t nodes : {5U, 7U, 16U}) {
        CAPTURE(scene.name);
        CAPTURE(ranks);
        CAPTURE(nodes);
        const auto svm = pages_on_ranks(ranks, nodes, [&](const nodes::ComputerRequest& computer) {
                           return run_svm(subject, {.computer = computer, .pages = {.cache_pages = 3}});
                         }).report;
        CHECK(outcome_of(svm) == subject.outcome());
        CHECK(svm.nodes.size() == nodes);
        const auto replicated = pages_on_ranks(ranks, nodes, [&](const nodes::ComputerRequest& computer) {
                                  return run_replicated(subject, {.computer = computer});
                                }).report;
        CHECK(outcome_of(replicated) == subject.outcome());
        const auto dataflow = rays_on_ranks(ranks, nodes, [&](const nodes::ComputerRequest& computer) {
                                return run_dataflow(subject, {.computer = computer});
                              }).report;
        CHECK(outcome_of(dataflow) == subject.outcome());
        CHECK(dataflow.nodes.size() == nodes);
      }
    }
  }
}

TEST_CASE("questions travel between ranks, and samples follow where a pass before has found the picture uneven") {
  const core::Scene scene = tests::mirrors_and_glass();
  const Subject tree(scene, {.width = scaled_edge(24), .height = scaled_edge(20)},
                     {.page_size_bytes = 1024, .structure = core::Structure::extents});
  const Subject refined(scene, {.width = 12, .height = 9, .samples = 2, .refinement = {.error = 0.03}},
                        {.page_size_bytes = 1024});
  const core::Scene balls = tests::balls_in_places(0.3, tests::Arrangement::apart, 21);
  const Subject kept(balls, {.width = scaled_edge(24), .height = scaled_edge(20)}, tests::with_instances());
  REQUIRE(kept.database().records().instances > 0);
  for (const std::uint32_t ranks : rank_counts) {
    CAPTURE(ranks);
    for (const Subject* const subject : {&tree, &kept}) {
      const auto forest = pages_on_ranks(
          ranks, 7, [&](const nodes::ComputerRequest& computer) { return run_forest(*subject, {.computer = computer}); });
      CHECK(outcome_of(forest.report) == subject->outcome());
    }
    const auto svm = pages_on_ranks(
        ranks, 7, [&](const nodes::ComputerRequest& computer) { return run_svm(refined, {.computer = computer}); });
    CHECK(outcome_of(svm.report) == refined.outcome());
    const auto dataflow = rays_on_ranks(
        ranks, 7, [&](const nodes::ComputerRequest& computer) { return run_dataflow(refined, {.computer = computer}); });
    CHECK(outcome_of(dataflow.report) == refined.outcome());
  }
}

TEST_CASE("what a run has left undone is done on ranks, by any strategy, to the same picture") {
  const Subject subject = subject_of(tests::mirrors_and_glass());
  std::optional<core::PartialPicture> half;
  const auto keep = [&](const core::Film& film, const core::Refinement& pass, const core::PixelMask& done) {
    half = core::partial_picture(film, pass, done);
  };
  run_svm(subject, {.computer = {.node_count = 3}, .continuation = {.is_due = [&] { return !half; }, .keep = keep}});
  REQUIRE(half);
  REQUIRE(half->done.count() > 0);
  REQUIRE(half->missing().count() > 0);
  const core::Continuation continuation{.start = &*half};
  for (const std::uint32_t ranks : {2U, 5U}) {
    CAPTURE(ranks);
    const auto svm = pages_on_ranks(ranks, 7, [&](const nodes::ComputerRequest& computer) {
      return run_svm(subject, {.computer = computer, .continuation = continuation});
    });
    CHECK(svm.report.film.hash() == subject.outcome().film_hash);
    CHECK(svm.report.pixels_done == half->missing().count());
    const auto replicated = pages_on_ranks(ranks, 7, [&](const nodes::ComputerRequest& computer) {
      return run_replicated(subject, {.computer = computer, .continuation = continuation});
    });
    CHECK(replicated.report.film.hash() == subject.outcome().film_hash);
    const auto dataflow = rays_on_ranks(ranks, 7, [&](const nodes::ComputerRequest& computer) {
      return run_dataflow(subject, {.computer = computer, .continuation = continuation});
    });
    CHECK(dataflow.report.film.hash() == subject.outcome().film_hash);
  }
}

TEST_CASE("a rank is sent the pages of its nodes and no others, and who has no nodes' pages has none of the scene") {
  const Subject subject = subject_of(tests::built_in("gears-1"));
  const std::size_t page_bytes = subject.database().page_size();
  constexpr std::uint32_t ranks = 3, nodes = 7;
  const auto bytes_received = [&](svm::PageOptions pages) {
    return pages_on_ranks(
               ranks, nodes,
               [&](const nodes::ComputerRequest& computer) { return run_svm(subject, {.computer = computer, .pages = pages}); })
        .bytes_received;
  };
  const std::vector<std::uint64_t> spread = bytes_received({}), none = bytes_received({.homes = svm::PageHomes::host});
  std::vector<std::uint64_t> pages(ranks);
  for (std::size_t page = 0; page < subject.database().page_count(); ++page) {
    ++pages[nodes::rank_of(static_cast<std::uint32_t>(page % nodes), nodes, ranks)];
  }
  for (std::uint32_t rank = 1; rank < ranks; ++rank) {
    CAPTURE(rank);
    CHECK(none[rank] < 2 * sizeof(core::RenderSettings));
    CHECK(spread[rank] - none[rank] == pages[rank] * (sizeof(nodes::PieceHeader) + page_bytes));
  }
}

TEST_CASE("a rank is sent the parts of its nodes' regions, and with strategy replicated a whole scene for each node") {
  const Subject subject = subject_of(tests::built_in("gears-1"));
  constexpr std::uint32_t ranks = 3, nodes = 7;
  const auto rays = rays_on_ranks(
      ranks, nodes, [&](const nodes::ComputerRequest& computer) { return run_dataflow(subject, {.computer = computer}); });
  const auto whole = pages_on_ranks(
      ranks, nodes, [&](const nodes::ComputerRequest& computer) { return run_replicated(subject, {.computer = computer}); });
  for (std::uint32_t rank = 1; rank < ranks; ++rank) {
    CAPTURE(rank);
    std::size_t part_bytes = 0, node_count = 0, assigned_bytes = 0;
    for (std::uint32_t node = 0; node < nodes; ++node) {
      if (nodes::rank_of(node, nodes, ranks) == rank) {
        ++node_count;
        part_bytes += rays.report.nodes[node].part_bytes + core::overread_bytes;
        assigned_bytes += rays.report.plan.request.shares[node].primary_runs * sizeof(dataflow::PrimaryRun);
      }
    }
    const std::size_t proxy_bytes = rays.report.plan.request.shares.front().proxy_bytes;
    CHECK(rays.bytes_received[rank] >= part_bytes + assigned_bytes + proxy_bytes);
    CHECK(rays.bytes_received[rank] < part_bytes + assigned_bytes + proxy_bytes + std::size_t{64 << 10U});
    CHECK(whole.bytes_received[rank] >= node_count * subject.database().bytes().size());
    CHECK(whole.bytes_received[rank] < node_count * subject.database().bytes().size() + std::size_t{16 << 10U});
  }
}

TEST_CASE("what each rank sets aside and what went between them is told, the same for what is sent and what is received") {
  const Subject subject = subject_of(tests::mirrors_and_glass());
  constexpr std::uint32_t nodes = 7;
  const auto check_ranks = [&](const auto& report, std::uint32_t ranks) {
    REQUIRE(report.ranks.size() == ranks);
    std::uint32_t nodes_seen = 0;
    std::uint64_t packets = 0;
    for (std::uint32_t rank = 0; rank < ranks; ++rank) {
      CHECK(report.ranks[rank].name == "rank " + std::to_string(rank));
      CHECK(report.ranks[rank].memory.has_host == (rank == 0));
      CHECK((report.ranks[rank].memory.network.outbox_bytes > 10'000) == (ranks > 1));
      nodes_seen += report.ranks[rank].memory.node_count;
      packets += report.ranks[rank].traffic.packets_sent;
    }
    CHECK(nodes_seen == nodes);
    CHECK((packets > 0) == (ranks > 1));
  };
  for (const std::uint32_t ranks : rank_counts) {
    CAPTURE(ranks);
    check_ranks(pages_on_ranks(ranks, nodes,
                               [&](const nodes::ComputerRequest& computer) { return run_svm(subject, {.computer = computer}); })
                    .report,
                ranks);
    check_ranks(
        rays_on_ranks(ranks, nodes,
                      [&](const nodes::ComputerRequest& computer) { return run_dataflow(subject, {.computer = computer}); })
            .report,
        ranks);
  }
  CHECK(run_svm(subject, {}).ranks.empty());
}

TEST_CASE("a rank that has no room ends all before anything is rendered, and is named") {
  const Subject subject(tests::mirrors_and_glass(), {.width = 4, .height = 4});
  const auto check_refusal = [&](const auto& render, const auto& follow) {
    const auto results = tests::on_ranks(3, {}, [&](nodes::Fabric& fabric) {
      nodes::RankLinks links(fabric);
      if (fabric.rank() == 0) {
        CHECK_THROWS_WITH_AS(render(nodes::ComputerRequest{.node_count = 7, .ranks = &links}), "rank 2: no room for 2 nodes",
                             core::CapacityError);
        nodes::dismiss(links, 4);
        return 4;
      }
      svm::WorkerCallbacks callbacks;
      callbacks.check_room = [&](const nodes::RankMemory& memory) {
        if (fabric.rank() == 2) {
          throw core::CapacityError("no room for " + std::to_string(memory.node_count) + " nodes");
        }
      };
      try {
        follow(links, {}, callbacks);
      } catch (const nodes::Dismissed& dismissed) {
        return dismissed.status;
      } catch (...) {
        nodes::say_failure(links, nodes::failure_of(std::current_exception()));
      }
      return nodes::wait_for_dismissal(links);
    });
    for (const auto& result : results) {
      CHECK(result.value == 4);
    }
  };
  check_refusal([&](const nodes::ComputerRequest& computer) { return run_svm(subject, {.computer = computer}); }, svm::follow);
  check_refusal([&](const nodes::ComputerRequest& computer) { return run_dataflow(subject, {.computer = computer}); },
                dataflow::follow);
}

TEST_CASE("fewer nodes than ranks are refused by every strategy's plan") {
  const Subject subject(tests::mirrors_and_glass(), {.width = 4, .height = 4});
  const auto results = tests::on_ranks(4, {}, [&](nodes::Fabric& fabric) {
    nodes::RankLinks links(fabric);
    const nodes::ComputerRequest computer{.node_count = 3, .ranks = &links};
    const char* const sentence = "node_count=3: expected at least one node for each of the 4 ranks";
    CHECK_THROWS_WITH_AS(run_svm(subject, {.computer = computer}), sentence, core::UsageError);
    CHECK_THROWS_WITH_AS(run_dataflow(subject, {.computer = computer}), sentence, core::UsageError);
    return true;
  });
  CHECK(results.front().failure_text() == "");
}

}  // namespace

}  // namespace ranks_test
