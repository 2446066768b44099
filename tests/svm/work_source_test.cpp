#include "svm/work_source.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <optional>
#include <set>
#include <vector>

#include "core/base/expect.h"
#include "core/picture/camera/background.h"
#include "core/picture/camera/camera.h"
#include "svm/packets.h"
#include "tests/support/small_machine.h"

namespace work_source_test {

using namespace dmpc;
using namespace dmpc::tests;
using svm::Kind;
using svm::PixelRectangle;

namespace {

/// Node `index` of `nodes`, each with 3x3 pixels: one item, or with side 1 nine.
struct SmallSource {
  SmallSource(std::uint32_t index, std::uint32_t nodes, std::uint32_t side, svm::WorkDonor donor = svm::WorkDonor::ring,
              std::optional<std::uint32_t> workers = std::nullopt, bool passes_over_idle = true)
      : plan(svm::make_plan({.page_count = 4,
                             .computer = {.node_count = nodes},
                             .pages = {.work_item_side = side, .work_donor = donor, .worker_count = workers},
                             .width = 3 * nodes,
                             .height = 3})),
        lone(plan, index),
        work(lone.node, plan.work(), passes_over_idle) {}
  void use_up() {
    while (work.has_pixel()) {
      work.next_pixel();
    }
  }
  template <class Reply>
  void take_reply(const Reply& reply) {
    work.take_reply(parcel_of(0, svm::Kind::work_reply, reply).packet());
  }
  void take_reply(const svm::WorkReply& reply) { take_reply<svm::WorkReply>(reply); }
  /// Has asked, and been given one pixel by node `donor`, which it has rendered.
  void take_from(std::uint32_t donor) {
    work.ask();
    CHECK(sent().kind == svm::number_of(Kind::work_request));
    take_reply({svm::SentItem(PixelRectangle{9, 1, 1, 1}), donor});
    use_up();
  }
  /// Has asked, and been told that there is no more work.
  void take_nothing() {
    work.ask();
    sent();
    take_reply({{}, 0});
  }
  Parcel sent() {
    REQUIRE(lone.post.parcels.size() == 1);
    const Parcel parcel = lone.post.parcels.front();
    lone.post.parcels.clear();
    return parcel;
  }

