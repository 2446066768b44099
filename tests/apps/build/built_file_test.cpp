#include "apps/build/built_file.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "apps/render/picture_identity.h"
#include "core/base/expect.h"
#include "core/database/conversion.h"
#include "tests/support/complaint.h"
#include "tests/support/painted_square.h"
#include "tests/support/run_dmpc.h"
#include "tests/support/stored_database.h"
#include "tests/support/text.h"

namespace dmpc::tests::built_file_test {

namespace {

/// With the options of building, and others that a render has besides.
struct Line {
  Words building, rendering;
};

Words joined(const Words& words, const Words& more) { return together({words, more}); }

void check_same(const apps::Subject& stored, const apps::Subject& built) {
  CHECK(std::ranges::equal(stored.database.bytes(), built.database.bytes()));
  CHECK(stored.database.primitives().size() == built.database.primitives().size());
  CHECK(stored.database.references() == built.database.references());
  CHECK(stored.database.records().copied == built.database.records().copied);
  CHECK(stored.database.pad() == built.database.pad());
  CHECK(apps::notes_of(stored) == apps::notes_of(built));
  CHECK(stored.settings.shade.film_scale.exponent == built.settings.shade.film_scale.exponent);
  CHECK(film_hash(stored) == film_hash(built));
}

std::string usage_complaint(const Words& words) {
  return complaint_of<core::UsageError>([&] { render_line(words); });
}

std::string refusal(const Words& words) {
  return complaint_of([&] { subject_of_line(words); });
}

}  // namespace

TEST_CASE("a stored database has the bytes, notes and film of its scene, whatever it was built with") {
  const TemporaryFolder folder;
  const std::string square = write_painted_square(folder, 16);
  const Words size = {"--resolution=16x16"};
  for (const Line& line :
       {Line{{"rings-1"}, {}},
        {{"balls-1", "--structure=voxels", "--page-size=4KiB"}, {"--nodes=3"}},
        {{"mount-3", "--record-order=scattered", "--light=1,2,3", "--background=0.2"}, {"--camera=0,-2,1/0,0,0"}},
        {{"tetra-3", "--structure=extents", "--page-size=4KiB"}, {"--strategy=forest"}},
        {{"teapot-2", "--transport=paths", "--sky=1/0.1", "--light-radius=0.1"}, {"--samples=2"}},
        {{"grove-3", "--instances=keep"}, {}},
        {{square, "--up=z", "--smooth=30"}, {"--samples=1", "--bounces=2"}},
        {{square, "--transport=whitted"}, {"--samples=2"}}}) {
    CAPTURE(line.building.front());
    const std::string file = build_database_file(folder, joined(line.building, size));
    check_same(subject_of_line(joined({file}, line.rendering)),
               subject_of_line(joined(joined(line.building, size), line.rendering)));
    std::filesystem::remove(file);
  }
}

TEST_CASE("a stored scene has the identities, bounds and digest of the scene") {
  const TemporaryFolder folder;
  const std::string square = write_painted_square(folder, 16);
  for (const Words& words : {Words{"balls-1"}, {"grove-3", "--instances=keep"}, {square, "--transport=paths"}}) {
    const apps::RenderOptions plain = render_line(words), with_file = render_line({build_database_file(folder, words)});
    const core::Scene scene = apps::load_scene(plain.picture), stored = apps::load_scene(with_file.picture);
    CHECK(apps::scene_digest(stored) == apps::scene_digest(scene));
    CHECK(apps::identity_of(with_file, stored).facts == apps::identity_of(plain, scene).facts);
    const core::Box bounds = core::bounds_of(stored, core::Parallel(0)), own = core::bounds_of(scene, core::Parallel(0));
    CHECK((bounds.low == own.low && bounds.high == own.high));
  }
}

TEST_CASE("options that decide a database agree with it or are refused, with what it has and what is needed") {
  const TemporaryFolder folder;
  const std::string file = build_database_file(folder, {"rings-1", "--light=1,2,3"});
  CHECK(refusal({file, "--light=1,2,3", "--page-size=1024", "--depth=2", "--samples=2"}).empty());
  for (const auto& [given, words] :
       {Complaint{"--page-size=4KiB", "built with --page-size=1KiB, and this needs --page-size=4KiB"},
        {"--structure=extents", "built with --structure=grid"},
        {"--light=3,2,1", "built with --light=1,2,3, and this needs --light=3,2,1"},
        {"--fill=0.5", "built with no --fill, and this needs --fill=0.5"},
        {"--transport=paths", "built with --transport=whitted"},
        {"--system=forest", "built with --"}}) {
    CAPTURE(given);
    CHECK(contains(refusal({file, given}), words));
    CHECK(contains(refusal({file, given}), "dmpc build SCENE"));
  }
  CHECK(contains(usage_complaint({file, "--strategy=forest"}),
                 "--structure=grid does not go with --strategy=forest: its nodes share one tree of boxes; nobody typed "
                 "--structure=grid, but " +
                     file + " was built with it"));
  CHECK(contains(complaint_of<core::UsageError>([&] { build_database_file(folder, {file}, "b.pages"); }), "is built already"));
  CHECK(contains(complaint_of<core::UsageError>([&] { build_database_file(folder, {"rings-1"}, "b.db"); }), "ends in .pages"));
}

TEST_CASE("a mesh file's defaults are those of its database in every command") {
  const TemporaryFolder folder;
  const std::string file = build_database_file(folder, {write_painted_square(folder, 16)});
  const apps::RenderOptions render = render_line({file});
  CHECK(render.picture.transport.is_by_paths());
  CHECK(render.picture.is_refined);
  CHECK(render.picture.refinement.error == apps::default_error(true).error);
  CHECK(run_dmpc({"info", file}).status == 0);
  CHECK(contains(run_dmpc({"render", file, "--transport=whitted", "-o", (folder / "a.exr").string()}).errors,
                 "built with --transport=paths, and this needs --transport=whitted"));
}

TEST_CASE("another camera sees the database if it is no farther away, or if that is for any") {
  const TemporaryFolder folder;
  const std::string near = build_database_file(folder, {"tetra-3"}),
                    any = build_database_file(folder, {"tetra-3", "--any-camera"}, "any.pages");
  const std::string close = "--camera=0.5,1,0.5/0,0,0/0,0,1", far = "--camera=50,40,30/0,0,0/0,0,1";
  for (const std::string& camera : {close, far}) {
    CHECK(film_hash(subject_of_line({any, camera, "--resolution=16x16"})) ==
          film_hash(subject_of_line({"tetra-3", camera, "--resolution=16x16"})));
  }
  CHECK(refusal({near, close}).empty());
  CHECK(contains(refusal({near, far}), "--any-camera"));
}

TEST_CASE("a render of a stored database has the counters and the run hash of the scene's, by the program") {
  const TemporaryFolder folder;
  const std::string file = folder / "balls.pages";
  const Said built = run_dmpc({"build", "balls-1", "-o", file});
  CHECK(built.status == 0);
  CHECK(built.output + built.errors == "");
  const auto stats = [&](const std::string& scene) {
    const std::string counters = folder / "counters.json";
    const Said said = run_dmpc({"render", scene, "--nodes=4", "--cache-pages=8", "--runner=virtual", "--resolution=24x24",
                                "--stats=" + counters, "-o", (folder / "a.exr").string(), "--quiet"});
    CHECK(said.status == 0);
    const std::string text = file_text(counters);
    return text.substr(0, text.find("\"seconds\"")) + file_text(folder / "a.exr");
  };
  CHECK(stats(file) == stats("balls-1"));
  CHECK(run_dmpc({"info", file}).status == 0);
  CHECK(contains(run_dmpc({"render", file, "-o", file}).errors, "SCENE"));
}

}  // namespace dmpc::tests::built_file_test
