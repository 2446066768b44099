// Materials, textures, lights and skies of pbrt scenes.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "apps/foreign/mesh/surface.h"
#include "apps/formats/mesh_sky.h"
#include "apps/picture/image_file.h"
#include "core/scene/texel.h"
#include "tests/support/pbrt_scenes.h"

namespace dmpc::apps::pbrt_looks_test {

using core::Material;
using core::Vec3d;
using tests::notes;
using tests::pbrt_refusal;
using tests::pbrt_triangle;
using tests::read_pbrt;

namespace {

const double pi = std::acos(-1);

Material material_of(const std::string& statements) {
  return tests::material_of_object(read_pbrt(statements + pbrt_triangle), 0);
}

bool is_near(const Vec3d& a, const Vec3d& b, double slack = 1e-6) { return core::largest_component(a - b) < slack; }

}  // namespace

TEST_CASE("what is diffuse has its reflectance, grey without one") {
  CHECK(material_of("").color == Vec3d{0.5, 0.5, 0.5});
  CHECK(material_of("Material \"diffuse\" \"rgb reflectance\" [0.1 0.2 0.3]\n").color == Vec3d{0.1, 0.2, 0.3});
  CHECK(!material_of("Material \"diffuse\" \"rgb reflectance\" [0.1 0.2 0.3]\n").microfacets.are_there());
  CHECK(is_near(material_of("Material \"diffuse\" \"spectrum reflectance\" [300 0.4 900 0.4]\n").color, {0.4, 0.4, 0.4}));
}

TEST_CASE("a metal is one, with what it reflects straight ahead as its colour, and its alpha as roughness squared") {
  const Material copper = material_of("Material \"conductor\" \"float roughness\" 0.0625\n");
  CHECK(copper.microfacets.metallic == 1);
  CHECK(copper.microfacets.roughness == doctest::Approx(0.5));  // alpha = sqrt(1/16), of which the root
  CHECK(copper.color.x > 0.9);
  CHECK(copper.color.x > copper.color.y);
  CHECK(copper.color.y > copper.color.z);
  // ((n-1)^2 + k^2) / ((n+1)^2 + k^2) with n = 1, k = 2: 4/8.
  const Material own = material_of(
      "Material \"conductor\" \"rgb eta\" [1 1 1] \"rgb k\" [2 2 2] \"float roughness\" 0.25 \"bool remaproughness\" false\n");
  CHECK(is_near(own.color, {0.5, 0.5, 0.5}));
  CHECK(own.microfacets.roughness == doctest::Approx(0.5));
  CHECK(material_of("Material \"conductor\" \"rgb reflectance\" [1 0 0]\n").color == Vec3d{1, 0, 0});
}

// Reckoned beforehand, nanometre by nanometre, of what was measured: Fresnel's reflection, by daylight and the observer of 1931.
TEST_CASE("named metals reflect straight ahead what their spectra say, wavelength by wavelength") {
  const auto metal = [](const std::string& name) {
    return material_of("Material \"conductor\" \"spectrum eta\" \"metal-" + name + "-eta\" \"spectrum k\" \"metal-" + name +
                       "-k\"\n")
        .color;
  };
  CHECK(is_near(material_of("Material \"conductor\"\n").color, {0.955, 0.638, 0.538}, 0.005));
  CHECK(is_near(metal("Cu"), {0.955, 0.638, 0.538}, 0.005));
  CHECK(is_near(metal("Au"), {1, 0.783, 0.343}, 0.005));  // whose red is 1.02, beyond what is reflected of white
  CHECK(is_near(metal("Ag"), {0.972, 0.960, 0.915}, 0.005));
  CHECK(is_near(metal("Al"), {0.913, 0.922, 0.925}, 0.005));
  CHECK(is_near(metal("CuZn"), {0.910, 0.778, 0.423}, 0.005));
  CHECK(is_near(metal("MgO"), {0.072, 0.073, 0.075}, 0.005));
  CHECK(is_near(metal("TiO2"), {0.232, 0.245, 0.273}, 0.005));
}

// A metal of index 1 and k 2 below a coat of 1.5: R of (1 + 2i) / 1.5, combined with both faces of the coat.
TEST_CASE("a metal below a coat has the colour that comes of both") {
  const double below = ((1 / 1.5 - 1) * (1 / 1.5 - 1) + 4 / 2.25) / ((1 / 1.5 + 1) * (1 / 1.5 + 1) + 4 / 2.25);
  const double all = 0.04 + 0.96 * 0.96 * below / (1 - 0.04 * below);
  CHECK(is_near(material_of("Material \"coatedconductor\" \"rgb conductor.eta\" [1 1 1] \"rgb conductor.k\" [2 2 2]\n").color,
                Vec3d{1, 1, 1} * all));
  // A reflectance of a half is that of eta 1 and k 2.
  CHECK(is_near(material_of("Material \"coatedconductor\" \"rgb reflectance\" [0.5 0.5 0.5]\n").color, Vec3d{1, 1, 1} * all));
}

TEST_CASE("a spectrum of a file is its pairs, with remarks") {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "grey.spd", "# measured\n350 0.3\n900 0.3 # to here\n");
  tests::write_text(folder / "bad.spd", "350 0.3\n900 x\n");
  const auto read = [&](const std::string& name) {
    tests::write_text(folder / "a.pbrt",
                      tests::pbrt_camera + "Material \"diffuse\" \"spectrum reflectance\" \"" + name + "\"\n" + pbrt_triangle);
    return read_mesh_file(folder / "a.pbrt");
  };
  CHECK(is_near(tests::material_of_object(read("grey.spd"), 0).color, {0.3, 0.3, 0.3}));
  CHECK_THROWS_WITH_AS(read("bad.spd"), doctest::Contains("bad.spd has 'x' in its line 2"), core::InputError);
  CHECK_THROWS_WITH_AS(read("none.spd"), doctest::Contains("is none that pbrt-v4 names"), core::InputError);
}

