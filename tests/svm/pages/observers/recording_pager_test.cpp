#include "svm/pages/observers/observed_pagers.h"

#include <doctest/doctest.h>

#include "svm/packets.h"
#include "svm/pages/observers/miss_curve.h"
#include "tests/support/references.h"
#include "tests/support/small_machine.h"
#include "tests/support/small_pages.h"

namespace recording_pager_test {

using namespace dmpc;
using namespace dmpc::tests;
using svm::PageId;

namespace {

/// The recording pager of node 0 of 4, with two frames.
struct SmallRecorder {
  SmallRecorder() : lone(plan, 0), pages(page_count, page_size), pager(lone.node, plan.pages(), pages.bytes()) {
    pager.record_into(log);
  }
  /// A reference, with the page's journey if it is absent.
  void refer(std::uint32_t page) {
    while (pager.find(start_of(page)) == nullptr) {
      pager.park(0, start_of(page));
      Parcel parcel = parcel_of(page % 4, svm::Kind::page_reply, svm::PageReplyHeader{PageId{page}});
      parcel.payload.insert(parcel.payload.end(), pages.page(page).begin(), pages.page(page).end());
      pager.install(parcel.packet());
    }
  }
  References recorded() const { return {log.pages().begin(), log.pages().end()}; }

  svm::Plan plan = svm::make_plan({.page_count = page_count,
                                   .page_size_bytes = page_size,
                                   .computer = {.node_count = 4},
                                   .pages = {.cache_pages = 2, .in_flight = 1, .work_item_side = 0, .record_references = true},
                                   .width = 1,
                                   .height = 1});
  LoneNode lone;
  FakePages pages;
  svm::ReferenceLog log;
  svm::RecordingPager pager;
};

}  // namespace

TEST_CASE("before the first reference a record is empty") { CHECK(SmallRecorder().recorded().empty()); }

TEST_CASE("a reference is recorded when it is answered, not when it is missed") {
  SmallRecorder small;
  CHECK(small.pager.find(start_of(5)) == nullptr);
  CHECK(small.recorded().empty());
  small.refer(5);
  CHECK(small.recorded() == references_of({5}));
}

TEST_CASE("pages at home and repeats of a page are not recorded, not even with pages at home between them") {
  SmallRecorder small;
  for (const std::uint32_t page : {4U, 5U, 5U, 8U, 5U, 6U, 0U, 5U, 5U}) {
    small.refer(page);
  }
  CHECK(small.recorded() == references_of({5, 6, 5}));
}

TEST_CASE("the references recorded miss as often as the pager did") {
  SmallRecorder small;
  for (const PageId page : random_references(1, 3000, page_count)) {
    small.refer(svm::index_of(page));
  }
  CHECK(svm::MissCurve(small.log.pages()).misses(2) == small.pager.counters().misses);
  CHECK(small.pager.counters().misses > 100);
}

}  // namespace recording_pager_test
