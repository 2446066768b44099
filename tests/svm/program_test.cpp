#include "svm/program.h"

#include <doctest/doctest.h>

#include "core/picture/memory_use.h"
#include "svm/local_copy.h"
#include "svm/pages/pager.h"
#include "svm/pages/watch/watched_pagers.h"
#include "svm/run.h"
#include "tests/support/small_machine.h"

namespace svm_program_test {

using namespace dmpc;
using namespace dmpc::tests;

namespace {

constexpr std::uint32_t side = 12;

svm::PlanRequest request_with(std::uint32_t nodes, std::size_t page_size, std::uint32_t page_count) {
  return {.page_count = page_count,
          .page_size_bytes = page_size,
          .computer = {.node_count = nodes},
          .width = side,
          .height = side,
          .first_samples = 2};
}

svm::MakeProgram maker(const svm::Plan& plan, const core::RenderSettings& settings, const FakePages& pages) {
  return [&](std::uint32_t, nodes::Node& node) {
    return plan.request.strategy == svm::replicated_strategy() ? fake_program<svm::LocalCopy>(node, plan, settings, pages)
           : plan.request.pages.count_pages                    ? fake_program<svm::CountingPager>(node, plan, settings, pages)
                                                               : fake_program<svm::Pager>(node, plan, settings, pages);
  };
}

/// On the threads runner, whose end checks every law of conservation.
svm::Report run_on_threads(const svm::PlanRequest& request) {
  const FakePages pages(request.page_count, request.page_size_bytes);
  const core::RenderSettings settings = fake_settings(request.width, request.height);
  const svm::Plan plan = svm::make_plan(request);
  svm::Report report = svm::run_programs(plan, maker(plan, settings, pages), {}, {});
  CHECK(report.film.hash() == fake_reference(pages, settings).hash());
  return report;
}

/// In a random legal order.
void run_shuffled(const svm::PlanRequest& request, std::uint64_t seed) {
  const FakePages pages(request.page_count, request.page_size_bytes);
  const core::RenderSettings settings = fake_settings(request.width, request.height);
  const svm::Plan plan = svm::make_plan(request);
  core::Film film(settings.camera.width(), settings.camera.height());
  const svm::MakeProgram make_program = maker(plan, settings, pages);
  const nodes::Progress progress;
  ShuffledComputer computer(svm::specifications_of(plan, make_program, film, progress), seed);
  CAPTURE(seed);
  computer.run();
  REQUIRE(film.hash() == fake_reference(pages, settings).hash());
}

}  // namespace

TEST_CASE("every number of nodes, page size, cache, pixels in flight and work item gives the same film") {
  const std::uint32_t sides[] = {0, 1, 3, 16};
  const std::size_t page_sizes[] = {512, 1024, 4096, 65536};
  std::size_t turn = 0;
  for (const std::uint32_t nodes : {1U, 2U, 3U, 7U, 8U}) {
    for (const std::uint32_t in_flight : {1U, 64U}) {
      for (const std::uint32_t cache_pages : {1U, 5U, 1000U}) {
        svm::PlanRequest request = request_with(nodes, page_sizes[turn % 4], turn % 4 == 3 ? 9 : 50);
        request.pages.in_flight = in_flight;
        request.pages.cache_pages = cache_pages;
        request.pages.work_item_side = sides[(turn / 4 + turn) % 4];
        INFO("nodes ", nodes, ", in_flight ", in_flight, ", cache_pages ", cache_pages, ", page_size_bytes ",
             request.page_size_bytes, ", work_item_side ", request.pages.work_item_side);
        run_on_threads(request);
        ++turn;
      }
    }
  }
}

TEST_CASE("any legal order of packets and quanta gives the same film, and no mailbox overflows") {
  const std::uint32_t sides[] = {0, 1, 3, 16};
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    svm::PlanRequest request = request_with(static_cast<std::uint32_t>(1 + seed % 9), 512, 30);
    request.pages.in_flight = seed % 3 == 0 ? 1 : seed % 3 == 1 ? 5 : 64;
    request.pages.cache_pages = seed % 2 == 0 ? 1 : 6;
    request.pages.work_item_side = sides[seed / 9 % 4];
    run_shuffled(request, seed);
  }
}

TEST_CASE("replicated gives the same film without a page travelling") {
  for (const std::uint32_t nodes : {1U, 3U, 8U}) {
    svm::PlanRequest request = request_with(nodes, 1024, 20);
    request.strategy = svm::replicated_strategy();
    request.pages.in_flight = nodes == 3 ? 4 : 1;
    const svm::Report report = run_on_threads(request);
    CHECK(report.pages().references == 0);
    CHECK(report.sent()[svm::number_of(svm::Kind::page_request)].packets == 0);
    run_shuffled(request, nodes);
  }
}