// F + (1 - F) R (1 - f) / (1 - R f) straight ahead, F = 0.04 and f = 0.5963 being what a surface of index 1.5 sends back of what
// comes along its normal, and of diffuse light from within.
TEST_CASE("a coat over what is diffuse sends part of its light back in, so that it is darker than without") {
  const auto plastic_of = [](const std::string& more) {
    return material_of("Material \"coateddiffuse\" \"float roughness\" 0 " + more + "\n");
  };
  const Material plastic = plastic_of("\"rgb reflectance\" [0.2 0.5 0.8]");
  CHECK(plastic.microfacets.metallic == 0);
  CHECK(plastic.microfacets.roughness == 0);
  CHECK(plastic.microfacets.reflectance == doctest::Approx(0.04));
  CHECK(is_near(Vec3d{0.04, 0.04, 0.04} + plastic.color * 0.96, {0.1280, 0.3161, 0.6329}, 2e-4));
  CHECK(is_near(plastic_of("\"rgb reflectance\" [1 1 1]").color, {1, 1, 1}));
  CHECK(is_near(plastic_of("\"rgb reflectance\" [0.2 0.5 0.8] \"float eta\" 1").color, {0.2, 0.5, 0.8}));
}

TEST_CASE("so is a picture below a coat, texel by texel") {
  const tests::TemporaryFolder folder;
  Image grey(1, 1);
  grey.rgb = {0.5, 0.2, 0.8};
  write_image(folder / "grey.exr", grey);
  tests::write_text(folder / "a.pbrt",
                    tests::pbrt_camera +
                        "Texture \"w\" \"spectrum\" \"imagemap\" \"string filename\" \"grey.exr\"\n"
                        "Material \"coateddiffuse\" \"texture reflectance\" \"w\"\n"
                        "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"point2 uv\" [0 0 1 0 0 1]\n");
  const MeshFile file = read_mesh_file(folder / "a.pbrt");
  REQUIRE(file.scene.textures.size() == 1);
  const core::Texture& texture = file.scene.textures[0];
  const Vec3d shown(core::decoded(texture.format, texture.levels[0].texels[0]));
  CHECK(is_near(shown, {0.2876, 0.0917, 0.6176}, 2e-3));
  CHECK(is_near(file.scene.materials[file.scene.objects[0].material].color, {1, 1, 1}));
}

