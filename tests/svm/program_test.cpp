#include "svm/program.h"

#include <doctest/doctest.h>

#include "svm/local_copy.h"
#include "svm/pages/observers/observed_pagers.h"
#include "svm/pages/pager.h"
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

}  // namespace svm_program_test
