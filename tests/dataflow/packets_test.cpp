#include "dataflow/packets.h"

#include <doctest/doctest.h>

#include <cstring>
#include <limits>
#include <set>
#include <string>

#include "tests/support/shuffled_machine.h"

namespace packets_test {

using namespace dmpc;
using dataflow::Kind;
using dataflow::RayMessage;

namespace {

core::Ray some_ray() {
  core::Ray ray;
  ray.origin = {0.25F, -0.0F, 1e-30F};
  ray.direction = {0.6F, -0.8F, 0.0F};
  ray.ignored_primitive = 7;
  ray.weight = {0.5, 0.25, 0.125};
  ray.pixel = 123456;
  ray.sample = 3;
  ray.depth = 5;
  ray.kind = core::RayKind::refracted;
  return ray;
}

constexpr core::Passage some_passage{
    .t_enter = 0.1, .cell = {1, 62, 4095}, .entry_axis = 2, .best = {0.5F, 9, core::Address{77}, 6}};

bool same(const core::Hit& a, const core::Hit& b) {
  return a.t == b.t && a.primitive == b.primitive && a.leaf == b.leaf && a.lane == b.lane;
}

/// By way of the bytes of a packet.
template <class T>
T copied(const T& value) {
  std::byte bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  return nodes::Packet{nodes::NodeId{1}, 0, bytes}.template as<T>();
}

}  // namespace

TEST_CASE("a ray on its way keeps its bits, its passage and its finder") {
  const RayMessage message = copied(dataflow::message_of(some_ray(), some_passage, nodes::NodeId{1023}));
  const core::Ray ray = some_ray();
  CHECK(std::memcmp(&message.ray, &ray, sizeof(ray)) == 0);
  CHECK(message.passage().t_enter == some_passage.t_enter);
  CHECK(message.passage().cell == some_passage.cell);
  CHECK(message.passage().entry_axis == some_passage.entry_axis);
  CHECK(same(message.passage().best, some_passage.best));
  CHECK(message.finder == 1023);
  CHECK(message.is_confirmed == 0);
}

TEST_CASE("a ray without a candidate arrives without one") {
  const RayMessage message = copied(dataflow::message_of(some_ray(), {}, nodes::NodeId{0}));
  CHECK(!message.passage().best.found());
  CHECK(message.passage().best.t == std::numeric_limits<float>::infinity());
  CHECK(message.passage().entry_axis == 3);
}

TEST_CASE("as many rays as are said to fit so many bytes do, and one more does not") {
  for (const std::size_t bytes : {dataflow::ray_packet_bytes(1), dataflow::packet_bytes, dataflow::packet_bytes_max}) {
    const std::uint32_t rays = dataflow::rays_in(bytes);
    CHECK(dataflow::ray_packet_bytes(rays) <= bytes);
    CHECK(dataflow::ray_packet_bytes(rays + 1) > bytes);
  }
  CHECK(dataflow::ray_batch_max <= std::numeric_limits<decltype(dataflow::RayPacketHeader::count)>::max());
  CHECK(dataflow::film_packet_bytes(dataflow::film_packet_entries) <= 4096);
  CHECK(dataflow::film_packet_bytes(dataflow::film_packet_entries + 1) > 4096);
}

TEST_CASE("packets of rays and film are bulk, however short, and those of control are small") {
  CHECK(dataflow::ray_packet_bytes(1) > nodes::small_payload_bytes);
  CHECK(dataflow::film_packet_bytes(dataflow::film_packet_entries) > nodes::small_payload_bytes);
  CHECK(dataflow::is_small_packet<dataflow::Credits>);
  CHECK(dataflow::is_small_packet<dataflow::OverflowTaken>);
  CHECK(dataflow::is_small_packet<dataflow::Token>);
  CHECK(dataflow::is_small_packet<dataflow::Finish>);
  CHECK(dataflow::is_small_packet<dataflow::FilmAcknowledgement>);
  CHECK(dataflow::is_small_packet<dataflow::Done>);
  CHECK(dataflow::is_small_packet<dataflow::Stop>);
  CHECK(dataflow::is_small_packet<dataflow::Ask>);
  CHECK(!dataflow::is_small_packet<RayMessage>);
  CHECK(!dataflow::is_small_packet<dataflow::Unused>);
}

TEST_CASE("every kind of packet has a number and a name of its own") {
  std::set<std::string> names;
  for (nodes::PacketKind number = 0; number <= dataflow::number_of(Kind::unit_moved); ++number) {
    names.insert(dataflow::name_of(Kind{number}));
  }
  CHECK(names.size() == dataflow::kind_names.size());
  CHECK(std::string(dataflow::name_of(Kind::rays)) == "rays");
  CHECK(std::string(dataflow::name_of(Kind::stop)) == "stop");
}

TEST_CASE("control is sent whatever credits there are, and spends none") {
  nodes::MemoryPlan plan;
  plan += nodes::credit_table(3);
  tests::SingleNode single(plan, 0, 3);
  const nodes::NodeId target{2};
  dataflow::send_control(single.node, target, Kind::credits, dataflow::Credits{5});
  CHECK(single.node.credits(target, dataflow::control_channel) == 0);
  const tests::Parcel parcel = single.take();
  CHECK(parcel.target == target);
  CHECK(Kind{parcel.kind} == Kind::credits);
  CHECK(parcel.packet().as<dataflow::Credits>().count == 5);
  CHECK_THROWS_AS(parcel.packet().as<dataflow::Done>(), core::InternalError);
}

}  // namespace packets_test
