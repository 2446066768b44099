#include "apps/lab/study/command.h"

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

using Counts = std::vector<std::uint32_t>;

/// `study NAME teapot-12` and more.
StudyOptions study(const std::string& name, std::initializer_list<std::string> more = {}) {
  std::vector<std::string> arguments = {"study", name, "teapot-12"};
  arguments.insert(arguments.end(), more);
  return parse_command_line(arguments).options<StudyOptions>();
}

BalanceStudy balance(std::initializer_list<std::string> more = {}) {
  return std::get<BalanceStudy>(study("balance", more).study);
}

}  // namespace

TEST_CASE("a study and a scene are all that study needs") {
  const StudyOptions options = study("balance");
  CHECK(options.picture.scene == "teapot-12");
  CHECK(options.table.format == TableFormat::markdown);
  CHECK_FALSE(options.table.file);
  CHECK(balance().node_counts == Counts{4, 8, 16, 32, 64});
  CHECK(balance().subsample == 8);
  CHECK(balance().topology == nodes::TopologyKind::hypercube);
  CHECK_FALSE(balance().per_node);
  CHECK(std::get<TrafficStudy>(study("traffic").study).node_counts == Counts{1, 2, 4, 8, 16, 32, 64});
}

TEST_CASE("options of a study are taken") {
  const StudyOptions options = study("traffic", {"--nodes=3", "--depth=2", "--format=json", "-o", "a.json"});
  CHECK(std::get<TrafficStudy>(options.study).node_counts == Counts{3});
  CHECK(options.picture.depth == 2);
  CHECK(options.table.format == TableFormat::json);
  CHECK(options.table.file == "a.json");
  const BalanceStudy taken = balance({"--subsample=4", "--topology=fat-tree", "--per-node"});
  CHECK(taken.subsample == 4);
  CHECK(taken.topology == nodes::TopologyKind::fat_tree);
  CHECK(taken.per_node);
}

TEST_CASE("every study goes along paths, too, with the options that render has") {
  for (const std::string name : {"balance", "traffic", "cache"}) {
    CAPTURE(name);
    const PictureOptions picture = study(name, {"--transport=paths", "--bounces=3", "--sky=1/0,0,1", "--samples=4"}).picture;
    CHECK(text_of(picture.transport) == "paths, 3 bounces, sky 1,1,1/0,0,1");
    CHECK(picture.depth == 4);
    CHECK(picture.scene_setup.background == core::Vec3d{1, 1, 1});
  }
  CHECK_FALSE(study("traffic").picture.transport.is_by_paths());
  const std::vector<std::string> mesh = {"study", "traffic", "a.glb"};
  const PictureOptions shown = parse_command_line(mesh).options<StudyOptions>().picture;
  CHECK_FALSE(shown.transport.is_by_paths());
  CHECK(shown.samples == 1);
}

TEST_CASE("node counts are taken in the order given, equal ones too") {
  CHECK(balance({"--nodes=64,1,64,1024"}).node_counts == Counts{64, 1, 64, 1024});
}

TEST_CASE("the options of the study of caches are taken") {
  const auto cache = [](std::initializer_list<std::string> more) { return std::get<CacheStudy>(study("cache", more).study); };
  CHECK(cache({}).node_count == 32);
  CHECK(cache({}).cache_pages.empty());
  CHECK_FALSE(cache({}).machine);
  const CacheStudy taken = cache({"--nodes=5", "--cache-pages=204,1", "--machine=ipsc2"});
  CHECK(taken.node_count == 5);
  CHECK(taken.cache_pages == Counts{204, 1});
  CHECK(taken.machine->name == "ipsc2");
  CHECK_THROWS_AS(cache({"--machine=abacus"}), core::InputError);
}

TEST_CASE("frames are studied on one machine, or several that have names, by more than a node") {
  const auto frames = [](std::initializer_list<std::string> more) {
    return std::get<apps::FramesStudy>(study("frames", more).study);
  };
  CHECK(frames({}).machines.size() == 1);
  CHECK(frames({}).machines.front().name == "ipsc2");
  CHECK(frames({"--machine=hdr"}).machines.front().name == "hdr");
  const apps::FramesStudy several = frames({"--machines=hdr,paragon", "--nodes=16,64"});
  REQUIRE(several.machines.size() == 2);
  CHECK(several.machines.back().name == "paragon");
  CHECK(several.node_counts == Counts{16, 64});
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
  for (const char* const name : {"systems", "speedup"}) {
    CHECK_THROWS_AS(words_of({"study", name, "balls-1", "--machine=abacus"}), core::InputError);
  }
}

}  // namespace dmpc::apps::study_options_test