TEST_CASE("glass bends light by its index, and a pane lets it through straight") {
  const Material glass = material_of("Material \"dielectric\" \"float eta\" 2\n");
  CHECK(glass.microfacets.transmission == 1);
  CHECK(glass.microfacets.reflectance == doctest::Approx(1.0 / 9));
  CHECK(glass.refraction_index == 2);
  CHECK(material_of("Material \"dielectric\" \"spectrum eta\" \"glass-BK7\"\n").refraction_index == doctest::Approx(1.5168));
  const Material pane = material_of("Material \"thindielectric\" \"float eta\" 2\n");
  CHECK(pane.refraction_index == 1);
  CHECK(pane.microfacets.reflectance == doctest::Approx(2.0 / 9 / (1 + 1.0 / 9)));
}

TEST_CASE("named materials may come later, and mixtures are of their numbers") {
  const std::string mixed = "Material \"mix\" \"string materials\" [\"c\" \"d\"]\n", diffuse = " \"string type\" \"diffuse\" ";
  CHECK(is_near(material_of(mixed + "MakeNamedMaterial \"c\"" + diffuse + "\"rgb reflectance\" [1 0 0]\nMakeNamedMaterial \"d\"" +
                            diffuse + "\"rgb reflectance\" [0 1 0]\n")
                    .color,
                {0.5, 0.5, 0}));
  CHECK(material_of("NamedMaterial \"m\"\nMakeNamedMaterial \"m\" \"string type\" \"diffuse\" \"rgb reflectance\" [1 0 0]\n")
            .color == Vec3d{1, 0, 0});
  const std::string two =
      "MakeNamedMaterial \"a\" \"string type\" \"diffuse\" \"rgb reflectance\" [1 0 0]\n"
      "MakeNamedMaterial \"b\" \"string type\" \"diffuse\" \"rgb reflectance\" [0 0 1]\n";
  CHECK(is_near(material_of(two + "Material \"mix\" \"string materials\" [\"a\" \"b\"] \"float amount\" 0.25\n").color,
                {0.75, 0, 0.25}));
}

TEST_CASE("textures of constants are reckoned") {
  const std::string two =
      "Texture \"a\" \"spectrum\" \"constant\" \"rgb value\" [1 0.5 0]\n"
      "Texture \"s\" \"spectrum\" \"scale\" \"texture tex\" \"a\" \"float scale\" 0.5\n"
      "Texture \"m\" \"spectrum\" \"mix\" \"texture tex1\" \"a\" \"rgb tex2\" [0 0 1] \"float amount\" 0.5\n";
  CHECK(material_of(two + "Material \"diffuse\" \"texture reflectance\" \"s\"\n").color == Vec3d{0.5, 0.25, 0});
  CHECK(material_of(two + "Material \"diffuse\" \"texture reflectance\" \"m\"\n").color == Vec3d{0.5, 0.25, 0.5});
}

TEST_CASE("a checkerboard has its first colour where whole numbers of squares to the right and upwards add up to an even one") {
  for (const std::string where :
       {"\"float uscale\" 4", "\"float vscale\" 2 \"float vdelta\" 1", "\"float udelta\" 3 \"float vscale\" 3"}) {
    CAPTURE(where);
    const MeshFile checks =
        read_pbrt("Texture \"c\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [1 1 1] \"rgb tex2\" [0 0 0] " + where +
                  "\nMaterial \"diffuse\" \"texture reflectance\" \"c\"\n"
                  "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"point2 uv\" [0 0 1 0 0 1]\n");
    REQUIRE(checks.scene.textures.size() == 1);
    REQUIRE(checks.scene.corners.size() == 3);
    const auto value = [&](const char* name, double fallback) {
      const std::size_t at = where.find(name);
      return at == std::string::npos ? fallback : std::stod(where.substr(at + 7));
    };
    for (const auto& [u, v] : {std::pair{0.1, 0.1}, {0.1, 0.6}, {0.3, 0.1}, {0.3, 0.6}, {0.8, 0.1}}) {
      const auto wrapped = [&, u = u, v = v](std::size_t axis) {
        const auto corner = [&](std::size_t i) { return double{checks.scene.corners[i].place[axis]}; };
        const double place = corner(0) + (corner(1) - corner(0)) * u + (corner(2) - corner(0)) * v;
        return static_cast<std::size_t>((place - std::floor(place)) * 128);
      };
      const double squares =
          std::floor(u * value("uscale", 1) + value("udelta", 0)) + std::floor(v * value("vscale", 1) + value("vdelta", 0));
      const bool is_first = std::fmod(squares, 2) == 0;
      CHECK(checks.scene.textures[0].levels[0].texels[wrapped(1) * 128 + wrapped(0)] == (is_first ? 0xffffffU : 0U));
    }
  }
}

