#include "core/families/scenes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/elementary.h"
#include "core/base/expect.h"
#include "tests/support/complaint.h"
#include "tests/support/tables.h"
#include "tests/support/text.h"

namespace scenes_test {

using namespace dmpc::core;
using dmpc::tests::contains;

namespace {

/// Counts what a generator sends and measures its box, storing nothing.
struct Census final : SceneSink {
  std::uint64_t polygons = 0, patches = 0, spheres = 0, cones = 0, triangles = 0, lights = 0, materials = 0, views = 0,
                backgrounds = 0;
  std::uint64_t unrounded = 0;  ///< numbers of more than 6 digits
  Vec3d low{1e30, 1e30, 1e30}, high{-1e30, -1e30, -1e30};

  std::uint64_t objects() const { return polygons + patches + spheres + cones; }

  void background(const Vec3d&) override { ++backgrounds; }
  void view(const View&) override { ++views; }
  void light(const PointLight&) override { ++lights; }
  void material(const Material&) override { ++materials; }
  void polygon(const std::vector<Vec3d>& vertices) override {
    ++polygons;
    add(vertices);
  }
  void patch(const std::vector<Vec3d>& vertices, const std::vector<Vec3d>&) override {
    ++patches;
    add(vertices);
  }
  void sphere(const Vec3d& center, double radius) override {
    ++spheres;
    grow(center, {radius, radius, radius});
  }
  void cone(const Vec3d& base, double base_radius, const Vec3d& apex, double apex_radius) override {
    ++cones;
    const Vec3d axis = normalize(apex - base);
    const Vec3d disc = {std::sqrt(1 - std::min(1.0, axis.x * axis.x)), std::sqrt(1 - std::min(1.0, axis.y * axis.y)),
                        std::sqrt(1 - std::min(1.0, axis.z * axis.z))};
    grow(base, disc * base_radius);
    grow(apex, disc * apex_radius);
  }

 private:
  void add(const std::vector<Vec3d>& vertices) {
    triangles += vertices.size() - 2;
    for (const Vec3d& vertex : vertices) {
      grow(vertex, {});
    }
  }
  void grow(const Vec3d& center, const Vec3d& reach) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      unrounded += round_to_6_digits(center[axis]) == center[axis] ? 0 : 1;
      low[axis] = std::min(low[axis], center[axis] - reach[axis]);
      high[axis] = std::max(high[axis], center[axis] + reach[axis]);
    }
  }
};

Census census(const char* name) {
  Census result;
  generate_scene(parse_scene_name(name), result);
  return result;
}

/// A file that the SPD's own generator made, measured.
struct Known {
  std::string name;
  std::uint64_t spheres, cones, polygons, patches, lights, materials, triangles;
  Vec3d low, high;
};

Vec3d point_of(const std::string& cell) {
  const std::vector<double> all = dmpc::tests::numbers_of(cell);
  return {all.at(0), all.at(1), all.at(2)};
}

std::vector<Known> known_scenes() {
  std::vector<Known> scenes;
  for (const auto& row : dmpc::tests::rows_in("core/families/scenes.txt", 4)) {
    std::vector<std::uint64_t> counts;
    for (const double number : dmpc::tests::numbers_of(row[1])) {
      counts.push_back(static_cast<std::uint64_t>(number));
    }
    scenes.push_back({row[0], counts.at(0), counts.at(1), counts.at(2), counts.at(3), counts.at(4), counts.at(5), counts.at(6),
                      point_of(row[2]), point_of(row[3])});
  }
  return scenes;
}

std::string message_of(const char* name) {
  return dmpc::tests::complaint_of([&] { parse_scene_name(name); });
}

}  // namespace

TEST_CASE("every family has the counts of the SPD's own files") {
  for (const Known& known : known_scenes()) {
    const Census found = census(known.name.c_str());
    CAPTURE(known.name);
    CHECK(found.spheres == known.spheres);
    CHECK(found.cones == known.cones);
    CHECK(found.polygons == known.polygons);
    CHECK(found.patches == known.patches);
    CHECK(found.lights == known.lights);
    CHECK(found.materials == known.materials);
    CHECK(found.triangles == known.triangles);
    CHECK(found.views == 1);
    CHECK(found.backgrounds == 1);
  }
}

