// What rank 0 sends the others before a run: whole, in order, and in bounded room.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "core/base/expect.h"
#include "nodes/ranks/dismissal.h"
#include "nodes/ranks/failure.h"
#include "nodes/ranks/heartbeats.h"
#include "nodes/ranks/repeated_runs.h"
#include "nodes/ranks/streams.h"
#include "tests/support/loopback_ranks.h"

namespace streams_test {

namespace {

using namespace dmpc;
using nodes::RankLinks;
using nodes::StreamFromHost;
using nodes::StreamsToRanks;

constexpr nodes::RankSilence impatient{.heartbeat = std::chrono::milliseconds{5}, .longest = std::chrono::milliseconds{100}};

/// Bytes of a rank's own.
std::vector<std::byte> bytes_for(std::uint32_t rank, std::size_t count) {
  std::vector<std::byte> bytes(count);
  for (std::size_t i = 0; i < count; ++i) {
    bytes[i] = static_cast<std::byte>(i * 7 + i / 251 + rank);
  }
  return bytes;
}

TEST_CASE("each rank reads its own stream, whole and in order, be it empty or longer than there is room for") {
  constexpr std::size_t window = nodes::stream_window_bytes;
  for (const std::uint32_t late_polls : {0U, 40U}) {
    for (const std::size_t bytes : {std::size_t{0}, std::size_t{1}, window, 3 * window + 1}) {
      CAPTURE(late_polls);
      CAPTURE(bytes);
      const auto results = tests::on_ranks(3, {.seed = 5, .late_polls_max = late_polls}, [&](nodes::Fabric& fabric) {
        RankLinks links(fabric);
        if (fabric.rank() == 0) {
          StreamsToRanks streams(links);
          for (const std::uint32_t rank : {1U, 2U}) {
            streams.write(rank, bytes_for(rank, bytes));
          }
          streams.finish();
          nodes::dismiss(links, 0);
          return true;
        }
        StreamFromHost stream(links);
        std::vector<std::byte> read(bytes);
        for (std::size_t first = 0; first < bytes; first += 1000) {
          stream.read(std::span(read).subspan(first, std::min<std::size_t>(1000, bytes - first)));
        }
        stream.say_ready();
        return nodes::wait_for_dismissal(links) == 0 && stream.bytes_read() == bytes && read == bytes_for(fabric.rank(), bytes);
      });
      for (const auto& result : results) {
        CHECK(result.failure_text() == "");
        CHECK(result.value == true);
      }
    }
  }
}

/// The nodes of a rank, as run_as_worker() has them: what they were told is noted, run by run.
struct Noted {
  std::string* heard;
  StreamFromHost* stream;

  bool is_repeated() const { return true; }
  void begin_again(std::string_view reported) { *heard += " again " + std::to_string(nodes::read_again<int>(reported)); }
  nodes::RunEnd run(std::stop_token) {
    stream->say_ready();
    return {};
  }
};

TEST_CASE("ranks make nodes of a job, run them again by each value that is handed out, and make others of the next job") {
  const auto results = tests::on_ranks(3, {.seed = 5}, [](nodes::Fabric& fabric) {
    RankLinks links(fabric);
    std::string heard;
    if (fabric.rank() == 0) {
      for (const int job : {1, 2}) {
        nodes::FlatWriter flat;
        flat.put(nodes::StreamKind::job);
        flat.put(job);
        StreamsToRanks streams(links);
        streams.write_counted_to_all(flat.take());
        streams.finish();
        nodes::hand_out_again(10 * job, links);
        nodes::hand_out_again(10 * job + 1, links);
      }
      nodes::dismiss(links, 0);
      return heard;
    }
    try {
      nodes::run_as_worker(links, {}, [&](std::string_view reported, StreamFromHost& stream) {
        nodes::FlatReader flat(reported);
        flat.take<nodes::StreamKind>();
        heard += " job " + std::to_string(flat.take<int>());
        return Noted{&heard, &stream};
      });
    } catch (const nodes::Dismissed&) {
      heard += " end";
    }
    return heard;
  });
  for (std::size_t rank : {1, 2}) {
    CHECK(results[rank].failure_text() == "");
    CHECK(results[rank].value == " job 1 again 10 again 11 job 2 again 20 again 21 end");
  }
}

TEST_CASE("what fails on a rank before the run fails on rank 0 with its name, and rank 0 then ends them all") {
  const auto results = tests::on_ranks(3, {}, [](nodes::Fabric& fabric) {
    RankLinks links(fabric);
    if (fabric.rank() == 0) {
      StreamsToRanks streams(links);
      CHECK_THROWS_WITH_AS(streams.write(2, bytes_for(2, 4 * nodes::stream_window_bytes)), "rank 2: no memory is left",
                           core::CapacityError);
      nodes::dismiss(links, 4);
      return 4;
    }
    if (fabric.rank() == 2) {
      nodes::say_failure(links, {nodes::FailureKind::room, "no memory is left"});
    }
    return nodes::wait_for_dismissal(links);
  });
  for (const auto& result : results) {
    CHECK(result.failure_text() == "");
    CHECK(result.value == 4);
  }
}

TEST_CASE("a rank that waits for its stream hears when rank 0 ends the command instead") {
  const auto results = tests::on_ranks(2, {}, [](nodes::Fabric& fabric) {
    RankLinks links(fabric);
    if (fabric.rank() == 0) {
      nodes::dismiss(links, 2);
      return 2;
    }
    try {
      std::byte byte{};
      StreamFromHost(links).read(std::span(&byte, 1));
    } catch (const nodes::Dismissed& dismissed) {
      return dismissed.status;
    }
    return 0;
  });
  CHECK(results[0].value == 2);
  CHECK(results[1].value == 2);
}

TEST_CASE("a rank that is dead is missed by those that wait for it before a run") {
  for (const std::uint32_t dead : {0U, 1U}) {
    const auto results = tests::on_ranks(2, {.dead_rank = dead}, [&](nodes::Fabric& fabric) {
      RankLinks links(fabric, impatient);
      if (fabric.rank() == 0) {
        StreamsToRanks(links).finish();
      } else {
        std::byte byte{};
        StreamFromHost(links).read(std::span(&byte, 1));
      }
      return true;
    });
    CHECK(results[1 - dead].failure_text() ==
          "rank " + std::to_string(dead) + " is lost: nothing has been heard of it for 100 ms");
  }
}

TEST_CASE("a rank that works for longer than others would wait shows that it lives") {
  const auto results = tests::on_ranks(2, {}, [](nodes::Fabric& fabric) {
    RankLinks links(fabric, impatient);
    if (fabric.rank() == 0) {
      const int worked = nodes::with_heartbeats(links, [] {
        std::this_thread::sleep_for(3 * impatient.longest);
        return 7;
      });
      nodes::dismiss(links, worked);
      return worked;
    }
    return nodes::wait_for_dismissal(links);
  });
  CHECK(results[0].value == 7);
  CHECK(results[1].value == 7);
}

TEST_CASE("what fails while others are shown that a rank lives fails here") {
  nodes::Loopback loopback(1);
  RankLinks links(loopback.rank(0));
  CHECK_THROWS_AS(nodes::with_heartbeats(links, []() -> int { throw core::InputError("there is no such file"); }),
                  core::InputError);
}

}  // namespace

}  // namespace streams_test
