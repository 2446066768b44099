#include "apps/lab/bench/speed/target.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace dmpc::tests::target_test {

using apps::Comparison;
using apps::SpeedPart;
using apps::Target;

namespace {

/// In one round, so many times the rival's figure.
Comparison times(double ratio, const char* scene = "tetra-2") {
  return {.part = SpeedPart::build, .scene = scene, .subject_figures = {ratio}, .rival_figures = {1}};
}

Target target(bool is_more_better, bool is_worst) {
  return {"Pace", 2, 1, is_more_better, is_worst, [](const Comparison& one) { return one.scene == "tetra-2"; }};
}

/// Those of the targets that count the comparison.
std::vector<std::string> sentences_of(const Comparison& comparison) {
  std::vector<std::string> sentences;
  for (const Target& one : apps::speed_targets()) {
    if (const auto sentence = sentence_on(one, std::vector{comparison})) {
      sentences.push_back(*sentence);
    }
  }
  return sentences;
}

std::string sentence_of(const Comparison& comparison) {
  const std::vector<std::string> sentences = sentences_of(comparison);
  return sentences.empty() ? "" : sentences.front();
}

}  // namespace

TEST_CASE("a figure over several comparisons is their geometric mean or the worst of them") {
  const std::vector<Comparison> comparisons = {times(0.5), times(8), times(100, "another scene"), {.scene = "tetra-2"}};
  CHECK(*figure_of(target(false, false), comparisons) == doctest::Approx(2));
  CHECK(*figure_of(target(false, true), comparisons) == 8);
  CHECK(*figure_of(target(true, true), comparisons) == 0.5);
}

TEST_CASE("a figure without a measured comparison is none") {
  CHECK_FALSE(figure_of(target(false, true), {}));
  CHECK_FALSE(figure_of(target(false, false), std::vector<Comparison>{{.scene = "tetra-2"}}));
  CHECK_FALSE(sentence_on(target(false, false), {}));
}

TEST_CASE("a sentence says whether less than a bound is reached, or the goal") {
  const Target one = target(false, false);
  CHECK(*sentence_on(one, std::vector{times(3)}) == "Pace (geometric mean of 1): 3.000; to reach 2.00, goal 1.00: missed.");
  CHECK(sentence_on(one, std::vector{times(2)})->ends_with(": met."));
  CHECK(sentence_on(one, std::vector{times(1)})->ends_with(": met, goal too."));
}

TEST_CASE("where more is better a bound is reached from above") {
  Target one = target(true, true);
  one.goal = 3;
  CHECK(sentence_on(one, std::vector{times(1)})->ends_with(": missed."));
  CHECK(sentence_on(one, std::vector{times(2)})->ends_with("(worst of 1): 2.000; to reach 2.00, goal 3.00: met."));
  CHECK(sentence_on(one, std::vector{times(3)})->ends_with(": met, goal too."));
}

TEST_CASE("the kernel's target is that of one thread over robust Embree") {
  Comparison kernel{.part = SpeedPart::kernel, .threads = 1, .subject = "grid", .rival = "Embree robust"};
  kernel.subject_figures = kernel.rival_figures = {1};
  CHECK(sentence_of(kernel).starts_with("Kernel over Embree robust, records local"));
  kernel.threads = 2;
  CHECK(sentence_of(kernel).empty());
  kernel.threads = 1, kernel.rival = "Embree fast";
  CHECK(sentence_of(kernel).empty());
}

TEST_CASE("bundles have targets of their own, of rays that a render shoots") {
  const auto in_bundles = [](const char* subject, const char* detail) {
    const Comparison kernel{.part = SpeedPart::kernel,
                            .detail = detail,
                            .threads = 1,
                            .subject = subject,
                            .rival = "Embree robust",
                            .subject_figures = {1},
                            .rival_figures = {1}};
    return sentences_of(kernel);
  };
  CHECK(in_bundles("bundles", "primary").size() == 2);
  CHECK(in_bundles("bundles", "shadow").size() == 2);
  CHECK(in_bundles("bundles", "primary").front().starts_with("Kernel in bundles over Embree robust, records local, primary"));
  REQUIRE(in_bundles("bundles", "secondary").size() == 1);
  CHECK(in_bundles("bundles", "secondary").front().ends_with("1.000; to reach 1.00, goal 1.20: met."));
  CHECK(in_bundles("bundles", "bounce").empty());
  REQUIRE(in_bundles("paged bundles", "primary").size() == 1);
  CHECK(in_bundles("paged bundles", "primary").front().starts_with("Kernel in bundles over Embree robust, through the pager"));
  CHECK(in_bundles("paged bundles", "bounce").empty());
}

