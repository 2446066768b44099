#include "apps/frontend/run/time_parts.h"

#include <doctest/doctest.h>

#include <numeric>

namespace dmpc::apps::time_parts_test {

namespace {

constexpr WaitKinds waits = {.data = "page",
                             .data_kinds = 0b1,
                             .work_kinds = 0b110,
                             .token_kinds = 0b100000,
                             .credit_kinds = 0b1000000,
                             .film_kinds = 0b10000000,
                             .end_kinds = 0b1000};

std::uint64_t at(const TimeParts& parts, TimePart part) { return parts.ns[static_cast<std::size_t>(part)]; }

/// Every field another power of two.
nodes::VirtualTimes powers() {
  return {.computing_ns = 1,
          .sending_ns = 2,
          .receiving_ns = 4,
          .service_busy_ns = 8,
          .service_idle_ns = 16,
          .waiting_ns = {32, 64, 128, 256, 512, 1024, 2048, 4096},
          .end_ns = 8192};
}

/// A time of two parts.
TimeParts computing_and_service_idle(std::uint64_t computing_ns, std::uint64_t service_idle_ns) {
  return parts_of(nodes::VirtualTimes{.computing_ns = computing_ns, .service_idle_ns = service_idle_ns}, waits);
}

double sum(const std::array<double, time_part_count>& percent) { return std::accumulate(percent.begin(), percent.end(), 0.0); }

}  // namespace

TEST_CASE("every nanosecond belongs to one part") {
  const TimeParts parts = parts_of(powers(), waits);
  CHECK(at(parts, TimePart::computing) == 1);
  CHECK(at(parts, TimePart::messages) == 2 + 4);
  CHECK(at(parts, TimePart::service_busy) == 8);
  CHECK(at(parts, TimePart::service_idle) == 16);
  CHECK(at(parts, TimePart::data_wait) == 32);
  CHECK(at(parts, TimePart::starvation) == 64 + 128);
  CHECK(at(parts, TimePart::idle_at_end) == 256 + 8192);
  CHECK(at(parts, TimePart::other_wait) == 512);
  CHECK(at(parts, TimePart::token_wait) == 1024);
  CHECK(at(parts, TimePart::credit_wait) == 2048);
  CHECK(at(parts, TimePart::film_wait) == 4096);
  CHECK(parts.total_ns() == powers().total_ns());
}

TEST_CASE("the parts add up to a hundred percent, even of nothing") {
  CHECK(sum(parts_of(powers(), waits).percent()) == doctest::Approx(100));
  CHECK(computing_and_service_idle(3, 1).percent()[0] == 75);
  CHECK(sum(TimeParts().percent()) == 100);
}

TEST_CASE("a sum over the nodes is without the host, which is the last") {
  const nodes::VirtualReport report = {.links = {}, .nodes = {powers(), powers(), powers()}};
  const nodes::VirtualTimes sum = sum_of_nodes(report);
  CHECK(sum.total_ns() == 2 * powers().total_ns());
  CHECK(sum.computing_ns == 2);
  CHECK(sum.waiting_ns[4] == 1024);
  CHECK(sum.end_ns == 2 * 8192);
}

TEST_CASE("parts are told as people read them, without those that are nothing") {
  CHECK(parts_text(computing_and_service_idle(3, 1), waits) == "computing 75.0 %, service while idle 25.0 %");
  CHECK(parts_text(computing_and_service_idle(7, 0), waits) == "computing 100.0 %");
  CHECK(parts_text(TimeParts(), waits) == "computing 100.0 %");
  CHECK(parts_text(parts_of(powers(), waits), waits) ==
        "computing 0.0 %, page wait 0.2 %, starvation 1.2 %, token wait 6.2 %, credit wait 12.5 %, film wait 25.0 %, other waits "
        "3.2 %, "
        "service while busy 0.0 %, service while idle 0.1 %, messages 0.0 %, idle at the end 51.6 %");
}

TEST_CASE("the figures of a line add up although they are rounded") {
  // 33.33 % three times: 99.9 % if each were rounded alone
  const TimeParts thirds = parts_of(nodes::VirtualTimes{.computing_ns = 1, .service_busy_ns = 1, .service_idle_ns = 1}, waits);
  CHECK(parts_text(thirds, waits) == "computing 33.3 %, service while busy 33.4 %, service while idle 33.3 %");
}

}  // namespace dmpc::apps::time_parts_test
