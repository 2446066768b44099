// Frames by the program itself: files, what is there already, and what is refused.
#include <doctest/doctest.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::render_frames_test {

namespace fs = std::filesystem;

namespace {

/// A render of a small picture, with its files in the folder.
std::vector<std::string> line(const TemporaryFolder& folder, const std::vector<std::string>& words) {
  std::vector<std::string> command = {DMPC_PROGRAM, "render", "balls-2", "--resolution=16x16", "--nodes=3"};
  for (std::string word : words) {
    const std::size_t place = word.find('@');
    command.push_back(place == std::string::npos ? word : word.replace(place, 1, folder.path().string() + "/"));
  }
  return command;
}

Said render(const TemporaryFolder& folder, const std::vector<std::string>& words) { return run(line(folder, words)); }

/// What a file of counters has first under a key, without quotes.
std::string value_of(const fs::path& file, const std::string& key) {
  const std::string json = file_text(file);
  const std::size_t place = json.find('"' + key + "\": ");
  REQUIRE_MESSAGE(place != std::string::npos, key);
  std::string value = json.substr(place + key.size() + 4, json.find_first_of(",}\n", place) - place - key.size() - 4);
  std::erase(value, '"');
  return value;
}

}  // namespace

TEST_CASE("frames leave a picture each, and each is, byte by byte, the picture of the frame alone") {
  const TemporaryFolder folder;
  const Said all = render(folder, {"--frames=4", "--turntable=10", "-o", "@a.####.png", "--stats=@a.%d.json"});
  REQUIRE_MESSAGE(all.status == 0, all.errors);
  CHECK(folder.entry_count() == 8);
  CHECK(contains(all.output, "frame 4  "));
  for (const std::string strategy : {"svm", "dataflow", "forest", "replicated"}) {
    const Said part = render(folder, {"--frames=2..3", "--turntable=10", "--strategy=" + strategy, "-o", "@b.####.png"});
    REQUIRE_MESSAGE(part.status == 0, part.errors);
    CHECK(file_text(folder / "b.0002.png") == file_text(folder / "a.0002.png"));
    CHECK(file_text(folder / "b.0003.png") == file_text(folder / "a.0003.png"));
    fs::remove(folder / "b.0002.png");
    fs::remove(folder / "b.0003.png");
  }
  REQUIRE(render(folder, {"--frames=3..3", "--turntable=10", "-o", "@alone.png"}).status == 0);
  CHECK(file_text(folder / "alone.png") == file_text(folder / "a.0003.png"));
  REQUIRE(render(folder, {"-o", "@own.png"}).status == 0);
  CHECK(file_text(folder / "own.png") == file_text(folder / "a.0001.png"));
  CHECK(file_text(folder / "a.0001.png") != file_text(folder / "a.0002.png"));
}

TEST_CASE("each frame has a heat map of its own, the same on a modelled machine as of that frame alone") {
  const TemporaryFolder folder;
  const Said all = render(folder, {"--frames=2", "--turntable=9", "--runner=virtual", "--heatmap=done:@s#.png", "-o", "@a#.png"});
  REQUIRE_MESSAGE(all.status == 0, all.errors);
  CHECK(file_text(folder / "s1.png") != file_text(folder / "s2.png"));
  const Said one =
      render(folder, {"--frames=1..1", "--turntable=9", "--runner=virtual", "--heatmap=done:@s.png", "-o", "@a.png"});
  REQUIRE_MESSAGE(one.status == 0, one.errors);
  CHECK(file_text(folder / "s.png") == file_text(folder / "s1.png"));
  CHECK(contains(render(folder, {"--frames=2", "--turntable=9", "--heatmap=done:@s.png", "-o", "@b#.png"}).errors, "--heatmap="));
}