TEST_CASE("the wall clock decides where two clocks are read") {
  Comparison emulation{.part = SpeedPart::emulation, .what = "cache", .detail = "wall clock", .subject = "10 %"};
  emulation.subject_figures = emulation.rival_figures = {1};
  CHECK(sentence_of(emulation).starts_with("8 nodes with a cache of 10 %"));
  emulation.detail = "processor time";
  CHECK(sentence_of(emulation).empty());
}

TEST_CASE("the build's target is that of a million triangles over the robust tree") {
  Comparison build{.part = SpeedPart::build, .scene = "tetra-10", .subject = "database", .rival = "Embree robust"};
  build.subject_figures = build.rival_figures = {1};
  CHECK(sentence_of(build).starts_with("Database build over Embree's"));
  CHECK(sentence_of(build).ends_with("1.000; to reach 2.00, goal 1.20: met, goal too."));
  build.rival = "Embree fast of high quality";
  CHECK(sentence_of(build).empty());
}

TEST_CASE("whole commands and renders have targets of their own, by processor time over the plain renderer") {
  const auto cost = [](const char* what, const char* subject, const char* clock) {
    Comparison one{.part = SpeedPart::plain, .what = what, .detail = clock, .subject = subject};
    one.subject_figures = {1.5}, one.rival_figures = {1};
    return sentences_of(one);
  };
  REQUIRE(cost("command", "svm on 64 nodes, pool", "processor time").size() == 1);
  CHECK(cost("command", "svm on 64 nodes, pool", "processor time").front() ==
        "svm on 64 nodes, pool, whole command over plain, processor time (geometric mean of 1): 1.500; to reach 1.60, goal 1.30: "
        "met.");
  CHECK(cost("render", "svm on 64 nodes, pool", "processor time").front().ends_with("to reach 1.45, goal 1.30: missed."));
  CHECK(cost("command", "svm on 64 nodes, pool, beside 8 busy", "processor time").front().ends_with("goal 1.50: met, goal too."));
  CHECK(cost("command", "svm on 64 nodes, pool", "wall clock").empty());
  CHECK(cost("render", "svm on 2 nodes", "wall clock").front().starts_with("svm on 2 nodes over plain on 2 threads, render"));
}

TEST_CASE("two of ours are held against each other by the wall clock, many nodes in the worst scene") {
  const auto pair = [](const char* subject, const char* rival, double figure) {
    Comparison one{.part = SpeedPart::plain, .what = "pair", .detail = "wall clock", .subject = subject, .rival = rival};
    one.subject_figures = {figure}, one.rival_figures = {1};
    return one;
  };
  CHECK(sentence_of(pair("svm on 1 node", "svm on 2 nodes", 1.85)).ends_with("1.850; to reach 1.80, goal 1.90: met."));
  const std::vector<Comparison> many = {pair("svm on 64 nodes", "svm on 2 nodes", 1),
                                        pair("svm on 64 nodes", "svm on 2 nodes", 3)};
  for (const Target& one : apps::speed_targets()) {
    if (const auto sentence = sentence_on(one, many)) {
      CHECK(sentence->ends_with("(worst of 2): 3.000; to reach 1.50, goal 1.20: missed."));
    }
  }
  CHECK(sentence_of(pair("dataflow on 64 nodes, pool", "svm on 64 nodes, pool", 1.6)).ends_with("goal 1.20: met."));
  CHECK(sentence_of(pair("dataflow on 64 nodes, pool", "svm on 64 nodes", 1)).empty());
}

}  // namespace dmpc::tests::target_test