TEST_CASE("every family has the box of the SPD's own files") {
  for (const Known& known : known_scenes()) {
    const Census found = census(known.name.c_str());
    CAPTURE(known.name);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      CAPTURE(axis);
      const double margin = 1e-3 * std::max({1.0, std::abs(known.low[axis]), std::abs(known.high[axis])});
      CHECK(std::abs(found.low[axis] - known.low[axis]) < margin);
      CHECK(std::abs(found.high[axis] - known.high[axis]) < margin);
    }
  }
}

TEST_CASE("the count by formula is the count of what is generated, and every number has 6 digits") {
  for (const Known& known : known_scenes()) {
    const Census found = census(known.name.c_str());
    CAPTURE(known.name);
    CHECK(primitive_count(parse_scene_name(known.name)) == found.objects());
    CHECK(found.unrounded == 0);
  }
}

TEST_CASE("the counts of scenes too large to generate here") {
  CHECK(primitive_count(parse_scene_name("tetra-10")) == 1048576);
  CHECK(primitive_count(parse_scene_name("rings-7-t3")) == 554401);
  CHECK(primitive_count(parse_scene_name("balls-4-t4")) == 7381 * 192 + 1);
  CHECK(primitive_count(parse_scene_name("mount-7")) == 32772);
  CHECK(primitive_count(parse_scene_name("mount-11")) == 8388612);
  CHECK(primitive_count(parse_scene_name("teapot-508")) == 64 * 508 * 508 - 8 * 508 + 508 * 508);
}

TEST_CASE("a triangle scene of a million entities has them") {
  const Census found = census("tetra-10");
  CHECK(found.polygons == 1048576);
  CHECK(found.unrounded == 0);
}

TEST_CASE("a family alone has the default size of the SPD, teapot 12") {
  const std::vector<std::string> names = {"balls-4",  "gears-4",    "jacks-1",   "lattice-12", "mount-6", "rings-7",
                                          "shells-5", "sombrero-1", "teapot-12", "tetra-6",    "tree-11"};
  for (const std::string& name : names) {
    CHECK(parse_scene_name(name.substr(0, name.find('-'))).text() == name);
  }
}

TEST_CASE("a name is read into its parts and written back") {
  const SceneName rings = parse_scene_name("rings-4-t1");
  CHECK(rings.family == "rings");
  CHECK(rings.size == 4);
  CHECK(rings.tessellation == 1);
  CHECK(rings.text() == "rings-4-t1");
  CHECK(parse_scene_name("balls-t2").text() == "balls-4-t2");
  CHECK(parse_scene_name("tetra-09").text() == "tetra-9");
}

TEST_CASE("a text that is no family's name may be a file's") {
  for (const char* text :
       {"", "foo", "foo-4", "teapots", "teapot.nff", "balls-4.nff", "mount-6-t6.nff", "./teapot", "rings-4/a.nff", "Teapot"}) {
    CAPTURE(std::string(text));
    CHECK_FALSE(find_scene_name(text).has_value());
  }
}

TEST_CASE("an unknown family is refused with the families and an example") {
  const std::string message = message_of("pyramid-3");
  CHECK(contains(message, "'pyramid-3'"));
  CHECK(contains(message, "balls gears jacks lattice mount rings shells sombrero teapot tetra tree"));
  CHECK(contains(message, "rings-4-t1"));
}

TEST_CASE("a malformed name is refused with an example") {
  for (const char* text : {"teapot-", "teapot-x", "teapot--1", "teapot-1.5x-", "teapot-4-", "teapot-4-t", "teapot-4-t0",
                           "teapot-4-t2x", "teapot-4-3", "teapot 4", "teapot-t2-4"}) {
    CAPTURE(std::string(text));
    CHECK(contains(message_of(text), "expected"));
    CHECK_THROWS_AS(parse_scene_name(text), InputError);
  }
}

