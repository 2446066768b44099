#include "svm/pages/observers/reference_log.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <iterator>
#include <set>
#include <vector>

#include "svm/pages/observers/miss_curve.h"
#include "tests/support/references.h"

namespace dmpc::svm::reference_log_test {

namespace {

constexpr std::uint32_t noted_pages = 4096;

ReferenceLog log_of(std::size_t references_max, std::uint32_t count) {
  ReferenceLog log(references_max);
  for (const PageId page : tests::random_references(1, count, noted_pages)) {
    log.note(page);
  }
  return log;
}

}  // namespace

TEST_CASE("without a bound every change of page is kept") {
  ReferenceLog log;
  for (const std::uint32_t page : {3U, 3U, 5U, 3U}) {
    log.note(PageId{page});
  }
  CHECK(tests::References(log.pages().begin(), log.pages().end()) == tests::references_of({3, 5, 3}));
  CHECK(log.every() == 1);
}

TEST_CASE("a bounded log keeps all references of ever fewer pages") {
  CHECK(log_of(2000, 1000).every() == 1);
  const ReferenceLog log = log_of(1000, 20'000);
  CHECK(log.pages().size() <= 1000);
  CHECK(log.pages().size() > 300);
  CHECK(std::has_single_bit(log.every()));
  CHECK(log.every() >= 16);
  const std::set<PageId> kept(log.pages().begin(), log.pages().end());
  const ReferenceLog all = log_of(20'000, 20'000);
  std::vector<PageId> expected;
  for (const PageId page : all.pages()) {
    if (kept.contains(page) && (expected.empty() || expected.back() != page)) {
      expected.push_back(page);
    }
  }
  CHECK(std::equal(log.pages().begin(), log.pages().end(), expected.begin(), expected.end()));
}

TEST_CASE("a page that alone has more references than there is room for takes one place") {
  ReferenceLog log(100);
  for (std::uint32_t i = 0; i < 10'000; ++i) {
    log.note(PageId{0});
    log.note(PageId{1 + i % 300});
  }
  CHECK(log.pages().size() <= 100);
  CHECK(log.every() <= 2048);
}

TEST_CASE("a bounded log keeps its bound with two pages that are in every share") {
  ReferenceLog log(10);
  for (std::uint32_t i = 0; i < 100; ++i) {
    log.note(PageId{1'312'268'371});
    log.note(PageId{2'834'354'451});
  }
  CHECK(log.pages().size() == 10);
  CHECK(log.every() == Share::every_max);
}

TEST_CASE("repeats in a thinned log are left out, and cost caches of a page or more nothing") {
  ReferenceLog log = log_of(20'000, 20'000);
  const std::vector<PageId> all(log.pages().begin(), log.pages().end());
  log.thin_out(256);
  const std::set<PageId> kept(log.pages().begin(), log.pages().end());
  std::vector<PageId> share;
  std::copy_if(all.begin(), all.end(), std::back_inserter(share), [&](PageId page) { return kept.contains(page); });
  CHECK(std::adjacent_find(log.pages().begin(), log.pages().end()) == log.pages().end());
  CHECK(log.pages().size() < share.size());
  for (const std::uint32_t frames : {1U, 2U, 5U, 10U}) {
    CHECK(MissCurve(log.pages()).misses(frames) == MissCurve(share).misses(frames));
  }
}

TEST_CASE("logs of the same share keep the same pages, whenever they were thinned out") {
  ReferenceLog late = log_of(20'000, 20'000);
  const ReferenceLog early = log_of(1000, 20'000);
  late.thin_out(early.every());
  CHECK(std::equal(late.pages().begin(), late.pages().end(), early.pages().begin(), early.pages().end()));
}

}  // namespace dmpc::svm::reference_log_test
