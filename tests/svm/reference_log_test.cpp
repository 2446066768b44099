#include "svm/reference_log.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <set>

#include "tests/support/references.h"

namespace dmpc::svm {

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
  CHECK(log.every() >= 32);
  const std::set<PageId> kept(log.pages().begin(), log.pages().end());
  const ReferenceLog all = log_of(20'000, 20'000);
  const auto expected = std::count_if(all.pages().begin(), all.pages().end(), [&](PageId page) { return kept.contains(page); });
  CHECK(std::ssize(log.pages()) == expected);
}

TEST_CASE("logs of the same share keep the same pages, whenever they were thinned out") {
  ReferenceLog late = log_of(20'000, 20'000);
  const ReferenceLog early = log_of(1000, 20'000);
  late.thin_out(early.every());
  CHECK(std::equal(late.pages().begin(), late.pages().end(), early.pages().begin(), early.pages().end()));
}

}  // namespace dmpc::svm
