// MPI's fabric keeps what nodes/ranks/fabric.h promises.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "nodes/chaos.h"
#include "nodes/ranks/frame.h"
#include "tests/mpi/here.h"
#include "tests/support/scaled.h"

namespace dmpc::tests::fabric_test {

namespace {

/// What the sender's frames to another rank are, one after the other: of seeded lengths, now and then the longest that there is.
class FramesOf {
 public:
  FramesOf(std::uint32_t from, std::uint32_t to) : stream_(core::mix(1000 * from + to)) {}

  /// The next one's number, then bytes that tell it from others.
  std::vector<std::byte> next(std::size_t longest) {
    const std::size_t bytes = stream_.below(4) == 0 ? longest : sizeof(number_) + stream_.below(200);
    const auto number = std::as_bytes(std::span(&number_, 1));
    std::vector<std::byte> frame(number.begin(), number.end());
    frame.resize(bytes, static_cast<std::byte>(stream_.below(256)));
    ++number_;
    return frame;
  }

 private:
  nodes::ChaosStream stream_;
  std::uint64_t number_ = 0;
};

/// Sends a number of frames at once to each other rank, and receives as many, as fast as there is space.
class Flood {
 public:
  Flood(const Here& here, std::size_t count) : here_(here), unsent_(here.rank_count(), count), untaken_(unsent_) {
    unsent_[here.rank()] = untaken_[here.rank()] = 0;
    for (std::uint32_t rank = 0; rank < here.rank_count(); ++rank) {
      out_.emplace_back(here.rank(), rank);
      in_.emplace_back(rank, here.rank());
    }
  }

  void run() {
    while (sum(unsent_) + sum(untaken_) > 0) {
      here_.for_others([this](std::uint32_t rank) { send(rank); });
      take();
    }
  }
  std::size_t wrong() const { return wrong_; }

 private:
  static std::size_t sum(const std::vector<std::size_t>& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
  }

  void send(std::uint32_t rank) {
    const std::span<std::byte> room = unsent_[rank] > 0 ? here_.fabric.room(rank) : std::span<std::byte>();
    if (!room.empty()) {
      const std::vector<std::byte> frame = out_[rank].next(room.size());
      std::copy(frame.begin(), frame.end(), room.begin());
      here_.fabric.send(rank, frame.size());
      --unsent_[rank];
    }
  }

  void take() {
    if (const auto arrival = here_.fabric.take()) {
      const std::vector<std::byte> expected = in_.at(arrival->rank).next(here_.fabric.frame_bytes());
      wrong_ += std::equal(expected.begin(), expected.end(), arrival->frame.begin(), arrival->frame.end()) ? 0 : 1;
      --untaken_[arrival->rank];
    }
  }

  const Here& here_;
  std::vector<std::size_t> unsent_, untaken_;  ///< by rank
  std::vector<FramesOf> out_, in_;
  std::size_t wrong_ = 0;
};

}  // namespace

TEST_CASE("frames of all ranks to all others at once come whole, and each sender's in order") {
  Flood flood(here(), scaled(2000));
  flood.run();
  CHECK(flood.wrong() == 0);
}

TEST_CASE("what is sent to a rank that takes nothing is not lost") {
  const Here& now = here();
  constexpr std::uint64_t polls_in_vain_max = 10'000;
  std::size_t sent = 0, taken = 0;
  for (std::uint64_t looks = 0; now.rank() != 0 && sent < 100 && looks < polls_in_vain_max; ++looks) {
    if (const std::span<std::byte> room = now.fabric.room(0); !room.empty()) {
      now.fabric.send(0, room.size());
      ++sent;
    }
  }
  std::size_t expected = 0;
  for (const std::string& count : apps::mpi_library().exchange(std::to_string(sent))) {
    expected += std::stoul(count);
  }
  while (now.rank() == 0 && taken < expected) {
    const auto arrival = now.fabric.take();
    taken += arrival ? 1 : 0;
    CHECK((!arrival || arrival->frame.size() == now.fabric.frame_bytes()));
  }
}

TEST_CASE("frames are as long as was asked for, and the least length otherwise") {
  CHECK(here().fabric.frame_bytes() == nodes::frame_bytes_for(40'000));
}

TEST_CASE("words of any length, none among them, are told to all by rank") {
  const Here& now = here();
  const auto word = [](std::uint32_t rank) { return std::string(std::size_t{rank} * 30'000, static_cast<char>('a' + rank)); };
  const std::vector<std::string> words = apps::mpi_library().exchange(word(now.rank()));
  REQUIRE(words.size() == now.rank_count());
  for (std::uint32_t rank = 0; rank < now.rank_count(); ++rank) {
    CHECK(words[rank] == word(rank));
  }
}

TEST_CASE("each rank is called by its number and host, and counts nodes for all") {
  const Here& now = here();
  CHECK(now.fabric.name_of(now.rank()) == now.group.name_of(now.rank()));
  CHECK(now.group.name_of(0).rfind("rank 0 on host ", 0) == 0);
  CHECK(now.group.name_of(0).size() > 15);
  CHECK(now.group.default_node_count() >= now.rank_count());
}

}  // namespace dmpc::tests::fabric_test