TEST_CASE("more nodes than pixels, a picture of one pixel, a database of one page") {
  svm::PlanRequest request = request_with(40, 512, 3);
  request.width = 5;
  request.height = 3;
  run_on_threads(request);
  request.width = request.height = 1;
  request.page_count = 1;
  const svm::Report report = run_on_threads(request);
  CHECK(report.work().pixels_rendered == 1);
}

TEST_CASE("one node alone finds every page at home and asks nobody") {
  const svm::Report report = run_on_threads(request_with(1, 1024, 20));
  CHECK(report.pages().references == report.pages().home_hits);
  CHECK(report.pages().references > 0);
  CHECK(report.work().items_asked == 0);
  CHECK(report.plan.frames == 0);
}

TEST_CASE("references are counted once, however often their pages are evicted") {
  svm::PlanRequest request = request_with(4, 512, 40);
  request.pages.work_item_side = 0;
  const std::uint64_t references = run_on_threads(request).pages().references;
  for (const std::uint32_t in_flight : {1U, 8U, 64U}) {
    request.pages.in_flight = in_flight;
    request.pages.cache_pages = 1;
    const svm::PageCounters pages = run_on_threads(request).pages();
    CHECK(pages.references == references);
    CHECK(pages.references == pages.home_hits + pages.cache_hits + pages.misses);
    CHECK(pages.faults <= pages.misses);
    CHECK((in_flight > 1 || pages.faults == pages.misses));
  }
}

TEST_CASE("with one pixel in flight and static submaps the counters repeat exactly") {
  svm::PlanRequest request = request_with(5, 512, 60);
  request.pages.in_flight = 1;
  request.pages.cache_pages = 7;
  request.pages.work_item_side = 0;
  const svm::PageCounters first = run_on_threads(request).pages();
  const svm::PageCounters second = run_on_threads(request).pages();
  CHECK(first.faults == second.faults);
  CHECK(first.evictions == second.evictions);
  CHECK(first.cache_hits == second.cache_hits);
}

TEST_CASE("distinct pages do not depend on cache or pixels in flight") {
  svm::PlanRequest request = request_with(3, 512, 70);
  request.pages.count_pages = true;
  const svm::PageCounters pages = run_on_threads(request).pages();
  CHECK(pages.distinct_pages > 0);
  CHECK(pages.distinct_pages < pages.references);
  request.pages.cache_pages = 1;
  request.pages.in_flight = 1;
  CHECK(run_on_threads(request).pages().distinct_pages == pages.distinct_pages);
}

TEST_CASE("a node uses exactly the memory of its plan, in every category") {
  for (const svm::Strategy* const strategy : {svm::svm_strategy(), svm::replicated_strategy()}) {
    for (const bool count_pages : {false, true}) {
      svm::PlanRequest request = request_with(3, 1024, 25);
      request.strategy = strategy;
      request.pages.count_pages = count_pages && strategy == svm::svm_strategy();
      for (const svm::NodeReport& node : run_on_threads(request).nodes) {
        if (node.memory_used.bytes != node.memory_planned.bytes) {
          // A fake task is smaller than a real one, for which memory is planned.
          CHECK(node.memory_used[core::MemoryUse::ray_stacks] < node.memory_planned[core::MemoryUse::ray_stacks]);
          CHECK(node.memory_planned.total() - node.memory_used.total() ==
                node.memory_planned[core::MemoryUse::ray_stacks] - node.memory_used[core::MemoryUse::ray_stacks]);
        }
      }
    }
  }
}

TEST_CASE("a stop request interrupts the run") {
  const svm::PlanRequest request = request_with(4, 512, 40);
  const FakePages pages(request.page_count, request.page_size_bytes);
  const core::RenderSettings settings = fake_settings(side, side);
  const svm::Plan plan = svm::make_plan(request);
  std::stop_source source;
  source.request_stop();
  const svm::Report report = svm::run_programs(plan, maker(plan, settings, pages), {}, source.get_token());
  CHECK(report.end == nodes::RunEnd::interrupted);
}

TEST_CASE("progress ends with every pixel") {
  const svm::PlanRequest request = request_with(4, 512, 40);
  const FakePages pages(request.page_count, request.page_size_bytes);
  const core::RenderSettings settings = fake_settings(side, side);
  const svm::Plan plan = svm::make_plan(request);
  std::uint32_t last = 0;
  bool grew = true;
  const auto progress = [&](std::uint32_t done, std::uint32_t total) {
    grew = grew && done > last && done <= total;
    last = done;
  };
  svm::run_programs(plan, maker(plan, settings, pages), {.watching = {.progress = progress}}, {});
  CHECK(grew);
  CHECK(last == side * side);
}

}  // namespace svm_program_test
