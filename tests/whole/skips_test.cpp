// Work that a scene does not need: whatever is left out or not, the film is the same, and what was left out is counted.
#include "core/trace/skips.h"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/picture/render.h"
#include "nodes/machine.h"
#include "tests/support/film_of.h"
#include "tests/support/scaled.h"
#include "tests/support/small_scenes.h"
#include "tests/support/strategies.h"
#include "tests/support/subject.h"

namespace dmpc::tests::whole_skips_test {

namespace {

using core::Operations;
using core::RayKind;
using core::Skip;
using core::Skips;

/// All but one, for each, and none at all.
std::vector<Skips> switched_off() {
  std::vector<Skips> all{core::no_skips()};
  for (const Skip& skip : core::all_skips) {
    all.push_back(core::without(skip));
  }
  return all;
}

/// Many macro cells, most of them empty, and a background that is known, so that every skip acts.
Subject subject_of(const core::Scene& scene, Subject::Size size = {16, 12}) {
  size.knows_background = true;
  return Subject(scene, size, {.page_size_bytes = 512, .cells_per_primitive = 2048});
}

Operations reference(const Subject& subject, const core::RenderSettings& settings) {
  Operations operations;
  tests::film_of(subject.database(), settings, operations);
  return operations;
}

/// As many regions as make some of them empty.
dataflow::RunOptions many_regions() {
  return {.computer = {.node_count = 24}, .rays = {.balance = {.balance = dataflow::Balance::equal_size}}};
}

std::uint64_t count_of(const Operations& operations, RayKind kind) { return operations.rays[static_cast<std::size_t>(kind)]; }

std::uint64_t messages_of(const dataflow::Report& report) { return report.gathers().rays; }

}  // namespace

TEST_CASE("skips: whichever is off, svm, replicated and dataflow give one film, with a cache of one page too") {
  for (const core::Scene& scene : {everything(), built_in("gears-1")}) {
    CAPTURE(scene.name);
    const Subject subject = subject_of(scene, {scaled_edge(16), scaled_edge(12)});
    const std::uint64_t film = subject.outcome().film_hash;
    for (const Skips& skips : switched_off()) {
      CHECK(run_svm(subject, {.computer = {.node_count = 3}}, skips).film.hash() == film);
      CHECK(run_svm(subject, {.computer = {.node_count = 3}, .pages = {.cache_pages = 1}}, skips).film.hash() == film);
      CHECK(run_replicated(subject, {.computer = {.node_count = 2}}, skips).film.hash() == film);
      CHECK(run_dataflow(subject, many_regions(), skips).film.hash() == film);
      CHECK(
          run_dataflow(subject, {.computer = {.node_count = 3}, .rays = {.ray_batch = 1, .ray_credits = 0}}, skips).film.hash() ==
          film);
    }
  }
}

TEST_CASE("skips: whichever is off, a modelled machine gives the same film") {
  const Subject subject = subject_of(everything(), {8, 8});
  const std::uint64_t film = subject.outcome().film_hash;
  for (const Skips& skips : switched_off()) {
    CHECK(run_svm(subject, {.computer = {.node_count = 3, .machine = nodes::Machine{}}, .pages = {.cache_pages = 1}}, skips)
              .film.hash() == film);
    dataflow::RunOptions options = many_regions();
    options.computer.machine = nodes::Machine{};
    CHECK(run_dataflow(subject, options, skips).film.hash() == film);
  }
}

TEST_CASE("skips: refined pictures and the paper's convention keep their films, too") {
  const Subject refined =
      subject_of(mirrors_and_glass(), {.width = 12, .height = 12, .samples = 2, .refinement = {.error = 0.02, .samples_max = 8}});
  core::RenderSettings paper = refined.settings();
  paper.shade.convention = core::Convention::paper;
  for (const Skips& skips : switched_off()) {
    CHECK(run_svm(refined, {.computer = {.node_count = 3}}, skips).film.hash() == refined.outcome().film_hash);
    CHECK(run_dataflow(refined, many_regions(), skips).film.hash() == refined.outcome().film_hash);
    paper.skips = skips;
    CHECK(svm::run_svm(refined.database(), paper, {.computer = {.node_count = 2}}, {}).film.hash() ==
          refined.outcome().film_hash);
  }
}

TEST_CASE("skips: each counts what it leaves out, and nothing when it is off") {
  const Subject subject = subject_of(everything());
  const core::SkippedWork pages = run_svm(subject, {.computer = {.node_count = 3}}).operations().skipped;
  const core::SkippedWork rays = run_dataflow(subject, many_regions()).operations().skipped;
  for (const Skip& skip : core::all_skips) {
    CAPTURE(std::string(skip.name));
    CHECK(pages.*skip.avoided + rays.*skip.avoided > 0);
    CHECK(run_svm(subject, {.computer = {.node_count = 3}}, core::without(skip)).operations().skipped.*skip.avoided == 0);
    CHECK(run_dataflow(subject, many_regions(), core::without(skip)).operations().skipped.*skip.avoided == 0);
  }
}

TEST_CASE("skips: rays left out are as many whoever renders, and children as many with a cache of one page, by rays alone") {
  const Subject subject = subject_of(everything());
  const core::SkippedWork expected = reference(subject, subject.settings()).skipped;
  const core::SkippedWork svm =
      run_svm(subject, {.computer = {.node_count = 3}, .pages = {.cache_pages = 1}}).operations().skipped;
  const core::SkippedWork dataflow = run_dataflow(subject, many_regions()).operations().skipped;
  const core::SkippedWork alone =
      run_svm(subject, {.computer = {.node_count = 3}, .pages = {.cache_pages = 1}}, {.bundles = false}).operations().skipped;
  for (const core::SkippedWork& skipped : {svm, alone, dataflow}) {
    CHECK(skipped.unlit == expected.unlit);
    CHECK(skipped.zero_terms == expected.zero_terms);
    CHECK(skipped.background == expected.background);
  }
  CHECK(alone.any_hit == expected.any_hit);
  CHECK(alone.bundles == 0);
  CHECK(svm.empty_regions == 0);
}

TEST_CASE("skips: rays and hits are as many with empty regions and hits behind the first skipped or not") {
  const Subject subject = subject_of(everything());
  const Skips skips{.any_hit = false, .empty_regions = false};
  CHECK(outcome_of(run_svm(subject, {.computer = {.node_count = 3}}, skips)) == subject.outcome());
  CHECK(outcome_of(run_dataflow(subject, many_regions(), skips)) == subject.outcome());
}

TEST_CASE("skips: shadow rays that look for the nearest hit read more BVH nodes or test more primitives") {
  const Subject subject = subject_of(everything());
  const Operations on = reference(subject, subject.settings()), off = reference(subject, subject.settings({.any_hit = false}));
  const auto work = [](const Operations& operations) {
    return operations.bvh_node_reads + operations.primitive_tests[0] + operations.primitive_tests[1] +
           operations.primitive_tests[2];
  };
  CHECK(work(off) > work(on));
}

TEST_CASE("skips: with unlit off a shadow ray more is shot for each light behind a surface, and no other ray") {
  const Subject subject = subject_of(everything());
  const Operations on = reference(subject, subject.settings()), off = reference(subject, subject.settings({.unlit = false}));
  CHECK(count_of(off, RayKind::shadow) == count_of(on, RayKind::shadow) + on.skipped.unlit);
  CHECK(off.ray_count() == on.ray_count() + on.skipped.unlit);
}

TEST_CASE("skips: with zero terms off a ray more is shot for each one left out") {
  const Subject subject = subject_of(everything());
  core::RenderSettings on = subject.settings(), off = subject.settings({.zero_terms = false});
  on.shade.depth_max = off.shade.depth_max = 1;  // shadow rays only
  CHECK(reference(subject, on).skipped.zero_terms > 0);
  CHECK(reference(subject, off).ray_count() == reference(subject, on).ray_count() + reference(subject, on).skipped.zero_terms);
  on.shade.depth_max = off.shade.depth_max = 2;
  on.header.light_count = off.header.light_count = 0;  // reflected and refracted rays only
  CHECK(reference(subject, on).skipped.zero_terms > 0);
  CHECK(reference(subject, off).ray_count() == reference(subject, on).ray_count() + reference(subject, on).skipped.zero_terms);
}

TEST_CASE("skips: zero terms that are shot go on to the depth allowed and leave total internal reflection alone") {
  const Subject subject = subject_of(everything());
  core::RenderSettings on = subject.settings(), off = subject.settings({.zero_terms = false});
  on.header.light_count = off.header.light_count = 0;
  const Operations few = reference(subject, on), many = reference(subject, off);
  REQUIRE(few.total_internal_reflections > 0);
  CHECK(many.total_internal_reflections >= few.total_internal_reflections);
  CHECK(many.ray_count() > few.ray_count() + few.skipped.zero_terms);
  CHECK(run_svm(subject, {.computer = {.node_count = 1}}, core::no_skips()).operations().deposits_saturated == 0);
}

TEST_CASE("skips: the paper's convention shoots shadow rays that bring nothing, whatever is skipped") {
  const Subject subject = subject_of(everything());
  core::RenderSettings settings = subject.settings();
  settings.shade = {.convention = core::Convention::paper, .depth_max = 1};
  const Operations operations = reference(subject, settings);
  CHECK(count_of(operations, RayKind::shadow) == operations.primary_hits * settings.header.light_count);
  CHECK(operations.skipped.unlit + operations.skipped.zero_terms == 0);
}

TEST_CASE("skips: passing regions by where a ray meets nothing saves messages") {
  const Subject subject = subject_of(everything());
  const dataflow::Report on = run_dataflow(subject, many_regions());
  const dataflow::Report off = run_dataflow(subject, many_regions(), {.empty_regions = false});
  CHECK(messages_of(off) > messages_of(on));
  CHECK(on.operations().skipped.empty_regions > 0);
  CHECK(off.operations().skipped.empty_regions == 0);
}

}  // namespace dmpc::tests::whole_skips_test
