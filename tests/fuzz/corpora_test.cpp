// What fuzzers ever found worth keeping, read by the readers as they ship.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "tests/fuzz/targets.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::fuzz::corpora_test {

namespace {

using Target = void (*)(const std::uint8_t* data, std::size_t size);

/// Every input of the corpus of that name.
void replay(const std::string& name, Target attempt) {
  covered() = tests::Coverage(name);
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(DMPC_SOURCE_DIR "/tests/fuzz/corpus/" + name)) {
    CAPTURE(entry.path());
    const std::string input = tests::file_text(entry.path());
    REQUIRE_NOTHROW(attempt(reinterpret_cast<const std::uint8_t*>(input.data()), input.size()));
    ++count;
  }
  CHECK(count > 0);
  for (const std::string& kind : covered().blind_spots()) {
    FAIL_CHECK("never: ", kind);
  }
}

}  // namespace

TEST_CASE("what is kept for the fuzzer checkpoint is refused or as promised") { replay("checkpoint", try_checkpoint); }
TEST_CASE("what is kept for the fuzzer gltf is refused or as promised") { replay("gltf", try_gltf); }
TEST_CASE("what is kept for the fuzzer machine is refused or as promised") { replay("machine", try_machine); }
TEST_CASE("what is kept for the fuzzer mesh is refused or as promised") { replay("mesh", try_mesh); }
TEST_CASE("what is kept for the fuzzer mesh_text is refused or as promised") { replay("mesh_text", try_mesh_text); }
TEST_CASE("what is kept for the fuzzer nff is refused or as promised") { replay("nff", try_nff); }
TEST_CASE("what is kept for the fuzzer pbrt is refused or as promised") { replay("pbrt", try_pbrt); }
TEST_CASE("what is kept for the fuzzer picture is refused or as promised") { replay("picture", try_picture); }
TEST_CASE("what is kept for the fuzzer polygon is refused or as promised") { replay("polygon", try_polygon); }
TEST_CASE("what is kept for the fuzzer reply is refused or as promised") { replay("reply", try_reply); }

}  // namespace dmpc::fuzz::corpora_test
