#include "apps/lab/study/cache.h"

#include <doctest/doctest.h>

#include <initializer_list>
#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/lab/study/python/python_study.h"
#include "apps/main/commands.h"
#include "core/base/expect.h"

namespace dmpc::apps::study_options_test {

namespace {

/// `study NAME teapot-12` and more.
Command line(const std::string& name, std::initializer_list<std::string> more = {}) {
  std::vector<std::string> arguments = {"study", name, "teapot-12"};
  arguments.insert(arguments.end(), more);
  return parse_command_line(arguments);
}

CacheStudy cache(std::initializer_list<std::string> more) { return line("cache", more).options<StudyOptions>().study; }

}  // namespace

TEST_CASE("a study and a scene are all that study needs, and other options are taken") {
  const auto plain = line("cache").options<StudyOptions>(),
             options = line("cache", {"--depth=2", "--format=json", "-o", "a.json"}).options<StudyOptions>();
  CHECK(plain.picture.scene == "teapot-12");
  CHECK(plain.table.format == TableFormat::markdown);
  CHECK_FALSE(plain.table.file);
  CHECK(options.picture.depth == 2);
  CHECK(options.table.format == TableFormat::json);
  CHECK(options.table.file == "a.json");
}

TEST_CASE("every study goes along paths, too, with the options that render has") {
  const auto check = [](const PictureOptions& picture) {
    CHECK(text_of(picture.transport) == "paths, 3 bounces, sky 1,1,1/0,0,1");
    CHECK(picture.depth == 4);
    CHECK(picture.scene_setup.background == core::Vec3d{1, 1, 1});
  };
  const std::initializer_list<std::string> paths = {"--transport=paths", "--bounces=3", "--sky=1/0,0,1", "--samples=4"};
  check(line("cache", paths).options<StudyOptions>().picture);
  for (const std::string name : {"balance", "traffic", "speedup", "frames"}) {
    CAPTURE(name);
    check(line(name, paths).options<PythonStudy>().picture);
  }
  const std::vector<std::string> mesh = {"study", "cache", "a.glb"};
  const PictureOptions shown = parse_command_line(mesh).options<StudyOptions>().picture;
  CHECK_FALSE(shown.transport.is_by_paths());
  CHECK(shown.samples == 1);
}

TEST_CASE("the options of the study of caches are taken") {
  CHECK(cache({}).node_count == 32);
  CHECK(cache({}).cache_pages.empty());
  CHECK_FALSE(cache({}).machine);
  const CacheStudy taken = cache({"--nodes=5", "--cache-pages=204,1", "--machine=ipsc2"});
  CHECK(taken.node_count == 5);
  CHECK(taken.cache_pages == std::vector<std::uint32_t>{204, 1});
  CHECK(taken.machine->name == "ipsc2");
  CHECK_THROWS_AS(cache({"--machine=abacus"}), core::InputError);
}

TEST_CASE("the help of the study of speedup tells its own defaults") {
  const std::string text = parse_command_line(std::vector<std::string>{"study", "speedup", "--help"}).options<HelpText>().text;
  CHECK(text.find("--in-flight 1..4096 [16, replicated 1]") != std::string::npos);
  CHECK(text.find("[a quarter of the database") != std::string::npos);
  CHECK(text.find("forest 16 to 256") == std::string::npos);
}

TEST_CASE("a study in Python gets the options of the line as words, and its scene") {
  const auto words_of = [](std::initializer_list<std::string> words) {
    return parse_command_line(std::vector<std::string>(words)).options<PythonStudy>().words;
  };
  CHECK(words_of({"study", "systems", "balls-1"}) == std::vector<std::string>{"--resolution=128x128", "balls-1"});
  CHECK(words_of({"study", "systems", "--search", "--node-memory", "rays,25%", "--resolution=8x8", "balls-1", "-o", "a.md"}) ==
        std::vector<std::string>{"--node-memory=rays,25%", "--search", "--resolution=8x8", "--output=a.md", "balls-1"});
  CHECK(words_of({"study", "decades", "--quick", "-o", "out"}) == std::vector<std::string>{"--output=out", "--quick"});
  CHECK(words_of({"study", "speedup", "--bundles", "--cache-pages=9", "balls-1", "--page-size=4KiB"}) ==
        std::vector<std::string>{"speedup", "--page-size=4KiB", "--cache-pages=9", "--bundles", "balls-1"});
  CHECK(words_of({"study", "balance", "balls-1", "--per-node", "--topology=mesh", "--nodes=64,1,64"}) ==
        std::vector<std::string>{"balance", "--nodes=64,1,64", "--topology=mesh", "--per-node", "balls-1"});
  CHECK(words_of({"study", "frames", "balls-1", "--machines=hdr,paragon", "--turntable=-5"}) ==
        std::vector<std::string>{"frames", "--turntable=-5", "--machines=hdr,paragon", "balls-1"});
  for (const char* const name : {"systems", "speedup", "frames"}) {
    CHECK_THROWS_AS(words_of({"study", name, "balls-1", "--machine=abacus"}), core::InputError);
  }
}

}  // namespace dmpc::apps::study_options_test