  svm::Plan plan;
  LoneNode lone;
  svm::WorkSource work;
};

}  // namespace

TEST_CASE("items of background that lie side by side are taken as one rectangle, and only those that come next") {
  const core::Camera camera(core::View{}, core::GridFrame{}, 12, 8, 1);
  core::BackgroundTiles::Bits bits{};
  // The picture has 12x8 pixels; all of its upper half except the last column shows only background.
  for (std::uint32_t row = 0; row < 32; ++row) {
    bits[row] = ~std::uint64_t{0} >> 6U;
  }
  const core::BackgroundTiles background(camera, bits);
  const svm::Plan plan =
      svm::make_plan({.page_count = 4, .computer = {.node_count = 1}, .pages = {.work_item_side = 4}, .width = 12, .height = 8});
  LoneNode lone(plan, 0);
  svm::WorkSource work(lone.node, plan.work());
  CHECK(work.take_background({}, 4).pixel_count() == 0);
  CHECK(work.take_background(background, 3).pixel_count() == 0);
  CHECK(work.take_background(background, 4) == PixelRectangle{0, 0, 8, 4});
  CHECK(work.take_background(background, 4).pixel_count() == 0);
  CHECK(work.next_pixel() == 8);
  CHECK(work.take_background(background, 4).pixel_count() == 0);
}

TEST_CASE("a node without pixels asks the next one, once") {
  SmallSource small(1, 4, 3);
  CHECK_THROWS_AS(small.work.ask(), core::InternalError);
  small.use_up();
  small.work.ask();
  small.work.ask();
  const Parcel parcel = small.sent();
  CHECK(parcel.target == nodes::NodeId{2});
  CHECK(parcel.packet().as<svm::WorkRequest>().requester == 1);
  CHECK(parcel.packet().as<svm::WorkRequest>().visits_left == 3);
}

TEST_CASE("a node with items left answers the requester directly with its last one") {
  SmallSource small(2, 4, 1);
  small.work.answer({0, 2});
  const Parcel parcel = small.sent();
  CHECK(parcel.target == nodes::NodeId{0});
  CHECK(parcel.kind == svm::number_of(Kind::work_reply));
  CHECK(parcel.packet().as<svm::WorkReply>().item.rectangle() == PixelRectangle{8, 2, 1, 1});
  CHECK(parcel.packet().as<svm::WorkReply>().donor == 2);
  CHECK(small.work.counters().items_given == 1);
}

TEST_CASE("a node without items passes a request on along the ring, over the requester") {
  SmallSource small(3, 4, 3);
  small.use_up();
  small.work.answer({1, 3});
  Parcel parcel = small.sent();
  CHECK(parcel.target == nodes::NodeId{0});
  CHECK(parcel.packet().as<svm::WorkRequest>().visits_left == 2);
  small.work.answer({0, 3});
  parcel = small.sent();
  CHECK(parcel.target == nodes::NodeId{1});
}

TEST_CASE("a node without items passes a request on to the node that gave it one last, over those between") {
  SmallSource small(1, 8, 3);
  small.use_up();
  small.take_from(5);
  small.work.answer({7, 6});
  Parcel parcel = small.sent();
  CHECK(parcel.target == nodes::NodeId{5});
  CHECK(parcel.packet().as<svm::WorkRequest>().visits_left == 2);
  CHECK(small.work.nodes_passed_over() == 3);
  small.work.answer({3, 6});  // the requester is one of those between, and no visit
  parcel = small.sent();
  CHECK(parcel.target == nodes::NodeId{5});
  CHECK(parcel.packet().as<svm::WorkRequest>().visits_left == 3);
  small.work.answer({5, 6});  // the donor has run out and asks itself
  parcel = small.sent();
  CHECK(parcel.target == nodes::NodeId{6});
  CHECK(parcel.packet().as<svm::WorkRequest>().visits_left == 2);
  CHECK(small.work.nodes_passed_over() == 3 + 2 + 3);
}

TEST_CASE("where all that are left to be asked are passed over, the requester is told that there is no more work") {
  SmallSource small(1, 8, 3);
  small.use_up();
  small.take_from(5);
  small.work.answer({7, 4});
  const Parcel parcel = small.sent();
  CHECK(parcel.target == nodes::NodeId{7});
  CHECK(parcel.packet().as<svm::WorkReply>().item.rectangle().pixel_count() == 0);
  CHECK(small.work.nodes_passed_over() == 3);
}

TEST_CASE("a node that knows of no more work says so to all") {
  SmallSource small(1, 8, 3);
  small.use_up();
  small.take_nothing();
  small.work.answer({7, 6});
  const Parcel parcel = small.sent();
  CHECK(parcel.target == nodes::NodeId{7});
  CHECK(parcel.packet().as<svm::WorkReply>().item.rectangle().pixel_count() == 0);
}

TEST_CASE("with the skip off, and in a later pass than it knows of, a node passes requests to the next one") {
  for (const bool is_later : {false, true}) {
    SmallSource small(1, 8, 3, svm::WorkDonor::ring, std::nullopt, is_later);
    small.use_up();
    small.take_from(5);
    small.work.answer({7, 6, is_later ? 1U : 0U});
    CHECK(small.sent().target == nodes::NodeId{2});
    small.take_nothing();
    small.work.answer({7, 6, is_later ? 1U : 0U});
    CHECK(small.sent().target == nodes::NodeId{2});
    CHECK(small.work.nodes_passed_over() == 0);
  }
}

TEST_CASE("of two nodes that wait for answers one keeps the other's request until it has its own, and not more than its room") {
  const auto keeps = [](std::uint32_t self, std::uint32_t requester) {
    SmallSource small(self, 40, 3);
    small.use_up();
    small.work.ask();
    small.sent();
    small.work.answer({requester, 39});
    return small.lone.post.parcels.empty();
  };
  std::uint32_t most = 0, first = 0;
  for (std::uint32_t self = 0; self < 40; ++self) {
    std::uint32_t kept = 0;
    for (std::uint32_t requester = 0; requester < 40; ++requester) {
      if (requester != self) {
        CHECK(keeps(self, requester) != keeps(requester, self));
        kept += keeps(self, requester) ? 1 : 0;
      }
    }
    first = kept == 39 ? self : first;
    most = std::max(most, kept);
  }
  REQUIRE(most == 39);  // somebody ranks highest
  for (const bool has_more : {false, true}) {
    SmallSource small(first, 40, 3);
    small.use_up();
    small.work.ask();
    small.sent();
    for (std::uint32_t requester = 0; requester < 17; ++requester) {
      small.work.answer({(first + 20 + requester) % 40, 39});
    }
    CHECK(small.lone.post.parcels.size() == 1);
    small.lone.post.parcels.clear();
    small.take_reply({has_more ? svm::SentItem(PixelRectangle{9, 1, 1, 1}) : svm::SentItem(), (first + 10) % 40});
    REQUIRE(small.lone.post.parcels.size() == 16);
    for (const Parcel& parcel : small.lone.post.parcels) {
      CHECK(parcel.kind == svm::number_of(has_more ? Kind::work_request : Kind::work_reply));
      CHECK((parcel.target == nodes::NodeId{(first + 10) % 40}) == has_more);
    }
  }
}

TEST_CASE("the last node to be asked tells the requester that there is no more work") {
  SmallSource small(3, 4, 3);
  small.use_up();
  small.work.answer({1, 1});
  const Parcel parcel = small.sent();
  CHECK(parcel.target == nodes::NodeId{1});
  CHECK(parcel.packet().as<svm::WorkReply>().item.rectangle().pixel_count() == 0);
}

TEST_CASE("an item that was given becomes the requester's pixels, and the donor is asked first the next time") {
  SmallSource small(1, 4, 3);
  small.use_up();
  small.work.ask();
  small.sent();
  small.take_reply({svm::SentItem(PixelRectangle{9, 1, 2, 1}), 3});
  REQUIRE(small.work.has_pixel());
  CHECK(small.work.next_pixel() == 12 + 9);
  CHECK(small.work.next_pixel() == 12 + 10);
  CHECK_FALSE(small.work.has_pixel());
  CHECK_FALSE(small.work.exhausted());
  small.work.ask();
  CHECK(small.sent().target == nodes::NodeId{3});
}

TEST_CASE("where the host assigns the work a node starts with nothing and asks the host for every item") {
  SmallSource small(1, 4, 3, svm::WorkDonor::host);
  for (int item = 0; item < 2; ++item) {
    CHECK_FALSE(small.work.has_pixel());
    CHECK_FALSE(small.work.exhausted());
    small.work.ask();
    CHECK(small.sent().target == nodes::NodeId{4});
    small.take_reply({svm::SentItem(PixelRectangle{9, 1, 1, 1}), 4});
    CHECK(small.work.next_pixel() == 12 + 9);
  }
}

TEST_CASE("a lone node asks the host where that assigns the work, one that only lends its memory does not") {
  CHECK_FALSE(SmallSource(0, 1, 3, svm::WorkDonor::host).work.exhausted());
  CHECK(SmallSource(1, 2, 3, svm::WorkDonor::host, 1).work.exhausted());
}

TEST_CASE("an empty item ends the asking") {
  SmallSource small(1, 4, 3);
  small.use_up();
  small.take_nothing();
  CHECK(small.work.exhausted());
  small.work.ask();
  CHECK(small.lone.post.parcels.empty());
}

TEST_CASE("a later pass has the pixels of the mask alone, each with samples of its own") {
  svm::Plan plan = svm::make_plan({.page_count = 4,
                                   .computer = {.node_count = 1},
                                   .pages = {.work_item_side = 3},
                                   .width = 12,
                                   .height = 8,
                                   .first_samples = 2,
                                   .refinement = {.error = 1}});
  LoneNode lone(plan, 0);
  svm::WorkSource work(lone.node, plan.work());
  std::set<std::uint32_t> first, second;
  while (work.has_pixel()) {
    CHECK(work.next_step().samples(2) == core::SampleRange{0, 2});
    first.insert(work.next_pixel());
  }
  CHECK(first.size() == 96);
  svm::MaskPart mask;
  mask.steps[0] = {1, 2};
  mask.steps[13] = {1, 4};
  mask.steps[95] = {3, 4};
  work.take_mask(mask);
  work.begin_pass();
  while (work.has_pixel()) {
    const core::SampleRange samples = work.next_step().samples(2);
    const std::uint32_t pixel = work.next_pixel();
    CHECK(samples == mask.steps[pixel].samples(2));
    second.insert(pixel);
  }
  CHECK(second == std::set<std::uint32_t>{0, 13, 95});
  CHECK(work.exhausted());
  work.take_mask({});
  work.begin_pass();
  CHECK(work.exhausted());
}

TEST_CASE("an item that is given away takes its part of the mask along, and items without wanted pixels stay") {
  const svm::Plan plan = svm::make_plan({.page_count = 4,
                                         .computer = {.node_count = 2},
                                         .pages = {.work_item_side = 2},
                                         .width = 8,
                                         .height = 2,
                                         .first_samples = 2,
                                         .refinement = {.error = 1}});
  LoneNode donor_node(plan, 0), recipient_node(plan, 1);
  svm::WorkSource donor(donor_node.node, plan.work()), recipient(recipient_node.node, plan.work());
  for (svm::WorkSource* work : {&donor, &recipient}) {
    while (work->has_pixel()) {
      work->next_pixel();
    }
    work->ask();
  }
  donor.take_reply(parcel_of(1, Kind::work_reply, svm::MaskedWorkReply{}).packet());
  recipient.take_reply(parcel_of(0, Kind::work_reply, svm::MaskedWorkReply{}).packet());
  svm::MaskPart mask;
  mask.steps[0] = {1, 2};  // of a submap of 4x2: the first item's first pixel and its last one
  mask.steps[5] = {1, 3};
  donor.take_mask(mask);
  donor.begin_pass();
  recipient.take_mask({});
  recipient.begin_pass();
  donor_node.post.parcels.clear();
  donor.answer({1, 1});
  REQUIRE(donor_node.post.parcels.size() == 1);
  CHECK_FALSE(donor.has_pixel());
  recipient.ask();
  recipient.take_reply(donor_node.post.parcels.front().packet());
  CHECK(recipient.next_step().samples(2) == core::SampleRange{2, 2});
  CHECK(recipient.next_pixel() == 0);
  CHECK(recipient.next_step().samples(2) == core::SampleRange{2, 6});
  CHECK(recipient.next_pixel() == 8 + 1);
  CHECK_FALSE(recipient.has_pixel());
}

TEST_CASE("interleaved, a later pass has the pixels of the mask, and an item that is given away takes its part along") {
  const svm::Plan plan = svm::make_plan({.page_count = 4,
                                         .computer = {.node_count = 4},
                                         .pages = {.work_item_side = 2, .pixel_shares = svm::PixelShares::interleaved},
                                         .width = 8,
                                         .height = 4,
                                         .first_samples = 2,
                                         .refinement = {.error = 1}});
  LoneNode lone(plan, 3);
  svm::WorkSource work(lone.node, plan.work());
  std::vector<std::uint32_t> first;
  while (work.has_pixel()) {
    first.push_back(work.next_pixel());
  }
  CHECK(first == std::vector<std::uint32_t>{9, 11, 25, 27, 13, 15, 29, 31});
  work.ask();
  work.take_reply(parcel_of(0, Kind::work_reply, svm::MaskedWorkReply{}).packet());
  svm::MaskPart mask;
  mask.steps[1] = {1, 2};  // of a share of 4x2: the second column of the first item, and the last of the other
  mask.steps[7] = {1, 3};
  work.take_mask(mask);
  work.begin_pass();
  lone.post.parcels.clear();
  work.answer({1, 1});
  REQUIRE(lone.post.parcels.size() == 1);
  const auto given = lone.post.parcels.front().packet().as<svm::MaskedWorkReply>();
  CHECK(given.reply.item.rectangle() == PixelRectangle{5, 1, 2, 2, 2, 2});
  CHECK(given.steps[3].samples(2) == core::SampleRange{2, 6});
  CHECK(given.steps[0].is_none());
  CHECK(work.next_step().samples(2) == core::SampleRange{2, 2});
  CHECK(work.next_pixel() == 11);
  CHECK_FALSE(work.has_pixel());
}

TEST_CASE("a static run and a node alone never ask") {
  for (const auto& [nodes, side] : {std::pair{4U, 0U}, {1U, 3U}}) {
    SmallSource small(0, nodes, side);
    small.use_up();
    small.work.ask();
    CHECK(small.lone.post.parcels.empty());
    CHECK(small.work.exhausted());
  }
}

TEST_CASE("a reply to no request, and a request of one's own, are errors") {
  SmallSource small(1, 4, 3);
  CHECK_THROWS_AS(small.take_reply({{}, 0}), core::InternalError);
  CHECK_THROWS_AS(small.work.answer({1, 2}), core::InternalError);
  CHECK_THROWS_AS(small.work.answer({2, 0}), core::InternalError);
}

TEST_CASE("workers share the picture among themselves alone, and ask round a ring of their own") {
  const svm::Plan plan = svm::make_plan({.page_count = 4,
                                         .computer = {.node_count = 4},
                                         .pages = {.work_item_side = 3, .worker_count = 2},
                                         .width = 6,
                                         .height = 3});
  LoneNode second(plan, 1), third(plan, 2);
  svm::WorkSource work(second.node, plan.work()), none(third.node, plan.work());
  std::size_t pixels = 0;
  for (; work.has_pixel(); ++pixels) {
    work.next_pixel();
  }
  CHECK(pixels == 9);
  work.ask();
  REQUIRE(second.post.parcels.size() == 1);
  CHECK(second.post.parcels.front().target == nodes::NodeId{0});
  CHECK(second.post.parcels.front().packet().as<svm::WorkRequest>().visits_left == 1);
  CHECK(none.exhausted());
}

}  // namespace work_source_test
