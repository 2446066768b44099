#include "apps/render/checkpoints.h"

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "apps/render/checkpoint_file.h"
#include "core/base/expect.h"
#include "tests/support/child_process.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::checkpoints_test {

using tests::ChildProcess;
using tests::contains;
using tests::file_text;
using tests::TemporaryFolder;
using tests::write_text;

namespace {

const PictureIdentity small_identity{4, 2, {{"depth", "5"}}};

/// Keeps a picture of which `done` pixels are done.
void keep(const core::Continuation& continuation, std::uint32_t done) {
  core::PixelMask pixels(8);
  for (std::uint32_t pixel = 0; pixel < done; ++pixel) {
    pixels.add(pixel);
  }
  continuation.keep(core::Film(4, 2), core::Refinement({}, 1, 4, 2), pixels);
}

/// A render that keeps what it has fifty times a second, and goes on from what there is.
std::vector<std::string> render(const TemporaryFolder& folder, const std::vector<std::string>& more) {
  std::vector<std::string> command = {DMPC_PROGRAM,
                                      "render",
                                      "balls-3",
                                      "--resolution=96x96",
                                      "--checkpoint=" + (folder / "c").string(),
                                      "--checkpoint-every=0.02",
                                      "--resume",
                                      "--stats=" + (folder / "s").string(),
                                      "-o",
                                      folder / "a.exr"};
  command.insert(command.end(), more.begin(), more.end());
  return command;
}

std::string film_hash(const TemporaryFolder& folder) {
  const std::string json = file_text(folder / "s");
  const std::size_t place = json.find("\"film_hash\"");
  return place == std::string::npos ? "" : json.substr(place, 32);
}

/// Changes whenever a checkpoint is written.
ino_t identity_of_file(const std::filesystem::path& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? status.st_ino : 0;
}

/// Waits for the next checkpoint, or the picture; whether it is the former.
bool waits_for_checkpoint(const TemporaryFolder& folder) {
  const ino_t before = identity_of_file(folder / "c");
  for (int tries = 0; tries < 20'000 && !std::filesystem::exists(folder / "s"); ++tries) {
    if (const ino_t now = identity_of_file(folder / "c"); now != before && now != 0) {
      return true;
    }
    ::usleep(1000);
  }
  return false;
}

/// Computers for a picture that takes about a second.
const std::vector<std::vector<std::string>> computers = {{"--samples=16", "--strategy=svm", "--nodes=3"},
                                                         {"--samples=16", "--strategy=dataflow", "--nodes=2"},
                                                         {"--samples=16", "--strategy=replicated", "--nodes=2"},
                                                         {"--samples=16", "--strategy=dataflow", "--nodes=5", "--chaos=7"},
                                                         {"--samples=16", "--strategy=svm", "--page-size=4KiB"}};

}  // namespace

TEST_CASE("a checkpoint is due when its time has come, and then not for a while") {
  const TemporaryFolder folder;
  std::ostringstream messages;
  Checkpoints never({.file = folder / "a", .every_seconds = 1e6}, small_identity, messages, false);
  CHECK_FALSE(never.continuation().is_due());
  Checkpoints often({.file = folder / "a", .every_seconds = 1e-9}, small_identity, messages, false);
  CHECK(often.continuation().is_due());
  CHECK(messages.str().empty());
}

TEST_CASE("who resumes is told how far the picture was, unless quiet, or that there is none yet") {
  const TemporaryFolder folder;
  std::ostringstream messages;
  const CheckpointOptions options{.file = folder / "a", .resumes = true};
  Checkpoints first(options, small_identity, messages, false);
  CHECK(contains(messages.str(), "yet: starting from the beginning"));
  CHECK(first.continuation().start == nullptr);
  keep(first.continuation(), 3);
  Checkpoints second(options, small_identity, messages, false);
  CHECK(contains(messages.str(), "3 of 8 pixels of pass 1 are done"));
  REQUIRE(second.continuation().start != nullptr);
  CHECK(second.continuation().start->done.count() == 3);
  CHECK(second.samples_found_done() == 3);
  messages.str("");
  const Checkpoints quiet(options, small_identity, messages, true);
  CHECK(messages.str().empty());
}