TEST_CASE("a frame that equals the one before is a copy of it, says so, and counts nothing, on every computer") {
  for (const std::string computer : {"--strategy=svm", "--strategy=dataflow", "--strategy=forest", "--strategy=replicated",
                                     "--runner=pool", "--runner=virtual"}) {
    CAPTURE(computer);
    const TemporaryFolder folder;
    const Said said = render(folder, {computer, "--frames=3", "--turntable=0", "--stats=@a.#.json", "-o", "@a.#.png"});
    REQUIRE_MESSAGE(said.status == 0, said.errors);
    CHECK(file_text(folder / "a.1.png") == file_text(folder / "a.2.png"));
    CHECK(file_text(folder / "a.1.png") == file_text(folder / "a.3.png"));
    CHECK_FALSE(contains(said.output.substr(0, said.output.find('\n')), "copy"));
    CHECK(contains(said.output, "a.3.png, film " + value_of(folder / "a.1.json", "film_hash") + ", a copy of frame 1\n"));
    const std::size_t note = said.errors.find("a frame that equals the one before it is not rendered again");
    REQUIRE(note != std::string::npos);
    CHECK(said.errors.find("a frame that equals", note + 1) == std::string::npos);  // said once
    CHECK(value_of(folder / "a.1.json", "copied_frame") == "null");
    CHECK(value_of(folder / "a.1.json", "primary") != "0");
    CHECK(value_of(folder / "a.3.json", "copied_frame") == "1");
    CHECK(value_of(folder / "a.3.json", "primary") == "0");
    CHECK(value_of(folder / "a.3.json", "run_hash") == "null");
  }
}

TEST_CASE("only frames in a row are copies, and none is if it is not wanted or if a heat map is made of each") {
  const TemporaryFolder folder;
  write_text(folder / "path", "2 4,1,3/0,0,0/0,0,1/30\n3 4,1,3/0,0,0/0,0,1/30\n4 1,4,3/0,0,0/0,0,1/30\n");
  const Said path = render(folder, {"--frames=2..4", "--camera-path=@path", "-o", "@a#.png"});
  REQUIRE_MESSAGE(path.status == 0, path.errors);
  CHECK(contains(path.output, "frame 3  " + (folder / "a3.png").string() + ", film "));
  CHECK(count(path.output, "a copy of frame 2") == 1);
  CHECK(count(path.output, "a copy of") == 1);
  CHECK(file_text(folder / "a2.png") == file_text(folder / "a3.png"));
  CHECK(file_text(folder / "a3.png") != file_text(folder / "a4.png"));
  const std::vector<std::string> still = {"--frames=2", "--turntable=0", "--stats=@b#.json", "-o", "@b#.png"};
  for (const std::string word : {"--no-skip=equal-frames", "--no-skip=all", "--heatmap=rays:@s#.png"}) {
    CAPTURE(word);
    std::vector<std::string> words = still;
    words.push_back(word);
    const Said said = render(folder, words);
    REQUIRE_MESSAGE(said.status == 0, said.errors);
    CHECK(count(said.output + said.errors, "equals the one before") + count(said.output, "a copy of") == 0);
    CHECK(value_of(folder / "b2.json", "primary") == value_of(folder / "b1.json", "primary"));
    CHECK(file_text(folder / "b1.png") == file_text(folder / "b2.png"));
    fs::remove(folder / "b1.png");
    fs::remove(folder / "b2.png");
  }
}

TEST_CASE("a resumed frame is rendered though it equals one that is there, since that file may be anything") {
  const TemporaryFolder folder;
  write_text(folder / "a1.png", "precious");
  const Said said = render(folder, {"--frames=3", "--turntable=0", "--resume", "--checkpoint=@c", "-o", "@a#.png"});
  REQUIRE_MESSAGE(said.status == 0, said.errors);
  CHECK(count(said.output, "a copy of frame 2") == 1);
  CHECK(file_text(folder / "a2.png") == file_text(folder / "a3.png"));
  CHECK(file_text(folder / "a2.png") != "precious");
  CHECK(folder.entry_count() == 3);
}

