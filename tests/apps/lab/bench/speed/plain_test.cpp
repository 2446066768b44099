// The plain renderer of `bench speed`, and how all else is held against it.

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "apps/lab/bench/speed/comparison.h"
#include "apps/lab/bench/speed/part.h"
#include "apps/lab/bench/speed/plain_renderer.h"
#include "core/base/expect.h"
#include "core/picture/render.h"
#include "tests/support/small_subject.h"

namespace dmpc::tests::plain_test {

using apps::Comparison;
using apps::PlainPicture;
using apps::PlainRenderer;

namespace {

struct Ours {
  core::Operations operations;
  core::Film film;

  explicit Ours(const apps::Subject& subject) : film(rendered(subject, operations)) {}

  static core::Film rendered(const apps::Subject& subject, core::Operations& operations) {
    core::LocalRecords records(subject.database.bytes());
    core::GridTracer<core::LocalRecords> tracer(records, subject.settings.header, subject.settings.skips);
    return core::render(tracer, subject.settings, operations);
  }
};

/// A part plain of one small scene.
const std::vector<Comparison>& measured_in_two_rounds() {
  static const std::vector<Comparison> all = [] {
    apps::SpeedSettings settings;
    settings.scenes = {"tetra-2"};
    settings.resolution = {16, 16};
    settings.rounds = 2;
    settings.program = DMPC_PROGRAM;
    apps::Interrupt interrupt;
    std::vector<Comparison> results;
    apps::measure_plain(settings, interrupt, results);
    return results;
  }();
  return all;
}

std::vector<const Comparison*> of(const std::vector<Comparison>& results, const std::string& what) {
  std::vector<const Comparison*> chosen;
  for (const Comparison& one : results) {
    if (one.what == what) {
      chosen.push_back(&one);
    }
  }
  return chosen;
}

}  // namespace

TEST_CASE("the plain renderer shoots our rays, to rounding, and its picture is ours") {
  // Flat and smooth triangles, mirrors, glass, spheres, cones.
  for (const char* scene :
       {"tetra-3", "teapot-3", "mount-4", "balls-2", "balls-2-t2", "rings-2", "tree-3", "gears-1", "jacks-2", "lattice-3"}) {
    CAPTURE(std::string(scene));
    const apps::Subject subject = small_subject(scene, {48, 40});
    const Ours ours(subject);
    const PlainPicture picture = PlainRenderer(subject).render(1);
    CHECK(static_cast<double>(picture.rays) == doctest::Approx(static_cast<double>(ours.operations.ray_count())).epsilon(0.005));
    CHECK(apps::distance_to_ours(picture, ours.film, scene) <= apps::plain_error_max);
  }
}

TEST_CASE("the plain renderer shows an ambient light as ours does") {
  for (const char* scene : {"teapot-3", "balls-2", "mount-4"}) {
    CAPTURE(std::string(scene));
    apps::Subject subject = small_subject(scene, {48, 40});
    const Ours dark(subject);
    subject.settings.header.ambient = {0.5F, 0.25F, 0.125F};
    const Ours ours(subject);
    CHECK(ours.operations.ray_count() == dark.operations.ray_count());
    CHECK(ours.film.hash() != dark.film.hash());
    CHECK_NOTHROW(apps::distance_to_ours(PlainRenderer(subject).render(1), ours.film, scene));
  }
}

TEST_CASE("the plain renderer's picture is the same on any number of threads") {
  const apps::Subject subject = small_subject("teapot-3", {48, 40});
  const PlainRenderer renderer(subject);
  const PlainPicture one = renderer.render(1), three = renderer.render(3);
  CHECK(std::ranges::equal(one.pixels.span(), three.pixels.span()));
  CHECK(one.rays == three.rays);
  CHECK(renderer.build_times().wall_seconds > 0);
}

TEST_CASE("a plain picture that is not ours is an error") {
  const apps::Subject subject = small_subject("tetra-2", {48, 40});
  const Ours ours(subject);
  PlainPicture picture = PlainRenderer(subject).render(1);
  CHECK_NOTHROW(apps::distance_to_ours(picture, ours.film, "tetra-2"));
  picture.pixels[7].y += 1;
  CHECK_THROWS_WITH_AS(apps::distance_to_ours(picture, ours.film, "tetra-2"),
                       doctest::Contains("picture of tetra-2 is 3.36/255 from ours"), core::InternalError);
}

TEST_CASE("every renderer is held against the plain one in every round, which is held against itself") {
  const std::vector<Comparison>& results = measured_in_two_rounds();
  const std::vector<const Comparison*> renders = of(results, "render");
  REQUIRE(renders.size() == 17);
  for (const Comparison* const one : renders) {
    CAPTURE(one->subject);
    CHECK(one->figures.subject.size() == 2);
    CHECK(one->processor.subject.size() == 2);
    CHECK(one->baseline == "plain on 2 threads");
    CHECK(one->figures.baseline == renders[1]->figures.subject);
  }
  CHECK(renders[1]->subject == "plain on 2 threads");
  CHECK(renders.back()->subject == "svm on 64 nodes, virtual");
  REQUIRE(of(results, "rays").size() == 1);
  CHECK(of(results, "rays")[0]->figures.subject == of(results, "rays")[0]->figures.baseline);
  CHECK(of(results, "build").size() == 1);
  CHECK(of(results, "distance").size() == 1);
}

TEST_CASE("whole commands are held against the plain renderer where a picture takes time") {
  std::set<std::string> subjects;
  for (const Comparison* const command : of(measured_in_two_rounds(), "command")) {
    CHECK(command->figures.rounds() <= 2);  // so small a picture may take no longer than the smallest
    for (const double seconds : command->figures.subject) {
      CHECK(seconds > 0);
    }
    subjects.insert(command->subject);
  }
  CHECK(subjects == std::set<std::string>{"svm on 1 node", "svm on 2 nodes", "svm on 64 nodes", "svm on 64 nodes, pool",
                                          "dataflow on 64 nodes, pool"});
}

}  // namespace dmpc::tests::plain_test