TEST_CASE("pictures lie by u and v, v upwards, scaled and moved") {
  const tests::TemporaryFolder folder;
  write_image(folder / "wood.png", Image(4, 2));
  tests::write_text(
      folder / "a.pbrt",
      tests::pbrt_camera +
          "Texture \"w\" \"spectrum\" \"imagemap\" \"string filename\" \"wood.png\" \"float vscale\" 2 \"float vdelta\" 0.25\n"
          "Material \"diffuse\" \"texture reflectance\" \"w\"\n"
          "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"point2 uv\" [0 0 1 0 0 1]\n");
  const MeshFile file = read_mesh_file(folder / "a.pbrt");
  REQUIRE(file.scene.corners.size() == 3);
  CHECK(file.scene.materials[file.scene.objects[0].material].color == Vec3d{1, 1, 1});
  CHECK(file.scene.corners[0].place[1] == doctest::Approx(0.75));   // v = 0 is 0.25 from below
  CHECK(file.scene.corners[2].place[1] == doctest::Approx(-1.25));  // v = 1 is 2.25
}

// Its corners lie at (0, 0), (1, 0) and (1, 1), v upwards; a triangle whose normals look back is turned with its places.
TEST_CASE("a triangle that does not say where lies on a picture as half a square, each by itself") {
  const std::string texture =
      "Texture \"c\" \"spectrum\" \"checkerboard\" \"float uscale\" 2 \"float vscale\" 2\n"
      "Material \"diffuse\" \"texture reflectance\" \"c\"\n";
  const std::string two = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 1 1 0 0 1 0] \"integer indices\" [0 1 2 2 3 0] ";
  const MeshFile file = read_pbrt(texture + two);
  REQUIRE(file.scene.corners.size() == 6);
  CHECK(file.scene.corners[0].place == std::array<float, 2>{0, 1});
  CHECK(file.scene.corners[1].place == std::array<float, 2>{1, 1});
  CHECK(file.scene.corners[5].place == std::array<float, 2>{1, 0});
  CHECK(!notes(file, "texture is not shown"));
  const MeshFile turned = read_pbrt(texture + two + "\"normal N\" [0 0 -1 0 0 -1 0 0 -1 0 0 -1]");
  REQUIRE(turned.scene.corners.size() == 6);
  CHECK(turned.scene.corners[0].place == std::array<float, 2>{1, 0});
  CHECK(turned.scene.corners[2].place == std::array<float, 2>{0, 1});
  CHECK(turned.scene.vertices[turned.scene.objects[0].first] == Vec3d{1, 1, 0});
  CHECK(read_pbrt(two).scene.corners.empty());
}