TEST_CASE("a keyframe's picture is that of --camera") {
  const TemporaryFolder folder;
  write_text(folder / "path", "2 4,1,3/0,0,0/0,0,1/30\n9 1,4,3/0,0,0/0,0,1/30\n");
  const Said said = render(folder, {"--frames=8..9", "--camera-path=@path", "-o", "@a#.exr"});
  REQUIRE_MESSAGE(said.status == 0, said.errors);
  REQUIRE(render(folder, {"--camera=1,4,3/0,0,0/0,0,1/30", "-o", "@b.exr"}).status == 0);
  CHECK(file_text(folder / "b.exr") == file_text(folder / "a9.exr"));
}

TEST_CASE("a frame whose picture is there is never written over: it is an error, or with --resume left as it is") {
  const TemporaryFolder folder;
  write_text(folder / "a.02.png", "precious");
  const std::vector<std::string> words = {"--frames=3", "--turntable=1", "-o", "@a.##.png"};
  const Said refused = render(folder, words);
  CHECK(refused.status == 1);
  CHECK(contains(refused.errors, "a.02.png: the picture of this frame is there already: skip what is there with --resume"));
  CHECK(folder.entry_count() == 1);
  std::vector<std::string> resumed = words;
  resumed.push_back("--resume");
  const Said done = render(folder, resumed);
  CHECK_MESSAGE(done.status == 0, done.errors);
  CHECK(contains(done.errors, "1 frame of 3 is there and is skipped"));
  CHECK(folder.entry_count() == 3);
  CHECK(file_text(folder / "a.02.png") == "precious");
  CHECK(render(folder, resumed).status == 0);
}

TEST_CASE("frames on a modelled machine tell virtual time and run hash, the first one those of the frame alone") {
  const TemporaryFolder folder;
  const std::vector<std::string> machine = {"--runner=virtual", "--turntable=2", "--frames=2", "--stats=@a.#.json", "-o",
                                            "@a.#.png"};
  REQUIRE(render(folder, machine).status == 0);
  std::vector<std::string> alone = machine;
  alone[2] = "--frames=1..1";
  alone[3] = "--stats=@b.#.json";
  alone[5] = "@b.#.png";
  REQUIRE(render(folder, alone).status == 0);
  const auto run_hash = [&](const char* file) {
    const std::string json = file_text(folder / file);
    const std::size_t place = json.find("\"run_hash\"");
    return json.substr(place, 40);
  };
  CHECK(run_hash("a.1.json") == run_hash("b.1.json"));
  CHECK(run_hash("a.2.json") != run_hash("b.1.json"));
}

