#include "apps/lab/study/scale/settings.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::tests::scale_settings_test {

using apps::ScaleMethod;
using apps::ScalePart;
using apps::ScaleRun;
using apps::ScaleSettings;
using Sizes = std::vector<int>;

namespace {

std::string text_of(const ScaleRun& run) {
  return std::string(name_of(run.part)) + " " + run.scene.text() + " " + ScaleSettings().name_of(run.method) + " " +
         std::to_string(run.node_count);
}

std::vector<std::string> texts_of(const ScaleSettings& settings) {
  std::vector<std::string> texts;
  for (const ScaleRun& run : apps::scale_runs(settings)) {
    texts.push_back(text_of(run));
  }
  return texts;
}

}  // namespace

TEST_CASE("without options the scenes go from a thousand triangles to 17 million") {
  CHECK(apps::standard_sizes("tetra") == Sizes{5, 6, 7, 8, 9, 10, 11, 12});
  CHECK(apps::standard_sizes("mount") == Sizes{5, 6, 7, 8, 9, 10, 11});
  CHECK(ScaleSettings().scene_of_nodes().text() == "tetra-9");
}

TEST_CASE("families of many sizes have one for each doubling") {
  const Sizes sizes = apps::standard_sizes("gears");
  for (std::size_t i = 1; i < sizes.size(); ++i) {
    const auto count = [](int size) { return core::primitive_count({.family = "gears", .size = size}); };
    CHECK(count(sizes[i]) >= 2 * count(sizes[i - 1]));
    CHECK(count(sizes[i] - 1) < 2 * count(sizes[i - 1]));
  }
  CHECK(apps::standard_sizes("shells").front() == 3);
}

TEST_CASE("every family has scenes, and what is none is refused") {
  for (const char* family :
       {"balls", "gears", "jacks", "lattice", "mount", "rings", "shells", "sombrero", "teapot", "tetra", "tree"}) {
    CAPTURE(std::string(family));
    CHECK(ScaleSettings().scenes_of(family).size() > 3);
  }
  CHECK_THROWS_AS(ScaleSettings().scenes_of("pyramid"), core::InputError);
  CHECK_THROWS_AS(ScaleSettings().scenes_of(""), core::InputError);
}

TEST_CASE("all methods have a turn with a scene and a number of nodes before the next has one") {
  ScaleSettings settings;
  settings.families = {"mount"};
  settings.sizes = {1, 3};
  settings.node_counts = {2, 1};
  CHECK(texts_of(settings) == std::vector<std::string>{"sizes mount-1 svm 1MiB 8", "sizes mount-1 svm quarter 8",
                                                       "sizes mount-1 dataflow 8", "sizes mount-3 svm 1MiB 8",
                                                       "sizes mount-3 svm quarter 8", "sizes mount-3 dataflow 8",
                                                       "nodes mount-3 svm 1MiB 2", "nodes mount-3 dataflow 2",
                                                       "nodes mount-3 svm 1MiB 1", "nodes mount-3 dataflow 1"});
}

TEST_CASE("parts, methods and the scene of the nodes are as asked for") {
  ScaleSettings settings;
  settings.parts = {ScalePart::nodes};
  settings.methods = {ScaleMethod::dataflow};
  settings.node_counts = {4};
  settings.nodes_scene = "teapot-2";
  CHECK(texts_of(settings) == std::vector<std::string>{"nodes teapot-2 dataflow 4"});
  settings.methods = {ScaleMethod::quarter};
  CHECK(texts_of(settings).empty());
  settings.nodes_scene = "teapot.nff";
  CHECK_THROWS_AS(apps::scale_runs(settings), core::InputError);
}

TEST_CASE("a size that a family does not have is refused with its range") {
  ScaleSettings settings;
  settings.sizes = {5, 12};
  CHECK_THROWS_WITH_AS(apps::scale_runs(settings), doctest::Contains("the size of mount lies between 1 and 11"),
                       core::InputError);
}

TEST_CASE("sizes are numbers and ranges") {
  CHECK(apps::parse_scale_sizes("5") == Sizes{5});
  CHECK(apps::parse_scale_sizes("5-8") == Sizes{5, 6, 7, 8});
  CHECK(apps::parse_scale_sizes("8,2-3,3,8-8") == Sizes{2, 3, 8});
}

TEST_CASE("parts and methods are words") {
  CHECK(apps::parse_scale_parts("nodes") == std::set{ScalePart::nodes});
  CHECK(apps::parse_scale_parts("nodes,sizes").size() == 2);
  CHECK(apps::parse_scale_methods("dataflow,cache") == std::vector{ScaleMethod::dataflow, ScaleMethod::cache});
}

}  // namespace dmpc::tests::scale_settings_test
