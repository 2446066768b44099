// Frames of an animation by the program itself: each what its moment is, warm where only the camera moves, cold where more does.
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "apps/main/commands.h"
#include "apps/render/command.h"
#include "tests/support/child_process.h"
#include "tests/support/immutable_files.h"
#include "tests/support/packed_gltf.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::render_animation_test {

namespace fs = std::filesystem;

namespace {

template <class T>
std::string row(const std::vector<T>& values) {
  std::string bytes;
  for (const T& value : values) {
    bytes += bytes_of(value);
  }
  return bytes;
}

/// A hilly field of `size` x `size` squares around 0.
struct Field {
  std::vector<float> corners;
  std::vector<std::uint16_t> triangles;

  explicit Field(std::uint16_t size) {
    for (std::uint16_t y = 0; y <= size; ++y) {
      for (std::uint16_t x = 0; x <= size; ++x) {
        const float height = static_cast<float>((x * 7 + y * 3) % 5) / 10;
        corners.insert(corners.end(), {static_cast<float>(x) - size / 2.0F, static_cast<float>(y) - size / 2.0F, height});
      }
    }
    const auto at = [&](int x, int y) { return static_cast<std::uint16_t>(y * (size + 1) + x); };
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        for (const std::uint16_t corner : {at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)}) {
          triangles.push_back(corner);
        }
      }
    }
  }
};

/// How one node moves in two seconds: its place or size at the beginning and the end.
struct Motion {
  int node = 1;  ///< in the file: 0 is all of it
  std::string path = "translation";
  std::vector<float> values;
};

/// The field, and above it another, small one, and a camera: nodes 1, 2 and 3.
std::string moved_by(const Motion& motion, const std::string& small, bool has_camera) {
  const Field field(16);
  GltfDocument document;
  const auto index = [](std::size_t i) { return std::to_string(i); };
  const std::string corners = index(document.accessor(document.view(row(field.corners)), 5126, field.corners.size() / 3, "VEC3"));
  const std::string triangles =
      index(document.accessor(document.view(row(field.triangles)), 5123, field.triangles.size(), "SCALAR"));
  const std::string input = index(document.accessor(document.view(row<float>({0, 2})), 5126, 2, "SCALAR"));
  const std::string output = index(document.accessor(document.view(row(motion.values)), 5126, 2, "VEC3"));
  document.node = R"({"children":[1,2,3]},{"mesh":0},{"mesh":0,"translation":[)" + small +
                  R"(],"scale":[0.2,0.2,0.2]},{"translation":[0,0,30])" + (has_camera ? R"(,"camera":0})" : "}");
  return document.text(R"({"attributes":{"POSITION":)" + corners + R"(},"indices":)" + triangles + "}",
                       R"("cameras":[{"type":"perspective","perspective":{"yfov":0.6,"znear":0.1,"aspectRatio":1}}],)"
                       R"("animations":[{"name":"go","samplers":[{"input":)" +
                           input + R"(,"output":)" + output + R"(}],"channels":[{"sampler":0,"target":{"node":)" +
                           std::to_string(motion.node) + R"(,"path":")" + motion.path + R"("}}]}])");
}

/// `moved` goes (4 0 2).
std::string animated(int moved, const std::string& small = "0,0,3", bool has_camera = true) {
  const float up = moved == 2 ? 30.0F : 3.0F;
  return moved_by({.node = moved + 1, .values = {0, 0, up, 4, 0, up + 2}}, small, has_camera);
}

constexpr int small_field = 1, camera = 2;

/// A render of a small picture of a.gltf, with its files in the folder.
std::vector<std::string> line(const TemporaryFolder& folder, const std::vector<std::string>& words) {
  std::vector<std::string> command = {DMPC_PROGRAM,         "render",    (folder / "a.gltf").string(),
                                      "--resolution=24x24", "--nodes=3", "--transport=whitted"};
  const bool says_samples = std::ranges::any_of(words, [](const std::string& word) { return word.starts_with("--samples="); });
  if (!says_samples) {
    command.emplace_back("--samples=1");
  }
  for (std::string word : words) {
    const std::size_t place = word.find('@');
    command.push_back(place == std::string::npos ? word : word.replace(place, 1, folder.path().string() + "/"));
  }
  return command;
}

