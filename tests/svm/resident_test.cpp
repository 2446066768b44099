#include "svm/resident.h"

#include <doctest/doctest.h>

#include <map>
#include <stop_token>

#include "svm/run.h"
#include "tests/support/built_scene.h"

namespace resident_test {

using namespace dmpc;
using svm::PageId;
using tests::BuiltScene;

TEST_CASE("what a small picture uses most comes first, as often as it is looked up, and each page once") {
  // The small picture of 8x8 pixels is the picture of one pixel.
  const BuiltScene one("rings-2", 512, 8);
  const auto count = static_cast<std::uint32_t>(one.database.page_count());
  const std::vector<PageId> pages = svm::most_used_pages(one.database, one.settings, count);
  REQUIRE(pages.size() == count);
  std::map<PageId, int> times;
  for (const PageId page : pages) {
    ++times[page];
  }
  CHECK(times.size() == count);
  const std::vector<PageId> fewer = svm::most_used_pages(one.database, one.settings, 5);
  CHECK(fewer == std::vector<PageId>(pages.begin(), pages.begin() + 5));
}

TEST_CASE("the pages that a picture uses are among those that come first for it") {
  const BuiltScene small("rings-2", 512, 64);
  svm::RunOptions options{.pages = {.in_flight = 1, .work_item_side = 0}};
  // With room for all pages and the host for home, faults are the pages that the picture uses.
  options.pages.homes = svm::PageHomes::host;
  options.pages.cache_pages = static_cast<std::uint32_t>(small.database.page_count());
  const svm::Report report = svm::run_svm(small.database, small.settings, options, {});
  const auto used = static_cast<std::uint32_t>(report.pages().faults);
  REQUIRE(used > 20);
  options.pages.resident_percent = 50;
  const svm::Report half = svm::run_svm(small.database, small.settings, options, {});
  CHECK(half.plan.resident_count == small.database.page_count() / 2);
  CHECK(half.pages().faults < used / 2);
  CHECK(half.pages().home_hits > 3 * (half.pages().references / 4));
  CHECK(half.film.hash() == report.film.hash());
}

TEST_CASE("no pages are asked for, or more than there are, or nobody waits for them any more") {
  const BuiltScene small("rings-2", 512, 16);
  CHECK(svm::most_used_pages(small.database, small.settings, 0).empty());
  CHECK(svm::most_used_pages(small.database, small.settings, 0xffffffffU).size() == small.database.page_count());
  std::stop_source stop;
  stop.request_stop();
  CHECK(svm::most_used_pages(small.database, small.settings, 3, stop.get_token()) ==
        std::vector<PageId>{PageId{0}, PageId{1}, PageId{2}});
}

}  // namespace resident_test