TEST_CASE("a size out of range is refused with the range") {
  CHECK(contains(message_of("mount-12"), "between 1 and 11"));
  CHECK(contains(message_of("balls-0"), "between 1 and 7"));
  CHECK(contains(message_of("tetra-13"), "between 1 and 12"));
  CHECK(contains(message_of("tree-99999999999999999999"), "between 1 and 22"));
  CHECK(contains(message_of("rings-1-t1000"), "between 1 and 215"));
  CHECK(contains(message_of("tree-22-t9"), "too large to be tessellated"));
  CHECK(contains(message_of("jacks-7-t1"), "too large to be tessellated"));
  CHECK_THROWS_AS(check_scene_name({.family = "tetra", .size = -1}), InputError);
  CHECK_THROWS_AS(check_scene_name({.family = "tetra", .size = 3, .tessellation = -1}), InputError);
  CHECK_THROWS_AS(built_in_scene({.family = "", .size = 3}), InputError);
}

TEST_CASE("the smallest and the largest size of every family are accepted") {
  for (const char* name :
       {"balls-1",  "balls-7",    "gears-1", "gears-48", "jacks-1",  "jacks-7",   "lattice-1",    "lattice-160",
        "mount-1",  "mount-11",   "rings-1", "rings-93", "shells-1", "shells-16", "sombrero-1",   "sombrero-7",
        "teapot-1", "teapot-508", "tetra-1", "tetra-12", "tree-1",   "tree-22",   "rings-1-t215", "balls-1-t373"}) {
    CAPTURE(std::string(name));
    CHECK(primitive_count(parse_scene_name(name)) <= 16'777'216);
  }
}

TEST_CASE("tessellation changes nothing where nothing is curved, and is always 2 for jacks") {
  for (const char* family : {"gears-1", "sombrero-1", "teapot-3", "tetra-3"}) {
    CHECK(census((std::string(family) + "-t5").c_str()).objects() == census(family).objects());
  }
  CHECK(census("jacks-2-t5").patches == census("jacks-2-t2").patches);
}

TEST_CASE("tessellated jacks have normals as long as their frame is small") {
  const Scene scene = built_in_scene(parse_scene_name("jacks-2-t2"));
  CHECK(length(scene.normals.front()) == doctest::Approx(4.0 / 3).epsilon(1e-5));
  CHECK(length(scene.normals.back()) == doctest::Approx(8.0 / 3).epsilon(1e-5));
}

TEST_CASE("a built-in scene carries its name, and its merged materials") {
  const Scene scene = built_in_scene(parse_scene_name("lattice-2"));
  CHECK(scene.name == "lattice-2");
  CHECK(scene.objects.size() == 81);
  CHECK(scene.materials.size() == 4);
  CHECK(scene.lights.size() == 6);
  CHECK_FALSE(scene.lights[0].has_color);
  CHECK(scene.view.angle_degrees == 60);
}

TEST_CASE("neighbouring teapot patches share their corners exactly") {
  const Scene scene = built_in_scene(parse_scene_name("teapot-4"));
  std::vector<Vec3d> corners;
  for (const Object& object : scene.objects) {
    const auto first = scene.vertices.begin() + static_cast<std::ptrdiff_t>(object.first);
    corners.insert(corners.end(), first, first + static_cast<std::ptrdiff_t>(object.vertex_count));
  }
  int split = 0;
  for (const Vec3d& a : corners) {
    for (const Vec3d& b : corners) {
      split += !(a == b) && length(a - b) < 3e-5 ? 1 : 0;
    }
  }
  CHECK(split == 0);
}

TEST_CASE("the list of families names each with its range") {
  const std::string text = describe_scene_families();
  CHECK(contains(text, "mount     size 1 to 11, default 6\n"));
  CHECK(std::count(text.begin(), text.end(), '\n') == 11);
}

}  // namespace scenes_test