Said render(const TemporaryFolder& folder, const std::vector<std::string>& words) { return run(line(folder, words)); }

/// What a file of counters says behind a key, as text.
std::string value_of(const fs::path& file, const std::string& key) {
  const std::string json = file_text(file);
  const std::size_t place = json.find('"' + key + '"');
  return place == std::string::npos ? "" : json.substr(place, json.find_first_of(",}\n", place) - place);
}

}  // namespace

TEST_CASE("a frame of an animation is the picture of a file that stands as the animation then does, alone or among others") {
  const TemporaryFolder folder;
  const std::string light = "--light=3,9,40";  // ours would stand where the beginning of each file puts it
  write_text(folder / "a.gltf", animated(small_field));
  const Said all = render(folder, {"--frames=4", "--animation", "--fps=1", light, "-o", "@a.#.png"});
  REQUIRE_MESSAGE(all.status == 0, all.errors);
  CHECK(contains(all.errors, "animation go takes 2 seconds: at 1 frames a second frame 3 shows its end"));
  CHECK(file_text(folder / "a.1.png") != file_text(folder / "a.2.png"));
  CHECK(file_text(folder / "a.3.png") == file_text(folder / "a.4.png"));  // it has ended
  CHECK(contains(all.output, "a copy of frame 3\n"));
  CHECK_FALSE(contains(all.output, "a copy of frame 2\n"));
  for (const std::string strategy : {"svm", "dataflow", "forest", "replicated"}) {
    const std::string name = "@" + strategy + ".#.png";
    const Said part = render(folder, {"--frames=2..3", "--animation=go", "--fps=1", light, "--strategy=" + strategy, "-o", name});
    REQUIRE_MESSAGE(part.status == 0, part.errors);
    CHECK(file_text(folder / (strategy + ".2.png")) == file_text(folder / "a.2.png"));
    CHECK(file_text(folder / (strategy + ".3.png")) == file_text(folder / "a.3.png"));
  }
  REQUIRE(render(folder, {"--frames=2..2", "--animation", "--fps=1", light, "-o", "@alone.png"}).status == 0);
  CHECK(file_text(folder / "alone.png") == file_text(folder / "a.2.png"));
  write_text(folder / "a.gltf", animated(small_field, "2,0,4"));
  REQUIRE(render(folder, {light, "-o", "@still.png"}).status == 0);
  CHECK(file_text(folder / "still.png") == file_text(folder / "a.2.png"));
}

TEST_CASE("where nothing but the camera moves nodes keep what they have, and the picture is that of the frame alone") {
  const TemporaryFolder folder;
  write_text(folder / "a.gltf", animated(camera));
  const std::vector<std::string> words = {"--frames=3", "--animation", "--fps=8", "--stats=@a.#.json", "-o", "@a.#.png"};
  const Said all = render(folder, words);
  REQUIRE_MESSAGE(all.status == 0, all.errors);
  const auto faults = [&](const char* file) {
    const std::string text = value_of(folder / file, "faults");
    return std::stoi(text.substr(text.find(':') + 1));
  };
  CHECK(faults("a.1.json") > 0);
  CHECK(faults("a.2.json") < faults("a.1.json"));
  REQUIRE(render(folder, {"--frames=3..3", "--animation", "--fps=8", "-o", "@alone.png"}).status == 0);
  CHECK(file_text(folder / "alone.png") == file_text(folder / "a.3.png"));
  CHECK(file_text(folder / "a.1.png") != file_text(folder / "a.3.png"));
}

