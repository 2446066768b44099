#include "nodes/immutable_pieces.h"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <span>

#include "core/base/expect.h"

namespace dmpc::nodes::immutable_pieces_test {
namespace {

constexpr std::size_t piece_bytes = 64;

/// A program's use of memory.
enum class PieceUse : std::uint8_t { pieces };

/// Room for three pieces.
struct PieceRoom {
  static MemoryPlan plan() { return ImmutablePieces::layout(PieceUse::pieces, 3 * piece_bytes); }

  explicit PieceRoom(Immutable immutable)
      : memory(plan(), immutable), pieces(memory, PieceUse::pieces, 3 * piece_bytes, piece_bytes) {}

  LocalMemory memory;
  ImmutablePieces pieces;
};

std::array<std::byte, 2 * piece_bytes> numbers() {
  std::array<std::byte, 2 * piece_bytes> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<std::byte>(i);
  }
  return bytes;
}

}  // namespace

TEST_CASE("pieces that last are copied, or stay where they are, and take the same of a node's memory") {
  const auto bytes = numbers();
  const std::span<const std::byte> first = std::span(bytes).first(piece_bytes), second = std::span(bytes).last(piece_bytes);
  for (const Immutable immutable : {Immutable::is_copied, Immutable::is_referred_to}) {
    PieceRoom room(immutable);
    room.pieces.put(0, first);
    room.pieces.put(2, first);
    room.pieces.put(2, second);
    CHECK(std::memcmp(room.pieces.at(0), first.data(), piece_bytes) == 0);
    CHECK(std::memcmp(room.pieces.at(2), second.data(), piece_bytes) == 0);
    CHECK((room.pieces.at(2) == second.data()) == (immutable == Immutable::is_referred_to));
    CHECK(room.memory.used().bytes == room.memory.plan().bytes);
  }
}

TEST_CASE("a piece of another size is refused, wherever it would be kept") {
  const auto bytes = numbers();
  for (const Immutable immutable : {Immutable::is_copied, Immutable::is_referred_to}) {
    PieceRoom room(immutable);
    CHECK_THROWS_AS(room.pieces.put(0, std::span(bytes).first(piece_bytes - 1)), core::InternalError);
    CHECK_THROWS_AS(room.pieces.put(0, bytes), core::InternalError);
  }
}

TEST_CASE("of the real computer no room is asked for pieces that are referred to") {
  constexpr std::size_t petabyte = std::size_t{1} << 50U;
  MemoryPlan plan = ImmutablePieces::layout(PieceUse::pieces, petabyte);
  plan[Category::queues] = 64;
  LocalMemory memory(plan, Immutable::is_referred_to);
  const ImmutablePieces pieces(memory, PieceUse::pieces, petabyte, petabyte);
  CHECK(memory.used()[PieceUse::pieces] == petabyte);
  CHECK(memory.allocate<std::byte>(Category::queues, 64).size() == 64);
  CHECK_THROWS_AS(ImmutablePieces(memory, PieceUse::pieces, 64, 64), core::InternalError);
}

TEST_CASE("one piece is kept with what must be readable behind it") {
  const auto bytes = numbers();
  for (const Immutable immutable : {Immutable::is_copied, Immutable::is_referred_to}) {
    LocalMemory memory(PieceRoom::plan(), immutable);
    const auto there = kept(memory, PieceUse::pieces, std::span(bytes).first(piece_bytes), 32);
    CHECK(there.size() == piece_bytes);
    CHECK((there.data() == bytes.data()) == (immutable == Immutable::is_referred_to));
    CHECK(memory.used()[PieceUse::pieces] == 2 * piece_bytes);
  }
}

}  // namespace dmpc::nodes::immutable_pieces_test
