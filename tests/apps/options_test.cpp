#include "apps/options.h"

#include <doctest/doctest.h>

#include <initializer_list>
#include <string>
#include <vector>

#include "core/expect.h"
#include "core/units.h"

namespace dmpc::apps {

using namespace core;

namespace {

Command parse(std::initializer_list<std::string> arguments) { return parse_command_line(std::vector<std::string>(arguments)); }

/// `render teapot-12 -o a.png` and more.
RenderOptions render(std::initializer_list<std::string> more = {}) {
  std::vector<std::string> arguments = {"render", "teapot-12", "-o", "a.png"};
  arguments.insert(arguments.end(), more);
  return std::get<RenderOptions>(parse_command_line(arguments));
}

std::string complaint(std::initializer_list<std::string> arguments) {
  try {
    parse(arguments);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string render_complaint(const std::string& option) { return complaint({"render", "teapot-12", "-o", "a.png", option}); }

}  // namespace

TEST_CASE("a scene and an output are all that render needs") {
  const RenderOptions options = render();
  CHECK(options.picture.scene == "teapot-12");
  CHECK(options.image == "a.png");
  CHECK(options.strategy == Strategy::svm);
  CHECK(options.computer.node_count == 8);
  CHECK_FALSE(options.computer.node_memory_bytes);
  CHECK_FALSE(options.pages.cache_pages);
  CHECK_FALSE(options.pages.in_flight);
  CHECK(options.pages.work_item_side == 3);
  CHECK(options.computer.traversal.skip_empty_space);
  CHECK(options.page_size_bytes == 1024);
  CHECK_FALSE(options.picture.resolution);
  CHECK(options.picture.samples == 1);
  CHECK(options.picture.depth == 5);
  CHECK(options.picture.convention == Convention::haines);
  CHECK(options.tracer == TracerChoice::grid);
  CHECK_FALSE(options.stats);
  CHECK_FALSE(options.quiet);
}

TEST_CASE("every option of the computer reaches its field") {
  const RenderOptions options =
      render({"--nodes=64", "--node-memory=4MiB", "--page-size=4KiB", "--cache-pages=5", "--in-flight=7", "--work-item=0",
              "--no-skip=empty-space", "--count-pages", "--stats=s.json", "--quiet"});
  CHECK(options.computer.node_count == 64);
  CHECK(options.computer.node_memory_bytes == 4_MiB);
  CHECK(options.page_size_bytes == 4_KiB);
  CHECK(options.pages.cache_pages == 5);
  CHECK(options.pages.in_flight == 7);
  CHECK(options.pages.work_item_side == 0);
  CHECK_FALSE(options.computer.traversal.skip_empty_space);
  CHECK(options.pages.count_pages);
  CHECK(options.stats == "s.json");
  CHECK(options.quiet);
}

TEST_CASE("any seed makes chaos, and without one the computer is calm") {
  CHECK_FALSE(render().computer.chaos);
  CHECK(render({"--chaos=0"}).computer.chaos.value().seed == 0);
  CHECK(render({"--chaos=18446744073709551615", "--strategy=replicated"}).computer.chaos.value().seed == ~std::uint64_t{0});
  for (const std::string wrong : {"-1", "18446744073709551616", "storm", "1.5", "7x"}) {
    CHECK_MESSAGE(says(render_complaint("--chaos=" + wrong), "--chaos=" + wrong + ": expected a whole number"), wrong);
  }
  CHECK(says(render_complaint("--chaos="), "--chaos"));
}

TEST_CASE("every option of the picture reaches its field") {
  const RenderOptions options = render({"--resolution=64x48", "--samples=4", "--depth=9", "--convention=paper",
                                        "--strategy=replicated", "--tracer=embree", "--node-memory=auto"});
  REQUIRE(options.picture.resolution);
  CHECK(options.picture.resolution->width == 64);
  CHECK(options.picture.resolution->height == 48);
  CHECK(options.picture.samples == 4);
  CHECK(options.picture.depth == 9);
  CHECK(options.picture.convention == Convention::paper);
  CHECK(options.strategy == Strategy::replicated);
  CHECK(options.tracer == TracerChoice::embree);
  CHECK_FALSE(options.computer.node_memory_bytes);
}

TEST_CASE("a value may follow its option as a word of its own") { CHECK(render({"--nodes", "3"}).computer.node_count == 3); }

TEST_CASE("scene, check and compare take their own options") {
  const auto scene = std::get<SceneOptions>(parse({"scene", "rings-4-t1"}));
  CHECK(scene.name == "rings-4-t1");
  CHECK_FALSE(scene.output);
  CHECK(std::get<SceneOptions>(parse({"scene", "balls-4", "-o", "b.nff"})).output == "b.nff");
  const auto check = std::get<CheckOptions>(parse({"check", "tetra-6", "--list=3", "--brute-force=100", "--resolution=8x8"}));
  CHECK(check.picture.scene == "tetra-6");
  CHECK(check.list == 3);
  CHECK(check.brute_force == 100);
  const auto compare = std::get<CompareOptions>(parse({"compare", "a.exr", "b.exr", "--difference=d.png"}));
  CHECK(compare.picture == "a.exr");
  CHECK(compare.reference == "b.exr");
  CHECK(compare.difference == "d.png");
}

TEST_CASE("help shows examples and every option of its command") {
  const std::string general = std::get<HelpText>(parse({"--help"})).text;
  for (const std::string word : {"render", "scene", "check", "compare", "dmpc render teapot-12"}) {
    CHECK_MESSAGE(says(general, word), word);
  }
  const std::string text = std::get<HelpText>(parse({"render", "--help"})).text;
  for (const std::string word : {"Examples:", "SCENE", "--nodes", "--strategy", "svm|replicated|dataflow [svm]", "--node-memory",
                                 "--page-size", "--cache-pages", "--in-flight", "--work-item", "--resolution", "--samples",
                                 "--depth", "--convention", "--tracer", "--no-skip", "--stats", "--quiet", "-o"}) {
    CHECK_MESSAGE(says(text, word), word);
  }
}

TEST_CASE("the version can be asked for") { CHECK(std::get<HelpText>(parse({"--version"})).text.find("dmpc ") == 0); }

TEST_CASE("wrong usage ends with a hint at the command's help") {
  CHECK(says(complaint({}), "Try: dmpc --help"));
  CHECK(says(complaint({"draw"}), "draw is no command"));
  CHECK(says(complaint({"draw"}), "Try: dmpc --help"));
  CHECK(says(complaint({"render"}), "Try: dmpc render --help"));
  CHECK(says(complaint({"render", "teapot-12"}), "Try: dmpc render --help"));
  CHECK(says(complaint({"render", "-o", "a.png"}), "SCENE"));
  CHECK(says(complaint({"compare", "a.exr"}), "Try: dmpc compare --help"));
  CHECK(says(complaint({"scene"}), "NAME"));
}

TEST_CASE("a value out of range or of the wrong kind names its option") {
  for (const std::string option :
       {"--nodes=0",        "--nodes=4097",       "--nodes=-1",           "--nodes=many",     "--nodes=2.5",
        "--strategy=dance", "--tracer=magic",     "--samples=0",          "--samples=32769",  "--depth=0",
        "--depth=256",      "--convention=mine",  "--cache-pages=0",      "--in-flight=0",    "--in-flight=4097",
        "--work-item=-1",   "--work-item=1025",   "--no-skip=everything", "--resolution=512", "--page-size=1000B",
        "--page-size=256B", "--page-size=128KiB", "--node-memory=lots",   "--unheard-of=1"}) {
    CAPTURE(option);
    CHECK(says(render_complaint(option), option.substr(0, option.find('='))));
    CHECK(says(render_complaint(option), "Try: dmpc render --help"));
  }
}

TEST_CASE("the smallest and largest values are taken") {
  for (const std::string option : {"--nodes=1", "--nodes=4096", "--samples=32768", "--depth=1", "--depth=255", "--page-size=512B",
                                   "--page-size=64KiB", "--cache-pages=1", "--in-flight=4096", "--work-item=1024"}) {
    CAPTURE(option);
    CHECK_NOTHROW(render({option}));
  }
}

TEST_CASE("options that do not go together are refused with the reason") {
  CHECK(says(render_complaint("--tracer=embree"), "--strategy=replicated"));
  CHECK_THROWS_AS(render({"--strategy=replicated", "--cache-pages=5"}), UsageError);
  CHECK_THROWS_AS(render({"--strategy=replicated", "--count-pages", "--stats=s.json"}), UsageError);
  CHECK_THROWS_AS(render({"--count-pages"}), UsageError);
}

}  // namespace dmpc::apps