TEST_CASE("an area light shines as brightly as it says, to its front: behind stands its surface") {
  const MeshFile file = read_pbrt("AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [1 2 3] \"float scale\" 2\n" +
                                  pbrt_triangle + "AttributeEnd\n");
  REQUIRE(file.scene.objects.size() == 2);
  CHECK(tests::material_of_object(file, 0).emission == Vec3d{2, 4, 6});
  CHECK(tests::material_of_object(file, 1).emission == Vec3d{});
  CHECK(file.scene.vertices[3].z < 0);
  CHECK(file.scene.vertices[3].z > -0.01);
  CHECK(read_pbrt("AreaLightSource \"diffuse\" \"bool twosided\" true\n" + pbrt_triangle).scene.objects.size() == 1);
  // Half a square of side 1 with 10 W sends 10 / (pi / 2) a square and steradian.
  const MeshFile measured = read_pbrt("AreaLightSource \"diffuse\" \"float power\" 10\n" + pbrt_triangle);
  CHECK(is_near(tests::material_of_object(measured, 0).emission, Vec3d{1, 1, 1} * (20 / pi)));
  CHECK(notes(read_pbrt("ObjectBegin \"o\" AreaLightSource \"diffuse\"\n" + pbrt_triangle + "ObjectEnd ObjectInstance \"o\"\n"),
              "shine nowhere"));
}

// A cone with smoothstep's edge has 2 pi ((1 - cos 25) + (cos 25 - cos 30) / 2) times the intensity ahead.
TEST_CASE("a spot shines in its cone, and with what power it is said to have") {
  const MeshOptions by_paths{.is_below_sky = true, .is_below_own_sky = true};
  const MeshFile spot =
      read_pbrt("LightSource \"spot\" \"rgb I\" [3 3 3] \"point3 from\" [0 5 0] \"point3 to\" [0 0 0] \"float coneangle\" 20\n" +
                    pbrt_triangle,
                by_paths);
  REQUIRE(spot.scene.lights.size() == 1);
  const core::PointLight& light = spot.scene.lights[0];
  CHECK(is_near(light.cone.ahead, {0, -1, 0}));
  CHECK(light.cone.full_degrees == 15);
  CHECK(light.cone.none_degrees == 20);
  CHECK(light.cone.edge == core::ConeEdge::smooth);
  CHECK(is_near(light.color * pi, {3, 3, 3}));
  const MeshFile strong = read_pbrt("LightSource \"spot\" \"float power\" 10\n" + pbrt_triangle, by_paths);
  const double full = std::cos(25 * pi / 180), none = std::cos(30 * pi / 180);
  CHECK(is_near(strong.scene.lights[0].color * pi, Vec3d{1, 1, 1} * (10 / (2 * pi * ((1 - full) + (full - none) / 2)))));
}

// Over as many directions as a square of 90 degrees: a sixth of all, 1 - cos = 1/3.
TEST_CASE("a projection shines in a cone of as many directions as its picture") {
  const MeshOptions by_paths{.is_below_sky = true, .is_below_own_sky = true};
  const std::string light = "Rotate 90 1 0 0 LightSource \"projection\" \"string filename\" \"a.png\" ";
  const MeshFile file = read_pbrt(pbrt_triangle + light + "\"float power\" 10\n", by_paths);
  const core::LightCone& cone = file.scene.lights.at(0).cone;
  CHECK(is_near(cone.ahead, {0, -1, 0}));
  CHECK(cone.none_degrees == doctest::Approx(std::acos(2.0 / 3) * 180 / pi));
  CHECK(cone.full_degrees == cone.none_degrees);
  CHECK(is_near(file.scene.lights[0].color * pi, Vec3d{1, 1, 1} * (10 / (4 * pi / 6))));
  CHECK(notes(file, "lights of kind 'projection', which shine in a cone here, without their picture: 1"));
}

// As in pbrt-v4, which makes pictures first, other textures of numbers and of colours in their order, and materials at last.
TEST_CASE("materials name textures of any line, textures pictures of any line, and others those before them") {
  const std::string grey = "Texture \"g\" \"spectrum\" \"constant\" \"rgb value\" [0.2 0.4 0.6]\n",
                    twice = "Texture \"t\" \"spectrum\" \"scale\" \"texture tex\" \"g\" \"texture scale\" \"n\"\n",
                    number = "Texture \"n\" \"float\" \"constant\" \"float value\" 0.5\n",
                    named = "\"texture reflectance\" \"t\"\n";
  CHECK(is_near(material_of("Material \"diffuse\" " + named + grey + twice + number).color, {0.1, 0.2, 0.3}));
  CHECK(is_near(material_of("MakeNamedMaterial \"m\" \"string type\" \"diffuse\" " + named + "NamedMaterial \"m\"\n" + grey +
                            twice + number)
                    .color,
                {0.1, 0.2, 0.3}));
}

