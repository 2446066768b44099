#include "apps/frontend/show/trace/view.h"

#include <doctest/doctest.h>

#include <initializer_list>
#include <string>
#include <vector>

#include "core/trace/charge.h"
#include "svm/packets.h"

namespace dmpc::apps::view_test {

namespace {

using nodes::Activity;
using nodes::NodeId;

SpanName name(Activity activity, std::initializer_list<core::Charge> charges) {
  nodes::TraceSpan span{.activity = activity};
  for (const core::Charge charge : charges) {
    span.charged = static_cast<nodes::ChargeBits>(span.charged | 1U << static_cast<std::uint32_t>(charge));
  }
  return name_of(span);
}

nodes::TraceMessage message(svm::Kind kind, std::uint32_t from, std::uint32_t to, std::uint32_t page, std::uint64_t sent_ns) {
  return {.source = NodeId{from},
          .target = NodeId{to},
          .kind = svm::number_of(kind),
          .first_word = page,
          .sent_ns = sent_ns,
          .received_ns = sent_ns + 10};
}

}  // namespace

TEST_CASE("what a node does is named by what it was charged, unless it is the computer's") {
  CHECK(name(Activity::work, {core::Charge::cell_step}) == SpanName::trace);
  CHECK(name(Activity::receive, {core::Charge::shading}) == SpanName::shade);
  CHECK(name(Activity::receive, {core::Charge::page_install}) == SpanName::install_page);
  CHECK(name(Activity::work, {core::Charge::ray_packing}) == SpanName::pack_rays);
  CHECK(name(Activity::receive, {core::Charge::ray_packing}) == SpanName::unpack_rays);
  CHECK(name(Activity::work, {}) == SpanName::overhead);
  CHECK(name(Activity::serve, {}) == SpanName::serve_page);
  CHECK(name(Activity::send, {}) == SpanName::send);
  CHECK(name(Activity::take_over, {}) == SpanName::take_packet);
  CHECK(std::string(span_names[static_cast<std::size_t>(SpanName::take_packet)]) == "take packet");
}

TEST_CASE("the last of the nodes is the host") {
  const nodes::Trace trace{.nodes = std::vector<nodes::TraceNode>(3)};
  const TraceView view{.trace = trace, .kind_names = {}, .clock = "", .remarks = {}};
  CHECK(node_name(view, 1) == "node 1");
  CHECK(node_name(view, 2) == "host");
}

TEST_CASE("a node waits from its request for a page to the reply with that page") {
  nodes::Trace trace;
  trace.messages = {message(svm::Kind::page_request, 0, 1, 7, 100), message(svm::Kind::page_request, 2, 1, 7, 110),
                    message(svm::Kind::page_request, 0, 1, 9, 120), message(svm::Kind::page_reply, 1, 0, 7, 130),
                    message(svm::Kind::page_reply, 1, 0, 8, 140),   message(svm::Kind::page_request, 0, 1, 7, 150),
                    message(svm::Kind::page_reply, 1, 0, 7, 160)};
  TraceView view{.trace = trace, .kind_names = {}, .has_pages = true, .clock = "", .remarks = {}};
  const std::vector<PageWait> waits = page_waits(view);
  REQUIRE(waits.size() == 2);
  CHECK(waits[0].node == 0);
  CHECK(waits[0].page == 7);
  CHECK(waits[0].begin_ns == 100);
  CHECK(waits[0].end_ns == 140);
  CHECK(waits[1].begin_ns == 150);
  view.has_pages = false;
  CHECK(page_waits(view).empty());
}

TEST_CASE("a thousandth keeps all digits") {
  CHECK(thousandths(0) == "0.000");
  CHECK(thousandths(1) == "0.001");
  CHECK(thousandths(12'345'060) == "12345.060");
  CHECK(thousandths(18'446'744'073'709'551'615U) == "18446744073709551.615");
}

}  // namespace dmpc::apps::view_test