TEST_CASE("where more moves nodes begin anew, so that a modelled machine does what it does for the frame alone") {
  const TemporaryFolder folder;
  write_text(folder / "a.gltf", animated(small_field));
  const std::vector<std::string> machine = {"--runner=virtual", "--animation", "--fps=4"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), machine.begin(), machine.end());
    return more;
  };
  for (const std::string strategy : {"--strategy=svm", "--strategy=forest"}) {
    REQUIRE(render(folder, with({strategy, "--frames=2", "--stats=@a.#.json", "-o", "@a.#.png"})).status == 0);
    REQUIRE(render(folder, with({strategy, "--frames=2..2", "--stats=@b.json", "-o", "@b.png"})).status == 0);
    CHECK(value_of(folder / "a.2.json", "film_hash") == value_of(folder / "b.json", "film_hash"));
    CHECK(value_of(folder / "a.1.json", "film_hash") != value_of(folder / "b.json", "film_hash"));
    CHECK(value_of(folder / "a.2.json", "run_hash") == value_of(folder / "b.json", "run_hash"));
    for (const char* const file : {"a.1.png", "a.2.png", "b.png"}) {
      fs::remove(folder / file);
    }
  }
}

TEST_CASE("a camera and lights that are ours stay where the beginning has put them, and so does the middle of a turntable") {
  const TemporaryFolder folder;
  write_text(folder / "a.gltf", animated(small_field, "0,0,3", false));
  const Said own = render(folder, {"--frames=2", "--animation", "--fps=1", "-o", "@a.#.png"});
  REQUIRE_MESSAGE(own.status == 0, own.errors);
  const std::size_t place = own.errors.find("--camera=");
  REQUIRE(place != std::string::npos);
  CHECK(own.errors.find("--camera=", place + 1) == std::string::npos);  // said once
  const std::string view = own.errors.substr(place, own.errors.find('\n', place) - place);
  REQUIRE(render(folder, {"--frames=2..2", "--animation", "--fps=1", view, "-o", "@b.png"}).status == 0);
  CHECK(file_text(folder / "b.png") == file_text(folder / "a.2.png"));
  const std::vector<std::string> turned = {"--animation", "--fps=1", "--turntable=0"};
  REQUIRE(render(folder, {turned[0], turned[1], turned[2], "--frames=2..2", "-o", "@c.png"}).status == 0);
  CHECK(file_text(folder / "c.png") == file_text(folder / "a.2.png"));
  REQUIRE(render(folder, {turned[0], turned[1], "--turntable=30", "--frames=2..2", "-o", "@d.png"}).status == 0);
  CHECK(file_text(folder / "d.png") != file_text(folder / "a.2.png"));
}

TEST_CASE("a path of one's own takes the place of a camera that the file moves") {
  const TemporaryFolder folder;
  write_text(folder / "a.gltf", animated(camera));
  REQUIRE(render(folder, {"--frames=2", "--animation", "--fps=1", "--turntable=0", "-o", "@a.#.png"}).status == 0);
  CHECK(file_text(folder / "a.1.png") == file_text(folder / "a.2.png"));
}

TEST_CASE("frames of an animation that are killed again and again are those of one run, whole or not there") {
  const TemporaryFolder folder;
  write_text(folder / "a.gltf", animated(small_field));
  const std::vector<std::string> words = {"--frames=4", "--animation", "--fps=2", "--samples=16"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), words.begin(), words.end());
    return line(folder, more);
  };
  REQUIRE(run(with({"-o", "@whole.#.exr"})).status == 0);
  int status = -1;
  for (int tries = 0; tries < 40 && status != 0; ++tries) {
    ChildProcess process(with({"--checkpoint=@c", "--resume", "--checkpoint-every=0.001", "-o", "@part.#.exr"}));
    ::usleep(static_cast<useconds_t>(100'000 + 50'000 * tries));
    process.send(SIGKILL);
    status = process.status();
  }
  for (int frame = 1; frame <= 4; ++frame) {
    const std::string ending = std::to_string(frame) + ".exr";
    CHECK(file_text(folder / ("part." + ending)) == file_text(folder / ("whole." + ending)));
  }
  CHECK_FALSE(fs::exists(folder / "c"));
}

/// Renders, and ends when the picture is written, before the checkpoint is removed.
void render_and_leave(const TemporaryFolder& folder, const std::vector<std::string>& words) {
  std::vector<std::string> typed = line(folder, words);
  typed.erase(typed.begin());
  ImmutableFiles files;
  apps::Interrupt interrupt;
  std::ostringstream output;
  REQUIRE(apps::render_command(apps::parse_command_line(typed).options<apps::RenderOptions>(), interrupt, output, files) == 0);
}

