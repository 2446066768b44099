// Our scenes for POV-Ray, and its pictures of them.
#include "apps/lab/bench/speed/pov_rival.h"

#include <doctest/doctest.h>

#include <string>

#include "apps/lab/bench/speed/plain_stage.h"
#include "apps/lab/bench/speed/pov_file.h"
#include "core/base/expect.h"
#include "core/picture/render.h"
#include "tests/support/small_subject.h"
#include "tests/support/text.h"

namespace dmpc::tests::pov_rival_test {

using apps::PovRival;

namespace {

core::Film film_of(const apps::Subject& subject) {
  core::Operations operations;
  core::LocalRecords records(subject.database.bytes());
  core::GridTracer<core::LocalRecords> tracer(records, subject.settings.header, subject.settings.skips);
  return core::render(tracer, subject.settings, operations);
}

std::string text_of(const std::string& scene) {
  const apps::Subject subject = small_subject(scene, {48, 40});
  return apps::pov_of(apps::PlainStage(subject, apps::EmbreeMode::robust));
}

std::size_t count_of(const std::string& words, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) {
    ++count;
  }
  return count;
}

}  // namespace

TEST_CASE("a scene for POV-Ray has its camera, lights, background, materials and shapes") {
  const std::string text = text_of("rings-1");
  CHECK(contains(text, "max_trace_level 5"));
  CHECK(contains(text, "camera { perspective location <"));
  CHECK(count_of("background { color rgb <", text) == 1);
  CHECK(count_of("light_source {", text) == 3);
  CHECK(count_of("\nsphere {", text) == 30);
  CHECK(count_of("\ncone {", text) == 30);
  CHECK(contains(text, " open texture { M"));
  CHECK(count_of("smooth_triangle {", text_of("teapot-3")) > 100);
  CHECK(count_of("\ntriangle {", text_of("tetra-2")) == 4 * 4);
}

TEST_CASE("what transmits stands twice in a scene for POV-Ray, once for its shadow") {
  const std::string text = text_of("mount-2");
  CHECK(count_of("no_shadow", text) == 4);
  CHECK(count_of("no_image no_reflection", text) == 4);
  CHECK(contains(text, " transmit "));
  CHECK(contains(text, "interior { ior "));
}

TEST_CASE("a binary picture of 16 bits is read as linear") {
  const std::string head = "P6\n# by somebody\n2 1\n65535\n";
  const apps::PlainPicture picture = apps::picture_in_ppm(head + std::string("\xff\xff\0\0\x80\0\0\1\0\0\0\0", 12));
  REQUIRE(picture.pixels.size() == 2);
  CHECK(picture.pixels[0] == core::Color{1, 0, 32768.0F / 65535});
  CHECK(picture.pixels[1] == core::Color{1.0F / 65535, 0, 0});
  for (const std::string& damaged : {std::string(), head, "P3" + head.substr(2) + std::string(12, ' '),
                                     std::string("P6 2 1 255\n") + std::string(12, ' '), head + std::string(13, ' ')}) {
    CHECK_THROWS_AS(apps::picture_in_ppm(damaged), core::InputError);
  }
}

TEST_CASE("what POV-Ray's tracing took stands among what it says") {
  const std::string said =
      "  Parse Time:       0 hours  0 minutes  0 seconds (0.100 seconds)\n              using 1 thread(s) with 0.200 CPU-seconds "
      "total\n"
      "  Trace Time:       0 hours  1 minutes  0 seconds (60.470 seconds)\n"
      "              using 2 thread(s) with 120.850 CPU-seconds total\n";
  const auto times = apps::trace_times_in(said);
  REQUIRE(times);
  CHECK(times->wall_seconds == 60.470);
  CHECK(times->processor_seconds == 120.850);
  for (const char* const other : {"", "Trace Time:", "Trace Time: (1 seconds)", "(1.5 seconds) 2 CPU-seconds"}) {
    CHECK_FALSE(apps::trace_times_in(other));
  }
}

TEST_CASE("POV-Ray's picture of a scene is ours") {
  if (!PovRival::is_installed()) {
    MESSAGE("POV-Ray is not installed");
    return;
  }
  for (const char* scene : {"tetra-3", "teapot-3", "mount-4", "balls-2", "balls-2-t2", "rings-2", "tree-3"}) {
    CAPTURE(std::string(scene));
    const apps::Subject subject = small_subject(scene, {96, 80});
    apps::Interrupt interrupt;
    const PovRival rival(subject);
    CHECK(rival.render(1, interrupt).processor_seconds >= 0);
    CHECK(apps::pov_distance_to_ours(rival.picture(), film_of(subject), scene) <= apps::pov_error_max);
  }
}

TEST_CASE("a picture of POV-Ray's that is not ours is an error") {
  const apps::Subject subject = small_subject("tetra-2", {48, 40});
  const core::Film film = film_of(subject);
  const apps::PlainPicture black{.pixels = core::ZeroedArray<core::Color>(48 * 40)};
  CHECK_THROWS_WITH_AS(apps::pov_distance_to_ours(black, film, "tetra-2"), doctest::Contains("expected 5/255 at most"),
                       core::InternalError);
}

}  // namespace dmpc::tests::pov_rival_test
