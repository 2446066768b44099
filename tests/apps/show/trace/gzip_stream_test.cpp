#include "apps/show/trace/gzip_stream.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <sstream>
#include <string>

#include "tests/support/child_process.h"

namespace dmpc::apps::gzip_stream_test {

using tests::ChildProcess;
using tests::TemporaryFolder;

namespace {

std::string packed(const std::string& text) {
  std::ostringstream output;
  GzipStream stream(output);
  for (const char c : text) {
    stream << c;
  }
  stream.finish();
  CHECK(stream.good());
  return output.str();
}

/// By gzip, its status in front.
std::string unpacked(const std::string& bytes) {
  const TemporaryFolder folder;
  tests::write_text(folder / "a.gz", bytes);
  ChildProcess gzip({"/bin/gzip", "-dc", (folder / "a.gz").string()});
  const int status = gzip.status();
  return std::to_string(status) + " " + gzip.output();
}

/// A device that is full.
struct Full final : std::streambuf {
  int overflow(int /*character*/) override { return traits_type::eof(); }
};

}  // namespace

TEST_CASE("gzip unpacks what was packed, none, one byte, or more than is kept at a time") {
  std::string much;
  for (std::uint64_t i = 0; i < 60'000; ++i) {
    much += std::to_string(i * i % 7919) + ",";
  }
  for (const std::string& text : {std::string(), std::string("a"), much}) {
    CHECK(unpacked(packed(text)) == "0 " + text);
  }
  CHECK(packed(much).size() < much.size() / 2);
}

TEST_CASE("equal texts are packed into equal bytes, and nothing says when") {
  const std::string bytes = packed("abc");
  CHECK(bytes == packed("abc"));
  CHECK(bytes.substr(0, 4) == "\x1f\x8b\x08" + std::string(1, '\0'));
  CHECK(bytes.substr(4, 4) == std::string(4, '\0'));
}

TEST_CASE("where nothing can be written the stream fails, and so does what it writes to") {
  Full full;
  std::ostream output(&full);
  GzipStream stream(output);
  stream << std::string(1'000'000, 'a');
  stream.finish();
  CHECK_FALSE(stream.good());
  CHECK_FALSE(output.good());
}

}  // namespace dmpc::apps::gzip_stream_test
