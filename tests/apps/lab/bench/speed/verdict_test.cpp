#include "apps/lab/bench/speed/verdict.h"

#include <doctest/doctest.h>

#include <vector>

#include "apps/lab/bench/speed/ablation_table.h"
#include "core/base/expect.h"

namespace dmpc::tests::verdict_test {

using apps::Ablation;
using apps::Effect;
using apps::verdict_on;

namespace {

/// A skip whose rounds took so many times as long without it, and so much counted work.
Ablation rounds_of(std::vector<double> ratios, double work, const char* scene = "tetra-2", const char* skip = "any-hit") {
  Ablation ablation{.seconds = {.part = apps::SpeedPart::ablation, .scene = scene, .what = skip, .detail = "svm", .threads = 2},
                    .work_ratio = work,
                    .avoided = 1};
  ablation.seconds.rival_figures.assign(ratios.size(), 1);
  ablation.seconds.subject_figures = std::move(ratios);
  return ablation;
}

std::string only_sentence(const std::vector<Ablation>& ablations) {
  const std::vector<std::string> sentences = verdicts_on(ablations);
  REQUIRE(sentences.size() == 1);
  return sentences[0];
}

}  // namespace

TEST_CASE("time tells what a skip is worth where all rounds say the same") {
  CHECK(verdict_on(rounds_of({1.25, 1.3, 1.2}, 0.5)).effect == Effect::wins);
  CHECK(verdict_on(rounds_of({1.25, 1.3, 1.2}, 0.5)).ratio == 1.25);
  CHECK(verdict_on(rounds_of({0.9, 0.92}, 2)).effect == Effect::loses);
  CHECK(verdict_on(rounds_of({1.0, 0.995, 1.004}, 2)).effect == Effect::even);
  CHECK(text_of(verdict_on(rounds_of({1.0}, 2))) == "even (time)");
}

TEST_CASE("counted work tells where rounds contradict each other") {
  CHECK(verdict_on(rounds_of({1.2, 0.9}, 1.03)).effect == Effect::wins);
  CHECK(verdict_on(rounds_of({1.2, 1.0}, 1)).effect == Effect::even);
  CHECK(verdict_on(rounds_of({1.04, 1.1, 1.05}, 1)).effect == Effect::even);  // differ by more than what the skip does
  CHECK(verdict_on(rounds_of({0.98, 0.95, 0.96}, 1)).is_by_work == false);
  CHECK(verdict_on(rounds_of({1.02, 1.005}, 0.5)).is_by_work);
  CHECK(verdict_on(rounds_of({1.0, 0.9}, 0.98)).effect == Effect::loses);
  CHECK(text_of(verdict_on(rounds_of({1.2, 0.9}, 1.5))) == "wins (work)");
  CHECK(verdict_on(rounds_of({1.2, 0.9}, 1.5)).ratio == 1.5);
}

TEST_CASE("counted work tells where the same picture took as different times") {
  Ablation ablation = rounds_of({1.25, 1.3, 1.2}, 0.5);
  ablation.noise = 0.2;
  CHECK_FALSE(verdict_on(ablation).is_by_work);
  ablation.noise = 0.3;
  CHECK(verdict_on(ablation).effect == Effect::loses);
}

TEST_CASE("three percent are a win, one percent less is no loss") {
  CHECK(verdict_on(rounds_of({1.03}, 1)).effect == Effect::wins);
  CHECK(verdict_on(rounds_of({1.0299}, 1)).effect == Effect::even);
  CHECK(verdict_on(rounds_of({0.99}, 1)).effect == Effect::even);
  CHECK(verdict_on(rounds_of({0.9899}, 1)).effect == Effect::loses);
}

TEST_CASE("a skip is kept if it wins somewhere and loses nowhere") {
  CHECK(only_sentence({rounds_of({1}, 1), rounds_of({1.25}, 1, "balls-4")}) ==
        "any-hit: kept, wins up to 25.0 % (balls-4), loses 1.0 % nowhere.");
  CHECK(only_sentence({rounds_of({1.02}, 1), rounds_of({1}, 1, "balls-4")}) ==
        "any-hit: to be dropped, wins 3.0 % nowhere (at most 2.0 %, tetra-2), loses 1.0 % nowhere.");
  CHECK(only_sentence({rounds_of({0.75}, 1), rounds_of({1.25}, 1, "balls-4")}) ==
        "any-hit: to be dropped, wins up to 25.0 % (balls-4), loses up to 25.0 % (tetra-2).");
}

TEST_CASE("the sentence on a bounded skip ends with its largest error") {
  Ablation small = rounds_of({1.5}, 1), large = small;
  small.error = 0.001;
  large.error = 0.5 / 255;
  CHECK(only_sentence({small, large, small}).ends_with("bounded, errs by up to 0.500/255 (root mean square)."));
}

TEST_CASE("what has not been measured has no verdict") {
  CHECK(apps::verdicts_on({}).empty());
  CHECK_THROWS_AS(verdict_on(rounds_of({}, 1)), core::InternalError);
}

TEST_CASE("a table of skips has a row for each on each scene, and a sentence on each skip") {
  Ablation bounded = rounds_of({1.5}, 1.4, "tetra-2", "cutoff 1/255");
  bounded.error = 1.0 / 255;
  bounded.avoided = 12;
  bounded.unit = "rays";
  Ablation control = rounds_of({1.1}, 1, "tetra-2", "none");
  control.avoided.reset();
  const std::vector<Ablation> ablations = {rounds_of({1.1, 1.2}, 1.3), bounded, control};
  const apps::Table table = table_of(ablations, "title");
  REQUIRE(table.rows().size() == 3);
  CHECK(plotted_table(ablations).rows().size() == 2);
  CHECK(table.notes().size() == 2);
  const std::string text = text_of(table, apps::TableFormat::csv);
  CHECK(text.find("tetra-2,any-hit,exact,svm,2,") != std::string::npos);
  CHECK(text.find("12,rays,1,wins (time)") != std::string::npos);
}

TEST_CASE("a picture of skips has a bar of counted work for each skip at each scene") {
  const std::vector<Ablation> ablations = {rounds_of({1.1}, 1.3), rounds_of({1.1}, 1.2, "balls-4"),
                                           rounds_of({1}, 1, "tetra-2", "unlit")};
  const apps::Table table = plotted_table(ablations);
  REQUIRE(table.rows().size() == 3);
  CHECK(std::get<double>(table.rows()[1][3]) == 1.2);
  CHECK(plot_of_ablation(table, "name").series.size() == 2);
}

}  // namespace dmpc::tests::verdict_test