TEST_CASE("what frames cannot do is refused, and says what can be done") {
  const TemporaryFolder folder;
  struct Refusal {
    std::vector<std::string> words;
    const char* says;
  };
  const std::vector<std::string> three = {"--frames=3", "--turntable=1", "-o", "@a.#.png"};
  const auto with = [&](const std::string& word) {
    std::vector<std::string> words = three;
    words.push_back(word);
    return words;
  };
  const std::vector<Refusal> refusals = {
      {{"--frames=3", "--turntable=1", "-o", "@a.png"}, "for several frames expected a placeholder for the frame's number"},
      {{"--frames=0", "--turntable=1", "-o", "@a.#.png"}, "--frames=0: expected how many frames"},
      {{"--frames=3", "-o", "@a.#.png"}, "expected also --turntable=DEGREES or --camera-path=FILE"},
      {{"--turntable=3", "-o", "@a.png"}, "--turntable goes with --frames"},
      {{"--frames=3", "--turntable=1", "--camera-path=@p", "-o", "@a.#.png"}, "the camera moves in one way"},
      {with("--stats=@a.json"), "--stats="},
      {with("--report=@a.html"), "--report does not go with several frames"},
      {with("--trace=@a.pftrace"), "--trace does not go with several frames"},
      {{"--frames=3", "--turntable=361", "-o", "@a.#.png"}, "expected degrees"}};
  for (const Refusal& refusal : refusals) {
    const Said said = render(folder, refusal.words);
    CHECK_MESSAGE(said.status == 2, refusal.says << " " << said.errors);
    CHECK_MESSAGE(contains(said.errors, refusal.says), said.errors);
  }
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("more frames than the disk holds are told beforehand, and begun") {
  const TemporaryFolder folder;
  ChildProcess process(line(folder, {"--frames=1000000000", "--turntable=0.001", "-o", "@a.#.exr"}));
  for (int tries = 0; tries < 6000 && !fs::exists(folder / "a.2.exr"); ++tries) {
    ::usleep(10'000);
  }
  process.send(SIGTERM);
  CHECK(process.status() == 130);
  CHECK(contains(process.errors(), "pictures of 1,000,000,000 frames take up to"));
  const bool is_said_of_frame =
                 contains(process.errors(), "this frame was not written, the frames before it were; --resume skips them"),
             is_said_of_picture = contains(process.errors(), "picture was ");  // the signal came while one was written
  CHECK((is_said_of_frame || is_said_of_picture));
  CHECK(fs::exists(folder / "a.2.exr"));
}

TEST_CASE("the checkpoint of the last frame goes, where all frames are there, and that of another picture stays") {
  const TemporaryFolder folder;
  const std::vector<std::string> words = {"--frames=2", "--turntable=7", "--samples=256", "-o", "@a.#.exr"};
  REQUIRE(render(folder, words).status == 0);
  std::vector<std::string> resumed = words;
  resumed.insert(resumed.end(), {"--checkpoint=@c", "--resume"});
  fs::rename(folder / "a.2.exr", folder / "kept.exr");
  for (int tries = 0; tries < 100 && !fs::exists(folder / "c"); ++tries) {
    std::vector<std::string> killed = resumed;
    killed.push_back("--checkpoint-every=0.001");
    ChildProcess process(line(folder, killed));
    for (int looks = 0; looks < 60'000 && !fs::exists(folder / "c") && !fs::exists(folder / "a.2.exr"); ++looks) {
      ::usleep(1'000);
    }
    process.send(SIGKILL);
    process.status();
    fs::remove(folder / "a.2.exr");
  }
  fs::rename(folder / "kept.exr", folder / "a.2.exr");
  const std::string checkpoint = file_text(folder / "c");
  REQUIRE(!checkpoint.empty());
  CHECK(render(folder, resumed).status == 0);
  CHECK_FALSE(fs::exists(folder / "c"));
  write_text(folder / "c", checkpoint);
  resumed[2] = "--samples=255";
  CHECK(render(folder, resumed).status == 0);
  CHECK(file_text(folder / "c") == checkpoint);
}

TEST_CASE("frames that are killed again and again are those of one run, whole or not there") {
  const TemporaryFolder folder;
  REQUIRE(render(folder, {"--frames=5", "--turntable=7", "--samples=16", "-o", "@whole.#.exr"}).status == 0);
  int status = -1;
  for (int tries = 0; tries < 40 && status != 0; ++tries) {
    ChildProcess process(line(folder, {"--frames=5", "--turntable=7", "--samples=16", "--checkpoint=@c", "--resume",
                                       "--checkpoint-every=0.001", "-o", "@part.#.exr"}));
    ::usleep(static_cast<useconds_t>(40'000 + 20'000 * tries));
    process.send(SIGKILL);
    status = process.status();
  }
  if (status != 0) {  // on a busy machine none came to its end
    status = render(folder, {"--frames=5", "--turntable=7", "--samples=16", "--checkpoint=@c", "--resume", "-o", "@part.#.exr"})
                 .status;
  }
  CHECK(status == 0);
  for (int frame = 1; frame <= 5; ++frame) {
    const std::string ending = std::to_string(frame) + ".exr";
    CHECK(file_text(folder / ("part." + ending)) == file_text(folder / ("whole." + ending)));
  }
  CHECK_FALSE(fs::exists(folder / "c"));
}

}  // namespace dmpc::tests::render_frames_test