TEST_CASE("a checkpoint of a frame that is there is removed, and that of another moment is refused") {
  const TemporaryFolder folder;
  write_text(folder / "a.gltf", animated(small_field));
  const std::vector<std::string> words = {"--animation", "--checkpoint=@c", "--checkpoint-every=0.001", "--resume",
                                          "-o",          "@a.#.exr"};
  const auto frames = [&](const std::string& range) {
    std::vector<std::string> all = words;
    all.push_back("--frames=" + range);
    return all;
  };
  render_and_leave(folder, frames("2..2"));
  REQUIRE(fs::exists(folder / "c"));
  const Said refused = render(folder, frames("5"));
  CHECK(refused.status == 1);
  CHECK_MESSAGE(contains(refused.errors, "other meshes in several places"), refused.errors);
  const Said gone_on = render(folder, frames("2..3"));
  CHECK_MESSAGE(gone_on.status == 0, gone_on.errors);
  CHECK(fs::exists(folder / "a.3.exr"));
  CHECK_FALSE(fs::exists(folder / "c"));
}

TEST_CASE("a frame of which nothing is left shows the background, as the frames behind it do, unless its camera goes, too") {
  const TemporaryFolder folder;
  write_text(folder / "a.gltf", moved_by({.node = 0, .path = "scale", .values = {1, 1, 1, 0, 0, 0}}, "0,0,3", true));
  std::vector<std::string> words = {"--frames=4", "--animation", "--fps=1", "-o", "@a.#.png"};
  const Said blind = render(folder, words);
  CHECK(blind.status == 1);
  CHECK_MESSAGE(contains(blind.errors, "frame 3: "), blind.errors);
  CHECK(contains(blind.errors, "presses it flat, so that it sees nothing"));
  CHECK(fs::exists(folder / "a.2.png"));
  CHECK_FALSE(fs::exists(folder / "a.3.png"));
  words.back() = "@b.#.png";
  words.emplace_back("--camera=0,0,30/0,0,0/0,1,0");
  const Said said = render(folder, words);
  CHECK_MESSAGE(said.status == 0, said.errors);
  CHECK(file_text(folder / "b.2.png") != file_text(folder / "b.3.png"));
  CHECK(file_text(folder / "b.3.png") == file_text(folder / "b.4.png"));
}

TEST_CASE("what an animation cannot do is refused, and says what can be done") {
  const TemporaryFolder folder;
  write_text(folder / "a.gltf", animated(small_field));
  struct Refusal {
    std::vector<std::string> words;
    int status;
    const char* says;
  };
  const std::vector<Refusal> refusals = {
      {{"--animation", "-o", "@a.png"}, 2, "--animation goes with --frames, which sets how many there are"},
      {{"--frames=2", "--fps=5", "--turntable=1", "-o", "@a.#.png"}, 2, "--fps goes with --animation"},
      {{"--frames=2", "--fps=0", "--animation", "-o", "@a.#.png"}, 2, "--fps=0: expected frames a second, above 0"},
      {{"--frames=2", "-o", "@a.#.png"}, 2, "or --animation, which plays the animation of the scene's file"},
      {{"--frames=2", "--animation=come", "-o", "@a.#.png"}, 1, "no animation in it is called come, expected one of go"}};
  for (const Refusal& refusal : refusals) {
    const Said said = render(folder, refusal.words);
    CHECK_MESSAGE(said.status == refusal.status, said.errors);
    CHECK_MESSAGE(contains(said.errors, refusal.says), said.errors);
  }
  const std::string picture = (folder / "a.#.png").string();
  const Said other = run({DMPC_PROGRAM, "render", "balls-2", "--frames=2", "--animation", "-o", picture});
  CHECK(other.status == 2);
  CHECK_MESSAGE(contains(other.errors, "--animation goes with glTF files (.gltf, .glb), and balls-2 is none"), other.errors);
  CHECK(folder.entry_count() == 1);
}

}  // namespace dmpc::tests::render_animation_test