TEST_CASE("a picture of a later line lies on triangles that say no places as one of an earlier line does") {
  const tests::TemporaryFolder folder;
  write_image(folder / "grey.exr", Image(1, 1));
  const std::string picture = "Texture \"w\" \"spectrum\" \"imagemap\" \"string filename\" \"grey.exr\"\n",
                    twice = "Texture \"t\" \"spectrum\" \"scale\" \"texture tex\" \"w\" \"float scale\" 0.5\n",
                    material = "Material \"diffuse\" \"texture reflectance\" \"t\"\n";
  for (const std::string& text : {picture + twice + material + pbrt_triangle, twice + material + pbrt_triangle + picture}) {
    tests::write_text(folder / "a.pbrt", tests::pbrt_camera + text);
    const MeshFile file = read_mesh_file(folder / "a.pbrt");
    REQUIRE(file.scene.objects.size() == 1);
    CHECK(file.scene.objects[0].kind == core::ObjectKind::textured);
    CHECK(tests::material_of_object(file, 0).texture != Material::no_texture);
  }
}

TEST_CASE("an area light of alpha 0 is not seen and lights all the same, as points") {
  const MeshOptions by_paths{.is_below_sky = true, .is_below_own_sky = true};
  const std::string lamp = pbrt_triangle + "AreaLightSource \"diffuse\" \"rgb L\" [40 40 40]\n";
  const MeshFile ball = read_pbrt(lamp + "Translate 0 3 4 Shape \"sphere\" \"float radius\" 0.5 \"float alpha\" 0\n", by_paths);
  CHECK(ball.scene.objects.size() == 1);
  REQUIRE(ball.scene.lights.size() == 1);
  CHECK(ball.scene.lights[0].position == Vec3d{0, 3, 4});
  CHECK(ball.scene.lights[0].cone.none_degrees == 0);
  CHECK(is_near(ball.scene.lights[0].color * pi, Vec3d{1, 1, 1} * (40 * pi * 0.25)));  // pi L r^2
  const MeshFile half = read_pbrt(
      lamp + "Shape \"trianglemesh\" \"float alpha\" 0 \"point3 P\" [0 0 3 3 0 3 0 3 3] \"integer indices\" [0 1 2]\n", by_paths);
  CHECK(half.scene.objects.size() == 1);
  REQUIRE(half.scene.lights.size() == 1);
  CHECK(is_near(half.scene.lights[0].position, {1, 1, 3}));
  CHECK(is_near(half.scene.lights[0].cone.ahead, {0, 0, 1}));
  CHECK(half.scene.lights[0].cone.none_degrees == 90);
  CHECK(is_near(half.scene.lights[0].color * pi, Vec3d{1, 1, 1} * (40 * 4.5)));
  CHECK(notes(half, "area lights that alpha takes away, which light as points: 1"));
}

TEST_CASE("an area light of the material interface shines nowhere, named before or after") {
  const std::string light = "AreaLightSource \"diffuse\" \"bool twosided\" true\n", sphere = "Shape \"sphere\"\n";
  for (const std::string interface :
       {"Material \"interface\"\n", "Material \"\"\n", "Material \"none\"\n", "NamedMaterial \"air\"\n"}) {
    const MeshFile file =
        read_pbrt(sphere + interface + light + pbrt_triangle + "MakeNamedMaterial \"air\" \"string type\" \"interface\"\n");
    CHECK(file.scene.objects.size() == 1);
    CHECK(!tests::material_of_object(file, 0).shines());
    CHECK(notes(file, "area lights of the material \"interface\", which shine nowhere, as in pbrt: 1"));
  }
}

