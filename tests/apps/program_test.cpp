// The program as its user meets it: exit statuses, messages, files.

#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include "apps/image_file.h"
#include "tests/support/child_process.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests {

namespace {

struct Result {
  int status = 0;
  std::string output, errors;
};

std::vector<std::string> dmpc(const std::vector<std::string>& arguments) {
  std::vector<std::string> command = {DMPC_PROGRAM};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

Result run(const std::vector<std::string>& arguments) {
  ChildProcess process(dmpc(arguments));
  const int status = process.status();
  return {status, process.output(), process.errors()};
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

constexpr const char* view = "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 30\nhither 1\nresolution 8 8\n";

}  // namespace

TEST_CASE("render writes a picture and counters, and says what it did") {
  const TemporaryFolder folder;
  const std::string image = folder / "a.exr", stats = folder / "a.json";
  const Result result = run({"render", "tetra-3", "--resolution=16x16", "--nodes=3", "-o", image, "--stats", stats});
  CHECK(result.status == 0);
  CHECK(result.errors.empty());
  CHECK(contains(result.output, "3 nodes"));
  CHECK(apps::read_image(image).width == 16);
  CHECK(contains(file_text(stats), "\"film_hash\""));
  CHECK(folder.entry_count() == 2);
}

TEST_CASE("a quiet render says nothing") {
  const TemporaryFolder folder;
  const Result result = run({"render", "tetra-1", "--resolution=4x4", "--quiet", "-o", folder / "a.png"});
  CHECK(result.status == 0);
  CHECK(result.output.empty());
  CHECK(result.errors.empty());
}

TEST_CASE("Embree and our grid write the same picture") {
  const TemporaryFolder folder;
  for (const std::string tracer : {"grid", "embree"}) {
    REQUIRE(run({"render", "balls-2", "--resolution=24x24", "--strategy=replicated", "--tracer=" + tracer, "--quiet", "-o",
                 folder / (tracer + ".exr")})
                .status == 0);
  }
  const Result result = run({"compare", folder / "grid.exr", folder / "embree.exr"});
  CHECK(result.status == 0);
  CHECK(contains(result.output, "differing pixels        0 of 576"));
}

TEST_CASE("bad input ends with status 1, a reason, and nothing written") {
  const TemporaryFolder folder;
  write_text(folder / "bad.nff", std::string(view) + "q 1 2 3\n");
  write_text(folder / "cut.nff", std::string(view) + "s 0 0\n");
  write_text(folder / "empty.nff", "");
  const std::size_t before = folder.entry_count();
  for (const std::string scene : {"bad.nff", "cut.nff", "empty.nff", "missing.nff", ""}) {
    CAPTURE(scene);
    const Result result = run({"render", folder / scene, "-o", folder / "a.png"});
    CHECK(result.status == 1);
    CHECK(contains(result.errors, (folder / scene).string()));
    CHECK(result.output.empty());
  }
  CHECK(contains(run({"render", folder / "bad.nff", "-o", folder / "a.png"}).errors, "bad.nff:8: "));
  CHECK(run({"render", "nonsense-3", "-o", folder / "a.png"}).status == 1);
  CHECK(run({"render", "tetra-1", "-o", folder / "a.nonsense"}).status == 1);
  CHECK(run({"render", "tetra-1", "--stats", folder / "no/a.json", "-o", folder / "a.png"}).status == 1);
  CHECK(run({"compare", folder / "bad.nff", folder / "bad.nff"}).status == 1);
  CHECK(folder.entry_count() == before);
}

TEST_CASE("too little memory ends with status 1 before rendering and names what works") {
  const TemporaryFolder folder;
  const Result result = run({"render", "tetra-5", "--node-memory=1KiB", "-o", folder / "a.png"});
  CHECK(result.status == 1);
  CHECK(contains(result.errors, "the smallest that works is --node-memory="));
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("wrong usage ends with status 2 and a hint") {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{}, {"paint"}, {"render"}, {"render", "tetra-1", "-o", "a.png", "--tracer=embree"}}) {
    const Result result = run(arguments);
    CHECK(result.status == 2);
    CHECK(contains(result.errors, "--help"));
  }
}

TEST_CASE("help goes to the standard output with status 0") {
  const Result result = run({"render", "--help"});
  CHECK(result.status == 0);
  CHECK(contains(result.output, "Examples:"));
  CHECK(result.errors.empty());
}

TEST_CASE("degenerate primitives are left out and counted aloud") {
  const TemporaryFolder folder;
  write_text(folder / "flat.nff", std::string(view) + "s 0 0 0 1\ns 1 1 1 0\n");
  const Result result = run({"render", folder / "flat.nff", "--quiet", "-o", folder / "a.png"});
  CHECK(result.status == 0);
  CHECK(contains(result.errors, "1 degenerate"));
}

TEST_CASE("scene writes the same to a file as to the standard output") {
  const TemporaryFolder folder;
  const Result result = run({"scene", "tetra-2"});
  CHECK(result.status == 0);
  CHECK(result.errors.empty());
  CHECK(contains(result.output, "\np 3\n"));
  CHECK(run({"scene", "tetra-2", "-o", folder / "t.nff"}).status == 0);
  CHECK(file_text(folder / "t.nff") == result.output);
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("a written scene renders to the same picture as the built-in one") {
  const TemporaryFolder folder;
  REQUIRE(run({"scene", "balls-1", "-o", folder / "b.nff"}).status == 0);
  for (const std::string& scene : {std::string("balls-1"), (folder / "b.nff").string()}) {
    REQUIRE(run({"render", scene, "--resolution=16x16", "--quiet", "-o", folder / "a.exr", "--stats",
                 folder / (scene == "balls-1" ? "built_in.json" : "file.json")})
                .status == 0);
  }
  const auto hash = [](const std::string& json) { return json.substr(json.find("\"film_hash\""), 32); };
  CHECK(hash(file_text(folder / "built_in.json")) == hash(file_text(folder / "file.json")));
}

TEST_CASE("Ctrl-C and SIGTERM end a render with status 130 and leave an older picture as it was") {
  const TemporaryFolder folder;
  write_text(folder / "a.png", "older");
  for (const int signal : {SIGINT, SIGTERM}) {
    ChildProcess process(dmpc({"render", "balls-3", "--resolution=1024x1024", "--samples=32768", "-o", folder / "a.png"}));
    std::this_thread::sleep_for(std::chrono::milliseconds(800));
    process.send(signal);
    CHECK(process.status() == 130);
    CHECK(contains(process.errors(), "interrupted"));
    CHECK(process.output().empty());
  }
  CHECK(file_text(folder / "a.png") == "older");
  CHECK(folder.entry_count() == 1);
}

}  // namespace dmpc::tests
