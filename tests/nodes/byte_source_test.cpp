// Pieces of a whole that is here, or that comes as a stream of nothing else.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/expect.h"
#include "nodes/byte_source.h"

namespace byte_source_test {

namespace {

using namespace dmpc;
using nodes::ByteSource;
using nodes::PieceHeader;

constexpr std::array whole = {std::byte{10}, std::byte{11}, std::byte{12}, std::byte{13}, std::byte{14}};

/// What has been written, as it is read.
class WrittenBytes final : public nodes::ByteStream {
 public:
  void read(std::span<std::byte> into) override {
    std::copy_n(bytes_.begin() + read_, into.size(), into.begin());
    read_ += static_cast<std::ptrdiff_t>(into.size());
  }
  void write(std::span<const std::byte> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
  void write_piece(std::size_t offset, std::size_t bytes) {
    const PieceHeader header{offset, bytes};
    write(std::as_bytes(std::span(&header, 1)));
    write(std::span(whole).subspan(offset, bytes));
  }

 private:
  std::vector<std::byte> bytes_;
  std::ptrdiff_t read_ = 0;
};

std::vector<std::byte> piece_of(const ByteSource& source, std::size_t offset, std::size_t bytes) {
  std::vector<std::byte> piece(bytes);
  source.copy(offset, piece);
  return piece;
}

TEST_CASE("nothing is a piece of nothing") {
  ByteSource(std::span<const std::byte>()).copy(0, {});
  CHECK(ByteSource(std::span<const std::byte>()).size_bytes() == 0);
}

TEST_CASE("a piece is the same of bytes that are here and of a stream") {
  WrittenBytes stream;
  stream.write_piece(3, 2);
  stream.write_piece(0, 1);
  for (const ByteSource& source : {ByteSource(whole), ByteSource(stream, whole.size())}) {
    CHECK(source.size_bytes() == 5);
    CHECK(piece_of(source, 3, 2) == std::vector{std::byte{13}, std::byte{14}});
    CHECK(piece_of(source, 0, 1) == std::vector{std::byte{10}});
  }
}

TEST_CASE("a piece of a stream that is not the next one is an error, and no other piece's bytes") {
  WrittenBytes stream;
  stream.write_piece(0, 1);
  CHECK_THROWS_AS(piece_of(ByteSource(stream, whole.size()), 1, 1), core::InternalError);
}

TEST_CASE("what is here lasts, and nothing of a stream does") {
  CHECK(ByteSource(whole).immutable(1, 3).data() == whole.data() + 1);
  WrittenBytes stream;
  CHECK_THROWS_AS(ByteSource(stream, 1).immutable(0, 1), core::InternalError);
}

}  // namespace

}  // namespace byte_source_test