TEST_CASE("lights that are no surface light as physics has it, below the file's own sky") {
  const MeshOptions by_paths{.is_below_sky = true, .is_below_own_sky = true};
  const MeshFile point = read_pbrt("LightSource \"point\" \"rgb I\" [1 2 3] \"point3 from\" [0 5 0]\n" + pbrt_triangle, by_paths);
  REQUIRE(point.scene.lights.size() == 1);
  CHECK(point.scene.spheres.empty());
  CHECK(point.scene.lights[0].position == Vec3d{0, 5, 0});
  CHECK(point.scene.lights[0].falls_off_from > 0);
  CHECK(is_near(point.scene.lights[0].color * pi, {1, 2, 3}));
  const MeshFile sun = read_pbrt(
      "LightSource \"distant\" \"rgb L\" [3 3 3] \"point3 from\" [0 1 0] \"point3 to\" [0 0 0]\n" + pbrt_triangle, by_paths);
  REQUIRE(sun.scene.lights.size() == 1);
  CHECK(is_near(sun.scene.lights[0].color, Vec3d{1, 1, 1} * (3 / pi)));  // ours shine with an irradiance of pi times that
  CHECK(sun.scene.lights[0].position.y > 100);
  const MeshFile sky = read_pbrt(
      "LightSource \"infinite\" \"rgb L\" [1 2 3] \"float scale\" 2\nLightSource \"infinite\" \"float illuminance\" 3\n" +
          pbrt_triangle,
      by_paths);
  CHECK(is_near(sky.scene.background, Vec3d{2, 4, 6} + Vec3d{1, 1, 1} * (3 / pi)));
}

TEST_CASE("light that is no rgb has the luminance 1, and the colour of its temperature") {
  const auto glow = [](const std::string& temperature) {
    return tests::material_of_object(
               read_pbrt("AreaLightSource \"diffuse\" \"blackbody L\" " + temperature + "\n" + pbrt_triangle), 0)
        .emission;
  };
  for (const char* const kelvin : {"2000", "6504", "10000"}) {
    const Vec3d light = glow(kelvin);
    CHECK(0.2126 * light.x + 0.7152 * light.y + 0.0722 * light.z == doctest::Approx(1));
  }
  CHECK(is_near(glow("6504"), {1, 1, 1}, 0.1));  // near daylight
  CHECK(glow("2000").x > 3 * glow("2000").z);
  CHECK(glow("10000").z > glow("10000").x);
  // What a black body of CIE's temperature for A is, which is defined as one.
  CHECK(is_near(glow("2855.5"), {1.845, 0.826, 0.2334}, 3e-3));
}

TEST_CASE("illuminants that scenes name have the luminance 1 and their colour") {
  const auto lamp = [](const std::string& name) {
    return tests::material_of_object(read_pbrt("AreaLightSource \"diffuse\" \"spectrum L\" \"" + name + "\"\n" + pbrt_triangle),
                                     0)
        .emission;
  };
  CHECK(is_near(lamp("stdillum-A"), {1.845, 0.826, 0.2334}, 1e-3));
  CHECK(is_near(lamp("stdillum-D65"), {1, 1, 1}, 1e-3));
  CHECK(is_near(lamp("stdillum-F2"), {1.340, 0.943, 0.563}, 1e-3));
  CHECK(is_near(lamp("stdillum-F11"), {1.412, 0.925, 0.532}, 1e-3));
  CHECK(is_near(lamp("illum-acesD60"), {1.047, 0.995, 0.915}, 1e-3));
}

TEST_CASE("light is exposed for as long as the shutter is open, by ISO over 100, whichever the sensor") {
  const auto shown = [](const std::string& film, const std::string& camera) {
    return tests::material_of_object(
               tests::read_mesh("a.pbrt", "Film \"rgb\" " + film + "\nCamera \"perspective\" " + camera +
                                              "\nWorldBegin AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\n" + pbrt_triangle),
               0)
        .emission;
  };
  CHECK(shown("", "") == Vec3d{1, 1, 1});
  CHECK(shown("\"float iso\" 200", "") == Vec3d{2, 2, 2});
  CHECK(shown("", "\"float shutterclose\" 0.5") == Vec3d{0.5, 0.5, 0.5});
  CHECK(shown("\"float iso\" 400", "\"float shutteropen\" 0.25 \"float shutterclose\" 0.75") == Vec3d{2, 2, 2});
  CHECK(
      tests::contains(tests::mesh_refusal("a.pbrt", "Camera \"perspective\" \"float shutteropen\" 1 WorldBegin " + pbrt_triangle),
                      "its shutter is open for 0 s"));
}

