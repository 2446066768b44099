#include "dataflow/host.h"

#include <doctest/doctest.h>

#include <cstring>
#include <optional>
#include <vector>

#include "core/base/expect.h"
#include "tests/support/shuffled_machine.h"

namespace dataflow_host_test {

using namespace dmpc;
using dataflow::FilmEntry;
using dataflow::Kind;
using dataflow::RayMessage;
using nodes::NodeId;
using tests::Parcel;

namespace {

dataflow::Plan plan_for(std::uint32_t nodes, std::uint32_t batch) {
  return dataflow::make_plan(
      {.shares = std::vector<dataflow::Share>(nodes), .rays = {.ray_batch = batch, .ray_credits = 1}, .width = 4, .height = 2});
}

/// The host of two nodes, alone.
struct LoneHost {
  explicit LoneHost(std::uint32_t batch = 2, nodes::Progress progress = {})
      : plan(plan_for(2, batch)),
        film(4, 2),
        single(plan.host_memory(), 2, 3),
        program(single.node, plan, film, std::move(progress), {}) {}

  template <class T>
  void receive(std::uint32_t sender, Kind kind, const T& value) {
    program.receive({NodeId{sender}, dataflow::number_of(kind), std::as_bytes(std::span(&value, 1))});
  }
  void overflow(std::uint32_t sender, std::uint16_t owner, const std::vector<std::uint32_t>& pixels) {
    const dataflow::RayPacketHeader header{static_cast<std::uint16_t>(pixels.size()), owner};
    std::vector<std::byte> payload(dataflow::ray_packet_bytes(pixels.size()));
    std::memcpy(payload.data(), &header, sizeof(header));
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      RayMessage message;
      message.ray.pixel = pixels[i];
      std::memcpy(payload.data() + dataflow::ray_packet_bytes(i), &message, dataflow::ray_message_bytes(0));
    }
    program.receive({NodeId{sender}, dataflow::number_of(Kind::overflow), payload});
  }
  struct FilmPacket {
    dataflow::FilmHeader header{1};
    FilmEntry entry;
  };
  /// Calls both nodes and hears from them what nodes say that are white; the sum of their balances is `balance`.
  void pass_token_round(std::int64_t balance) {
    program.work();
    for (const std::uint32_t node : {0U, 1U}) {
      const Parcel call = single.take();
      REQUIRE(Kind{call.kind} == Kind::token);
      CHECK(call.target == NodeId{node});
    }
    receive(1, Kind::token, dataflow::Token{balance, 0});
    receive(0, Kind::token, dataflow::Token{});
    program.work();
  }

  dataflow::Plan plan;
  core::Film film;
  tests::SingleNode single;
  dataflow::HostProgram program;
};

}  // namespace

TEST_CASE("the host gives the credit of an overflow back at once and forwards its rays to their owner") {
  LoneHost host;
  host.overflow(0, 1, {10, 11});
  host.program.work();
  const Parcel credits = host.single.take();
  CHECK(Kind{credits.kind} == Kind::overflow_taken);
  CHECK(credits.packet().as<dataflow::OverflowTaken>().host_rays == 2);
  CHECK(credits.target == NodeId{0});
  const Parcel forwarded = host.single.take();
  CHECK(Kind{forwarded.kind} == Kind::forwarded);
  CHECK(forwarded.target == NodeId{1});
  CHECK(forwarded.payload.size() == dataflow::ray_packet_bytes(2));
}

TEST_CASE("primary rays of a later pass are assigned as nodes have room, and the host is not passive before") {
  const std::size_t room = dataflow::AssignedPrimaries().runs.size();
  dataflow::Plan plan = plan_for(2, 2);
  plan.request.first_samples = 2;
  plan.request.refinement.error = 1e-9;
  core::Film film(4, 2);
  tests::SingleNode single(plan.host_memory(), 2, 3);
  const auto assign = [&](const core::Pass&, const core::PixelMask&) {
    return std::vector<std::vector<dataflow::PrimaryRun>>{{}, std::vector<dataflow::PrimaryRun>(2 * room + 1, {0, 1})};
  };
  dataflow::HostProgram host(single.node, plan, film, {}, assign);
  const auto receive = [&](std::uint32_t sender, Kind kind, const auto& value) {
    host.receive({NodeId{sender}, dataflow::number_of(kind), std::as_bytes(std::span(&value, 1))});
  };
  const auto sent = [&](Kind kind) {
    return std::count_if(single.post.parcels.begin(), single.post.parcels.end(),
                         [&](const Parcel& parcel) { return parcel.kind == dataflow::number_of(kind); });
  };
  LoneHost::FilmPacket light;
  light.entry.light.channel[1] = 1 << 20;
  receive(0, Kind::film, light);
  host.work();
  receive(0, Kind::token, dataflow::Token{0, 0});
  receive(1, Kind::token, dataflow::Token{0, 0});
  host.work();
  receive(0, Kind::done, dataflow::Done{1});
  receive(1, Kind::done, dataflow::Done{0});
  CHECK(sent(Kind::stop) == 0);
  CHECK(sent(Kind::primaries) == dataflow::assigned_packets);
  const auto tokens = sent(Kind::token);
  host.work();
  CHECK(sent(Kind::token) == tokens);  // it has rays to deal
  receive(1, Kind::primaries_taken, dataflow::PrimariesTaken{1});
  CHECK(sent(Kind::primaries) == dataflow::assigned_packets + 1);
  CHECK(single.post.parcels.back().packet().as<dataflow::AssignedPrimaries>().count == 1);
  host.work();
  CHECK(sent(Kind::token) == tokens + 2);
}