TEST_CASE("in the end the checkpoint is removed, with what a killed process has left") {
  const TemporaryFolder folder;
  std::ostringstream messages;
  Checkpoints checkpoints({.file = folder / "a"}, small_identity, messages, false);
  keep(checkpoints.continuation(), 1);
  write_text(next_name(folder / "a"), "half");
  checkpoints.finish();
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("a checkpoint behind a symbolic link is removed, and the link stays") {
  const TemporaryFolder folder;
  std::ostringstream messages;
  write_text(folder / "file", "");
  std::filesystem::create_symlink(folder / "file", folder / "link");
  Checkpoints checkpoints({.file = folder / "link"}, small_identity, messages, false);
  keep(checkpoints.continuation(), 1);
  checkpoints.finish();
  CHECK_FALSE(std::filesystem::exists(folder / "file"));
  CHECK(std::filesystem::is_symlink(folder / "link"));
}

TEST_CASE("there is one to go on from when one was written or read") {
  const TemporaryFolder folder;
  std::ostringstream messages;
  const CheckpointOptions options{.file = folder / "a", .resumes = true};
  Checkpoints first(options, small_identity, messages, true);
  CHECK_FALSE(first.has_one());
  keep(first.continuation(), 1);
  CHECK(first.has_one());
  CHECK(Checkpoints(options, small_identity, messages, true).has_one());
}

TEST_CASE("a checkpoint that cannot be written is a warning") {
  const TemporaryFolder folder;
  std::ostringstream messages;
  std::filesystem::create_directory(folder / "b");
  std::stop_source stop;
  Checkpoints checkpoints({.file = folder / "b" / "a"}, small_identity, messages, false, stop.get_token());
  const core::Continuation continuation = checkpoints.continuation();
  std::filesystem::remove(folder / "b");
  keep(continuation, 1);
  CHECK(contains(messages.str(), "cannot be written"));
  CHECK(contains(messages.str(), "the render goes on"));
  CHECK_FALSE(checkpoints.has_one());
  messages.str("");
  stop.request_stop();
  keep(continuation, 1);
  CHECK(contains(messages.str(), "cannot be written"));
  CHECK_FALSE(contains(messages.str(), "the render goes on"));
}

TEST_CASE("a checkpoint that is there is not written over unasked") {
  const TemporaryFolder folder;
  write_text(folder / "a", "precious");
  CHECK_THROWS_WITH_AS(claim_checkpoint({.file = folder / "a"}), doctest::Contains("continue from it with --resume"),
                       core::InputError);
  CHECK(claim_checkpoint({.file = folder / "a", .resumes = true}).has_value());
  CHECK(claim_checkpoint({.file = folder / "b"}).has_value());
  CHECK_FALSE(claim_checkpoint({}).has_value());
  CHECK_THROWS_AS(claim_checkpoint({.file = folder / "none" / "a"}), core::InputError);
  CHECK_THROWS_WITH_AS(claim_checkpoint({.file = "/dev/full"}), doctest::Contains("pipe or device"), core::InputError);
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("a symbolic link to itself is bad input") {
  const TemporaryFolder folder;
  std::filesystem::create_symlink(folder / "a", folder / "a");
  const CheckpointOptions options{.file = folder / "a", .resumes = true};
  std::ostringstream messages;
  CHECK_THROWS_WITH_AS(claim_checkpoint(options), doctest::Contains("leads round in a circle"), core::InputError);
  CHECK_THROWS_AS(Checkpoints(options, small_identity, messages, true), core::InputError);
}

TEST_CASE("two renders cannot have their checkpoints in one file, by whatever names") {
  const TemporaryFolder folder;
  write_text(folder / "a", "");
  std::filesystem::create_symlink(folder / "a", folder / "link");
  {
    const auto lock = claim_checkpoint({.file = folder / "a", .resumes = true});
    for (const char* const name : {"a", "link"}) {
      CHECK_THROWS_WITH_AS(claim_checkpoint({.file = folder / name, .resumes = true}),
                           doctest::Contains("another dmpc writes its checkpoint there"), core::InputError);
    }
  }
  CHECK(claim_checkpoint({.file = folder / "link", .resumes = true}).has_value());
  CHECK(folder.entry_count() == 2);
}

TEST_CASE("a render that is killed again and again comes to the same film, whatever computers go on with it") {
  const TemporaryFolder folder, undisturbed;
  REQUIRE(ChildProcess(render(undisturbed, computers[2])).status() == 0);
  CHECK_FALSE(std::filesystem::exists(undisturbed / "c"));
  std::mt19937 random(20261122);
  std::size_t kills = 0;
  for (; kills < 8; ++kills) {
    ChildProcess process(render(folder, computers[kills % computers.size()]));
    if (!waits_for_checkpoint(folder)) {
      break;
    }
    ::usleep(static_cast<useconds_t>(random() % 30'000));
    process.send(SIGKILL);
    process.status();
  }
  CHECK(kills > 1);
  ChildProcess last(render(folder, computers[3]));
  REQUIRE(last.status() == 0);
  CHECK(film_hash(folder) == film_hash(undisturbed));
  CHECK_FALSE(std::filesystem::exists(folder / "c"));
}

TEST_CASE("a render that is interrupted before its first checkpoint does not speak of one") {
  const TemporaryFolder folder;
  for (const int signal : {SIGINT, SIGQUIT, SIGALRM}) {
    ChildProcess process({DMPC_PROGRAM, "render", "balls-4", "--strategy=dataflow", "--samples=1024",
                          "--checkpoint=" + (folder / "c").string(), "-o", folder / "a.exr"});
    for (int tries = 0; tries < 6000 && !std::filesystem::exists(folder / ".dmpc-lock-c"); ++tries) {
      ::usleep(10'000);
    }
    process.send(signal);
    CHECK(process.status() == 130);
    CHECK_FALSE(contains(process.errors(), "--resume"));
    CHECK(folder.entry_count() == 0);
  }
}

TEST_CASE("a render that is interrupted, or whose terminal is closed, keeps a checkpoint and says how to go on") {
  for (const int signal : {SIGINT, SIGHUP}) {
    const TemporaryFolder folder;
    ChildProcess process(render(folder, {"--samples=4096"}));
    REQUIRE(waits_for_checkpoint(folder));
    process.send(signal);
    CHECK(process.status() == 130);
    CHECK(contains(process.errors(), "interrupted, no picture was written; --resume continues from the checkpoint"));
    CHECK(folder.entry_count() == 1);
  }
}

TEST_CASE("a checkpoint of other settings is refused by the program, which says what differs") {
  const TemporaryFolder folder;
  ChildProcess process(render(folder, {"--samples=4096"}));
  REQUIRE(waits_for_checkpoint(folder));
  process.send(SIGKILL);
  process.status();
  ChildProcess other(render(folder, {"--samples=4096", "--depth=4"}));
  CHECK(other.status() == 1);
  CHECK(contains(other.errors(), "of another picture: depth is 5, here 4"));
}

}  // namespace dmpc::apps::checkpoints_test
