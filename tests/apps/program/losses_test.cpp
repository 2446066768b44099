// What is lost when something cannot be written: that, and nothing else.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/picture/image_file.h"
#include "tests/support/child_process.h"
#include "tests/support/painted_square.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::program_losses_test {

namespace {

namespace fs = std::filesystem;

/// A line of bash; $dmpc is the program, and $folder the folder.
ChildProcess in_bash(const std::string& line, const TemporaryFolder& folder) {
  return ChildProcess(
      {"/bin/bash", "-c", "set -o pipefail; dmpc='" DMPC_PROGRAM "'; folder='" + folder.path().string() + "'; " + line});
}

bool waits_for(const fs::path& path) {
  for (int tries = 0; tries < 6000 && !fs::exists(path); ++tries) {
    ::usleep(10'000);
  }
  return fs::exists(path);
}

}  // namespace

TEST_CASE("a trace that cannot be written to its end takes nothing with it, and is said") {
  const TemporaryFolder folder;
  const std::string pipe = folder / "trace.pftrace";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ChildProcess process = in_bash(
      "exec $dmpc render balls-1 --resolution=64x64 --nodes=4 --trace=$folder/trace.pftrace --stats=$folder/s.json "
      "--heatmap=rays:$folder/rays.png -o $folder/a.exr",
      folder);
  CHECK(waits_for(folder / "s.json"));
  ::usleep(200'000);  // so that the pipe is full
  ::close(reader);
  CHECK(process.status() == 1);
  CHECK(contains(process.errors(), "--trace " + pipe + ": cannot be written: Broken pipe"));
  CHECK(contains(process.output(), "picture  "));
  CHECK(apps::read_image(folder / "a.exr").width == 64);
  CHECK(contains(file_text(folder / "s.json"), "film_hash"));
  CHECK(apps::read_image(folder / "rays.png").width > 64);
  CHECK(folder.entry_count() == 4);
}

TEST_CASE("what is known beforehand is said before the render, and nothing is left") {
  const TemporaryFolder folder;
  const std::vector<std::vector<std::string>> lines = {
      {"TMPDIR=$folder/none exec $dmpc render tetra-1 --report=$folder/r.html -o $folder/a.png", "set TMPDIR"},
      {"exec $dmpc render tetra-1 -o $folder/a.png >&-", "standard output"},
      {"exec $dmpc render tetra-1 --stats=$folder/$(printf '%256s' | tr ' ' a) -o $folder/a.png", "this name is too long"}};
  for (const std::vector<std::string>& line : lines) {
    CAPTURE(line[0]);
    ChildProcess process = in_bash(line[0], folder);
    CHECK(process.status() == 1);
    CHECK_MESSAGE(contains(process.errors(), line[1]), process.errors());
    CHECK(folder.entry_count() == 0);
  }
}

#ifdef DMPC_LATE_SIGNAL
TEST_CASE("a signal behind the last pixel takes what follows the picture, and not the picture") {
  const TemporaryFolder folder;
  ChildProcess process =
      in_bash("LD_PRELOAD=" DMPC_LATE_SIGNAL
              " exec $dmpc render tetra-1 --resolution=8x8 --checkpoint=$folder/c --stats=$folder/s.json -o $folder/a.exr",
              folder);
  CHECK(process.status() == 130);
  CHECK_MESSAGE(contains(process.errors(), "the picture was written, the other outputs are incomplete"), process.errors());
  CHECK(apps::read_image(folder / "a.exr").width == 8);
  CHECK(folder.entry_count() == 1);
}
#endif

TEST_CASE("with the standard streams closed nothing that is said gets into a picture") {
  const TemporaryFolder folder;
  ChildProcess process = in_bash("exec $dmpc render tetra-1 --resolution=8x8 --quiet -o $folder/a.exr <&- >&- 2>&-", folder);
  CHECK(process.status() == 0);
  CHECK(apps::read_image(folder / "a.exr").width == 8);
}

TEST_CASE("a limit on the size of files leaves no part of one") {
  const TemporaryFolder folder;
  for (const std::string name : {"a.png", "a.exr", "a.rla"}) {
    ChildProcess process = in_bash("ulimit -f 1; exec $dmpc render balls-1 --resolution=64x64 -o $folder/" + name, folder);
    CHECK(process.status() == 1);
    CHECK(contains(process.errors(), "cannot be written"));
    CHECK(folder.entry_count() == 0);
  }
}

TEST_CASE("who reads no more ends what is written there, without a word") {
  const TemporaryFolder folder;
  ChildProcess process = in_bash("$dmpc scene tetra-9 | head -n 1", folder);
  CHECK(process.status() == 128 + SIGPIPE);
  CHECK(process.errors().empty());
}

TEST_CASE("an output that the scene was read from is refused before it is written over") {
  const TemporaryFolder folder;
  const fs::path scene = write_painted_square(folder, 4);
  const std::string paint = file_text(folder / "paint.png");
  ChildProcess process({DMPC_PROGRAM, "render", scene, "-o", folder / "paint.png"});
  CHECK(process.status() == 2);
  CHECK(contains(process.errors(), "this is the same file as the scene's"));
  CHECK(file_text(folder / "paint.png") == paint);
}

}  // namespace dmpc::tests::program_losses_test