TEST_CASE("a pass whose rays were not all found, as a stop was requested, is not taken for one that has ended") {
  dataflow::Plan plan = plan_for(2, 2);
  plan.request.is_assigned_on_the_way = true;
  core::Film film(4, 2);
  tests::SingleNode single(plan.host_memory(), 2, 3);
  dataflow::HostProgram host(single.node, plan, film, {}, [](const core::Pass&, const core::PixelMask&) { return std::nullopt; });
  for (int quanta = 0; quanta < 3; ++quanta) {
    CHECK(host.work());
  }
  CHECK(single.post.parcels.empty());
  CHECK_FALSE(host.finished());
}

TEST_CASE("without a credit for the owner the host keeps rays until one comes") {
  LoneHost host;
  for (std::uint32_t i = 0; i < 4; ++i) {
    host.overflow(0, 1, {i});
    host.program.work();
  }
  CHECK(host.program.report().rays_out == 1);
  CHECK(host.program.report().rays_buffered_max == 3);
  host.receive(1, Kind::credits, dataflow::Credits{1});
  host.program.work();
  CHECK(host.program.report().rays_out == 3);  // two to a packet
  host.receive(1, Kind::credits, dataflow::Credits{1});
  host.program.work();
  CHECK(host.program.report().rays_out == 4);
}

TEST_CASE("while the host keeps a ray it keeps the token") {
  LoneHost host(1);
  host.overflow(0, 1, {1});
  host.overflow(0, 1, {2});
  host.program.work();
  for (const Parcel& parcel : host.single.post.parcels) {
    CHECK(Kind{parcel.kind} != Kind::token);
  }
  CHECK(host.program.describe().find("1 rays kept") != std::string::npos);
}

TEST_CASE("light from several nodes is added to the film and acknowledged") {
  LoneHost host;
  host.receive(0, Kind::film, LoneHost::FilmPacket{.entry = {5, 0, 0, {{1, 2, 3}}}});
  host.receive(1, Kind::film, LoneHost::FilmPacket{.entry = {5, 0, 0, {{10, 20, 30}}}});
  host.receive(1, Kind::film, LoneHost::FilmPacket{.entry = {5, 1, 0, {{7, 7, 7}}}});
  CHECK(host.film.sums(5).plane[0] == core::FixedColor{{11, 22, 33}});
  CHECK(host.film.sums(5).plane[1] == core::FixedColor{{7, 7, 7}});
  CHECK(Kind{host.single.take().kind} == Kind::film_acknowledgement);
}

TEST_CASE("light of a run falls on each of its pixels, and none of them may lie outside the picture") {
  LoneHost host;
  host.receive(0, Kind::film, LoneHost::FilmPacket{.entry = {3, 1, 4, {{1, 2, 3}}}});
  for (std::uint32_t pixel = 0; pixel < 8; ++pixel) {
    CHECK(host.film.sums(pixel).plane[1] == (pixel >= 3 ? core::FixedColor{{1, 2, 3}} : core::FixedColor{}));
  }
  CHECK(host.program.report().film_entries == 1);
  CHECK_THROWS_AS(host.receive(0, Kind::film, LoneHost::FilmPacket{.entry = {3, 0, 5, {}}}), core::InternalError);
}

TEST_CASE("light outside the picture is an error") {
  LoneHost host;
  CHECK_THROWS_AS(host.receive(0, Kind::film, LoneHost::FilmPacket{.entry = {8, 0, 0, {}}}), core::InternalError);
  CHECK_THROWS_AS(host.receive(0, Kind::film, LoneHost::FilmPacket{.entry = {0, 2, 0, {}}}), core::InternalError);
  CHECK_THROWS_AS(host.receive(0, Kind::film, LoneHost::FilmPacket{.header = {2}, .entry = {}}), core::InternalError);
}

TEST_CASE("the host ends the run when a round of the token proves the end and every node is done") {
  std::vector<std::uint32_t> shown;
  LoneHost host(2, [&](std::uint32_t done, std::uint32_t) { shown.push_back(done); });
  host.pass_token_round(0);
  for (const std::uint32_t node : {0U, 1U}) {
    const Parcel finish = host.single.take();
    CHECK(Kind{finish.kind} == Kind::finish);
    CHECK(finish.target == NodeId{node});
  }
  host.receive(0, Kind::film, LoneHost::FilmPacket{.entry = {5, 0, 0, {{1, 2, 3}}}});
  host.single.take();
  host.receive(1, Kind::done, dataflow::Done{0});
  CHECK_FALSE(host.program.finished());
  host.receive(0, Kind::done, dataflow::Done{1});
  CHECK(host.program.finished());
  CHECK(Kind{host.single.take().kind} == Kind::stop);
  CHECK(shown == std::vector<std::uint32_t>{1, 8});
}

TEST_CASE("a round that finds a packet under way proves nothing") {
  LoneHost host;
  host.pass_token_round(1);
  CHECK(Kind{host.single.take().kind} == Kind::token);
  CHECK(host.program.report().token_rounds == 2);
}

TEST_CASE("light that got lost does not go unnoticed") {
  LoneHost host;
  host.pass_token_round(0);
  host.receive(1, Kind::done, dataflow::Done{0});
  CHECK_THROWS_AS(host.receive(0, Kind::done, dataflow::Done{1}), core::InternalError);
}

}  // namespace dataflow_host_test