// Bradford's, from CIE's daylight to sRGB's white; reckoned beforehand.
TEST_CASE("white balance makes white of what a light of its temperature shows") {
  const auto shown = [](const std::string& kelvin, const std::string& light) {
    return tests::material_of_object(
               tests::read_mesh("a.pbrt", "Film \"rgb\" \"float whitebalance\" " + kelvin +
                                              " WorldBegin AreaLightSource \"diffuse\" " + light + "\n" + pbrt_triangle),
               0)
        .emission;
  };
  CHECK(is_near(shown("9000", "\"rgb L\" [1 1 1]"), {1.1454, 0.9876, 0.7548}, 1e-3));
  CHECK(is_near(shown("6504", "\"rgb L\" [1 1 1]"), {1, 1, 1}, 5e-3));
  CHECK(is_near(shown("3000", "\"blackbody L\" 3000"), {1, 1, 1}, 5e-3));  // redder than daylight is: of a black body
  CHECK(tests::contains(tests::mesh_refusal("a.pbrt", "Film \"rgb\" \"float whitebalance\" -1 WorldBegin " + pbrt_triangle),
                        "expected a temperature"));
}

TEST_CASE("a sky alone is a scene, and nothing at all is none") {
  const MeshFile file = read_pbrt("LightSource \"infinite\" \"rgb L\" [0.25 0.5 1]\n");
  CHECK(file.scene.objects.empty());
  CHECK(file.scene.background == Vec3d{0.25, 0.5, 1});
}

TEST_CASE("a sky's directions lie in its square as in equal areas") {
  const auto near = [](const std::array<double, 2>& place, double s, double t) {
    return std::abs(place[0] - s) < 1e-12 && std::abs(place[1] - t) < 1e-12;
  };
  CHECK(near(equal_area_place({0, 0, 1}), 0.5, 0.5));  // up is the middle
  CHECK(near(equal_area_place({1, 0, 0}), 1, 0.5));    // the horizon is a diamond within
  CHECK(near(equal_area_place({0, 1, 0}), 0.5, 1));
  CHECK(near(equal_area_place({-1, 0, 0}), 0, 0.5));
  CHECK(near(equal_area_place({0.6, 0, 0.8}), 0.5 + std::sqrt(0.2) / 2, 0.5));
  // Below, folded outwards: a corner is the pole.
  CHECK(near(equal_area_place({1e-30, 1e-30, -1}), 1, 1));
}

TEST_CASE("a picture of the sky turns with its light and shows where it is bright") {
  MeshSky sky{.name = "sky", .image = Image(64, 64), .rows = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, .scale = {2, 2, 2}};
  for (int y = 16; y < 48; ++y) {  // about z, up to half the way to the horizon along x and y
    for (int x = 16; x < 48; ++x) {
      sky.image.rgb[static_cast<std::size_t>((y * 64 + x) * 3)] = 1;
    }
  }
  core::Scene scene;
  scene.view.up = {0, 0, 1};
  scene.background = {0, 0, 1};
  set_sky({sky}, scene);
  REQUIRE(scene.sky.is_there());
  CHECK(scene.sky.width == 128);
  CHECK(scene.sky.height == 64);
  CHECK(scene.background == Vec3d{});
  CHECK(scene.sky.brightest == doctest::Approx(2).epsilon(0.01));
  // The zenith is bright and the nadir is not.
  CHECK((scene.sky.texels.front() & 511U) > 0);
  CHECK((scene.sky.texels.back() & 511U) == 0);
}

}  // namespace dmpc::apps::pbrt_looks_test
