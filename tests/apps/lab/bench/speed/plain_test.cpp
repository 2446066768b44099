// The plain renderer of `bench speed`, and how all else is held against it.

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "apps/lab/bench/speed/packet_renderer.h"
#include "apps/lab/bench/speed/parts.h"
#include "apps/lab/bench/speed/plain_contender.h"
#include "apps/lab/bench/speed/plain_renderer.h"
#include "apps/lab/bench/speed/plain_table.h"
#include "apps/lab/bench/speed/timed_process.h"
#include "core/base/expect.h"
#include "core/picture/render.h"
#include "tests/support/small_subject.h"
#include "tests/support/text.h"

namespace dmpc::tests::plain_test {

using apps::Comparison;
using apps::PlainPicture;
using apps::PlainRenderer;
using apps::SpeedPart;

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

/// A part plain of two scenes and two renderers, in two rounds.
std::vector<Comparison> measured() {
  std::vector<Comparison> results;
  for (const auto& [scene, scale] : {std::pair{"a", 1.0}, std::pair{"b", 4.0}}) {
    for (const char* subject : {"plain on 2 threads", "svm on 2 nodes"}) {
      const double ratio = std::string(subject) == "svm on 2 nodes" ? 2 * scale : 1;
      for (const char* clock : {"wall clock", "processor time"}) {
        const double seconds = std::string(clock) == "wall clock" ? 1e-3 : 2e-3;
        results.push_back({SpeedPart::plain,
                           scene,
                           "render",
                           clock,
                           2,
                           subject,
                           "plain on 2 threads",
                           "s",
                           {ratio * seconds, ratio * seconds},
                           {seconds, seconds}});
      }
    }
    results.push_back(
        {SpeedPart::plain, scene, "command", "processor time", 2, "svm on 2 nodes", "plain on 2 threads", "s", {3}, {1}});
    results.push_back({SpeedPart::plain, scene, "rays", "", 0, "ours", "plain", "rays", {1000}, {1000}});
    results.push_back({SpeedPart::plain, scene, "distance", "", 0, "plain to ours", "1/255", "", {0.002}, {0.004}});
    results.push_back({SpeedPart::plain, scene, "packets' distance", "", 0, "packets to ours", "1/255", "", {0.001}, {0.004}});
    results.push_back({SpeedPart::plain, scene, "build", "", 0, "database", "Embree", "s", {3}, {1}});
  }
  return results;
}

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
  for (const char* scene : {"tetra-3", "teapot-3", "mount-4", "balls-2", "balls-2-t2", "rings-2", "tree-3", "gears-1"}) {
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

TEST_CASE("packets of 16 shoot the plain renderer's rays, and their picture is ours") {
  // The pictures' sides are no multiples of a tile's or a packet's.
  for (const char* scene : {"tetra-3", "teapot-3", "mount-4", "balls-2", "balls-2-t2", "rings-2", "tree-3", "gears-1"}) {
    CAPTURE(std::string(scene));
    const apps::Subject subject = small_subject(scene, {49, 42});
    const Ours ours(subject);
    const PlainPicture plain = PlainRenderer(subject).render(1);
    for (const apps::EmbreeMode mode : {apps::EmbreeMode::robust, apps::EmbreeMode::fast}) {
      const PlainPicture picture = apps::PacketRenderer(subject, mode).render(1);
      CHECK(static_cast<double>(picture.rays) == doctest::Approx(static_cast<double>(plain.rays)).epsilon(0.005));
      CHECK(apps::distance_to_ours(picture, ours.film, scene) <= apps::plain_error_max);
    }
  }
}

TEST_CASE("packets show an ambient light as ours does") {
  apps::Subject subject = small_subject("teapot-3", {48, 40});
  subject.settings.header.ambient = {0.5F, 0.25F, 0.125F};
  const PlainPicture picture = apps::PacketRenderer(subject, apps::EmbreeMode::robust).render(1);
  CHECK_NOTHROW(apps::distance_to_ours(picture, Ours(subject).film, "teapot-3"));
}

TEST_CASE("the picture of packets is the same on any number of threads") {
  const apps::Subject subject = small_subject("balls-2-t2", {48, 40});
  const apps::PacketRenderer renderer(subject, apps::EmbreeMode::robust);
  const PlainPicture one = renderer.render(1), three = renderer.render(3);
  CHECK(std::ranges::equal(one.pixels.span(), three.pixels.span()));
  CHECK(one.rays == three.rays);
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
  const std::vector<Comparison> results = measured_in_two_rounds();
  const std::vector<const Comparison*> renders = of(results, "render");
  REQUIRE(renders.size() >= 2 * 20);
  for (std::size_t i = 0; i < renders.size(); ++i) {
    CAPTURE(renders[i]->subject);
    CHECK(renders[i]->subject_figures.size() == 2);
    const bool is_beside = contains(renders[i]->subject, "beside 8 busy");
    CHECK(renders[i]->rival == (is_beside ? "plain on 2 threads, beside 8 busy" : "plain on 2 threads"));
    CHECK((is_beside || renders[i]->rival_figures == renders[i % 2]->subject_figures));
  }
  CHECK(renders[0]->subject == "plain on 2 threads");
  REQUIRE(of(results, "rays").size() == 1);
  CHECK(of(results, "rays")[0]->subject_figures == of(results, "rays")[0]->rival_figures);
}

TEST_CASE("whole commands, and one beside busy processes, are held against the plain renderer where a picture takes time") {
  const std::vector<Comparison> results = measured_in_two_rounds();
  std::set<std::string> subjects;
  for (const Comparison* const command : of(results, "command")) {
    CHECK(command->rounds() <= 2);  // so small a picture may take no longer than the smallest
    for (const double seconds : command->subject_figures) {
      CHECK(seconds > 0);
    }
    subjects.insert(command->subject);
  }
  for (const char* name : {"svm on 1 node", "svm on 2 nodes", "svm on 64 nodes", "svm on 64 nodes, pool",
                           "svm on 64 nodes, pool, beside 8 busy", "dataflow on 64 nodes, pool"}) {
    CHECK(subjects.contains(name));
  }
  CHECK(of(results, "writing").size() == 1);
  REQUIRE(of(results, "ranks").size() == (apps::program_on_path("mpirun") ? 1 : 0));
  for (const Comparison* const ranks : of(results, "ranks")) {
    CHECK(ranks->rounds() == 2);
    CHECK(ranks->subject_figures[0] > 1e-6);  // what is timed, not the difference of two times
  }
}

TEST_CASE("two of ours that are compared have the figures of their renders") {
  const std::vector<Comparison> results = measured_in_two_rounds();
  const auto figures = [&](const std::string& subject, const std::string& clock) {
    for (const Comparison* const render : of(results, "render")) {
      if (render->subject == subject && render->detail == clock) {
        return render->subject_figures;
      }
    }
    return std::vector<double>();
  };
  REQUIRE(of(results, "pair").size() == 2 * apps::plain_pairs().size());
  for (const Comparison* const pair : of(results, "pair")) {
    CAPTURE(pair->subject);
    CHECK(pair->subject_figures == figures(pair->subject, pair->detail));
    CHECK(pair->rival_figures == figures(pair->rival, pair->detail));
  }
}

TEST_CASE("the table of part plain has a row for each renderer, means over scenes and its times for a ray") {
  const apps::Table table = apps::plain_table(measured(), "title");
  REQUIRE(table.rows().size() == 2);
  const auto& row = table.rows()[1];
  CHECK(std::get<std::string>(row[0]) == "svm on 2 nodes");
  const std::vector<double> expected = {4, 4000, 4, 2, 8, 8, 8000, 4, 3};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(std::get<double>(row[i + 1]) == doctest::Approx(expected[i]));
  }
  CHECK(std::holds_alternative<std::monostate>(table.rows()[0].back()));  // nobody has measured a command of the plain renderer
  REQUIRE(apps::plain_notes(measured()).size() == 2);
  CHECK(contains(apps::plain_notes(measured())[1], "POV-Ray has no row: it is not installed (povray)"));
  CHECK(contains(apps::plain_notes(measured())[0], "our rays over the plain renderer's 1.000 (1.000 to 1.000)"));
  CHECK(contains(apps::plain_notes(measured())[0], "3.000 (3.000 to 3.000)"));
}

TEST_CASE("without part plain its table is empty, and nothing is said of it") {
  const std::vector<Comparison> others = {{SpeedPart::kernel, "a", "render", "wall clock", 1, "x", "y", "s", {1}, {1}}};
  CHECK(apps::plain_table(others, "").rows().empty());
  CHECK(apps::plain_notes(others).empty());
}

}  // namespace dmpc::tests::plain_test
