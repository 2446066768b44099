#include "apps/lab/bench/error/sweep.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "apps/scene/picture_options.h"
#include "core/base/expect.h"

namespace dmpc::tests::sweep_test {

using apps::Knob;
using apps::Point;
using apps::Setting;
using apps::sweep;
using apps::SweepOptions;
using apps::tessellations_of;

namespace {

std::vector<std::string> texts(const std::vector<Point>& points) {
  std::vector<std::string> result;
  for (const Point& point : points) {
    result.push_back(point.text);
  }
  return result;
}

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("a sweep turns one knob at a time and ends at the base point") {
  CHECK(texts(sweep({.samples = 8}, {.knobs = {Knob::samples}})) == Texts{"1", "4", "8", "16", "32", "64", "256"});
  CHECK(texts(sweep({.depth = 3}, {.knobs = {Knob::depth}})) == Texts{"1", "2", "3"});
  CHECK(texts(sweep({.depth = 1}, {.knobs = {Knob::depth}})) == Texts{"1"});
  for (const Knob knob : {Knob::cutoff, Knob::depth, Knob::tessellation, Knob::arithmetic}) {
    const std::vector<Point> points = sweep({}, {.knobs = {knob}, .tessellations = {1, 2}});
    CHECK(points.back().setting == Setting());
    CHECK(std::count_if(points.begin(), points.end(), [](const Point& one) { return one.setting == Setting(); }) == 1);
  }
  CHECK(sweep({}, {}).empty());
}

TEST_CASE("by paths a sweep turns bounces up to the base point's, and from where roulette ends paths, if it does") {
  const Setting base{.bounces = 4};
  CHECK(texts(sweep(base, {.knobs = {Knob::bounces}})) == Texts{"0", "1", "2", "3", "4"});
  CHECK(texts(sweep({.bounces = 0}, {.knobs = {Knob::bounces}})) == Texts{"0"});
  CHECK(sweep(base, {.knobs = {Knob::bounces}}).back().setting == base);
  const auto roulette = sweep(base, {.knobs = {Knob::roulette}});
  CHECK(texts(roulette) == Texts{"from hit 1", "from hit 2", "from hit 3", "from hit 5", "never"});
  CHECK(roulette[2].setting == base);
  for (const Point& point : sweep(base, {.knobs = {Knob::adaptive}})) {
    CHECK(point.setting.samples == 8);
    CHECK(point.setting.is_refined());
  }
}

TEST_CASE("by paths a sweep aims at nothing that shines, at some of it and at what the base point aims at, where there is any") {
  const Setting base{.bounces = 2};
  const auto points = sweep(base, {.knobs = {Knob::emitters}, .emitters = 20});
  CHECK(texts(points) == Texts{"none", "1", "4", "16", "20"});
  CHECK(points[0].setting.emitters == 0);
  CHECK(points[2].setting.emitters == 4);
  CHECK(points.back().setting == base);
  CHECK(texts(sweep(base, {.knobs = {Knob::emitters}, .is_quick = true, .emitters = 20})) == Texts{"none", "20"});
  CHECK(texts(sweep(base, {.knobs = {Knob::emitters}, .emitters = 1})) == Texts{"none", "1"});
  CHECK(sweep(base, {.knobs = {Knob::emitters}}).empty());
}

TEST_CASE("the qualities are what the command line's are") {
  const auto points = sweep({}, {.knobs = {Knob::quality}});
  CHECK(texts(points) == Texts{"draft", "good"});
  CHECK(points[0].setting.error == apps::choice_of(apps::Quality::draft).error);
  CHECK(points[1].setting.cutoff == apps::choice_of(apps::Quality::good).cutoff);
  CHECK(points[1].setting.is_refined());
}

TEST_CASE("a quick sweep has fewer points and keeps the base point") {
  const std::set<Knob> knobs = apps::all_knobs();
  const auto quick = sweep({}, {.knobs = knobs, .is_quick = true}), whole = sweep({}, {.knobs = knobs});
  CHECK(quick.size() < whole.size());
  CHECK(texts(sweep({}, {.knobs = {Knob::cutoff}, .is_quick = true})).back() == "0");
  const SweepOptions adaptive{.knobs = {Knob::adaptive}, .is_quick = true, .error_least = 0.4 / 255};
  CHECK(texts(sweep({}, adaptive)) == Texts{"8/255", "4/255", "2/255", "1/255", "1/510"});
}

TEST_CASE("a sweep asks for no smaller error than can be seen") {
  const auto points = sweep({}, {.knobs = {Knob::adaptive}, .error_least = 4.0 / 255});
  CHECK(texts(points) == Texts{"64/255", "32/255", "16/255", "8/255", "4/255"});
  CHECK(sweep({}, {.knobs = {Knob::adaptive}, .error_least = 1}).empty());
}

TEST_CASE("a sweep about a point that is not exact is refused") {
  CHECK_THROWS_AS(sweep({.cutoff = 0.1}, {}), core::InternalError);
  CHECK_THROWS_AS(sweep({.error = 0.1}, {}), core::InternalError);
}

TEST_CASE("scenes with spheres or cones are tessellated as far as a million triangles go") {
  CHECK(tessellations_of("balls-2", false) == std::vector{1, 2, 4, 8, 16});
  CHECK(tessellations_of("balls-4", false) == std::vector{1, 2});
  CHECK(tessellations_of("jacks-1", false) == std::vector{1});
  CHECK(tessellations_of("balls-2", true) == std::vector{1, 2});
  for (const char* scene : {"tetra-2", "teapot-3", "rings-2-t1", "./rings-2", "file.nff"}) {
    CAPTURE(std::string(scene));
    CHECK(tessellations_of(scene, false).empty());
  }
}

TEST_CASE("knobs are listed by name") {
  CHECK(apps::parse_knobs("samples") == std::set{Knob::samples});
  CHECK(apps::parse_knobs("cutoff,adaptive") == std::set{Knob::cutoff, Knob::adaptive});
  CHECK(apps::all_knobs().size() == 7);
  for (const char* text : {"", ",", "samples,", "sample", "samples adaptive"}) {
    CAPTURE(std::string(text));
    CHECK_THROWS_AS(apps::parse_knobs(text), core::UsageError);
  }
}

}  // namespace dmpc::tests::sweep_test
