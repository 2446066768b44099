#include "apps/foreign/mesh/surface.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "apps/foreign/mesh/surface.h"
#include "apps/formats/mesh_file.h"
#include "tests/support/mesh_files.h"
#include "tests/support/read_mesh.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::apps::material_test {

using core::Material;
using core::Vec3d;
using doctest::Approx;

namespace {

/// What a triangle of this paint gets; `lines` follow `newmtl` in its MTL.
Material from_mtl(const std::string& lines) {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "a.mtl", "newmtl paint\n" + lines);
  tests::write_text(folder / "a.obj", "mtllib a.mtl\nusemtl paint\n" + tests::triangle_obj);
  return read_mesh_file(folder / "a.obj").scene.materials.at(0);
}

Material from_gltf(const std::string& material) {
  const tests::Gltf gltf{.materials = "[" + material + "]",
                         .more = R"("extensionsUsed":["KHR_materials_transmission","KHR_materials_ior"])"};
  return tests::read_mesh("a.gltf", gltf.text()).scene.materials.at(0);
}

bool near(const Vec3d& a, const Vec3d& b) { return length(a - b) < 1e-6; }

/// In the channel that sends on most, of what arrives.
double most_light(const Material& material) {
  const Vec3d mirrored = material.specular_color * material.specular + material.color * material.tinted_specular;
  return largest_component(material.color * material.diffuse + mirrored * material.mirror) + material.transmittance;
}

Material from_phong(const PhongSurface& surface) { return material_of(surface); }

}  // namespace

TEST_CASE("a diffuse paint keeps its colour, taken as linear") {
  const Material paint = from_mtl("Kd 0.5 0.25 0.125\n");
  CHECK(near(paint.color, {0.5, 0.25, 0.125}));
  CHECK(paint.diffuse == 1);
  CHECK(paint.specular == 0);
  CHECK(paint.transmittance == 0);
}

TEST_CASE("a highlight is all of Ks, and mirrors nothing but where illum says so") {
  const std::string paint = "Kd 0.5 0.5 0.5\nKs 0.25 0.25 0.25\nNs 50\n";
  CHECK(from_mtl(paint + "illum 1\n").specular == 0);
  CHECK(from_mtl(paint + "illum 2\n").specular == Approx(0.25));
  CHECK(from_mtl(paint + "illum 2\n").mirror == 0);
  CHECK(from_mtl(paint + "illum 2\n").diffuse == 1);
  CHECK(from_mtl(paint + "illum 3\n").specular == Approx(0.25));
  CHECK(from_mtl(paint + "illum 3\n").mirror == 1);
  CHECK(from_mtl(paint + "illum 3\n").shine == 50);
  CHECK(from_mtl("Ks 0.5 0.5 0.5\nillum 2\n").specular == 0);
}

TEST_CASE("a paint with Ks and Ns that says no illum has a highlight") {
  const Material paint = from_phong({.diffuse = {0.5, 0.5, 0.5}, .specular = {0.5, 0.5, 0.5}, .shine = 20});
  CHECK(paint.specular == 0.5);
  CHECK(paint.mirror == 0);
  CHECK(paint.shine == 20);
  CHECK(from_phong({.specular = {0.5, 0.5, 0.5}, .shine = 20, .illumination = 0}).specular == 0);
  CHECK(from_phong({.specular = {0.5, 0.5, 0.5}}).specular == 0);
}

TEST_CASE("highlight and mirror have the colour of Ks, and what is grey has none") {
  const Material gold = from_phong({.specular = {0.8, 0.6, 0.2}, .shine = 20, .illumination = 3});
  CHECK(gold.specular == Approx(0.8));
  CHECK(near(gold.specular_color, {1, 0.75, 0.25}));
  CHECK(!from_phong({.specular = {0.3, 0.3, 0.3}, .shine = 20, .illumination = 3}).has_extension());
}

TEST_CASE("Ke is light of the surface's own") {
  const Material lamp = from_phong({.emission = {0, 3, 0.5}, .opacity = 0.5});
  CHECK(lamp.emission == Vec3d{0, 1.5, 0.25});
  CHECK(near(from_mtl("Kd 0 0 0\nKe 0.25 0.5 1\n").emission, {0.25, 0.5, 1}));
}

TEST_CASE("opacity becomes transmittance, with the index of refraction") {
  const Material paint = from_mtl("Kd 0.5 0.5 0.5\nd 0.75\nNi 1.25\n");
  CHECK(paint.transmittance == Approx(0.25));
  CHECK(paint.diffuse == Approx(0.75));
  CHECK(paint.refraction_index == 1.25);
  CHECK(from_mtl("Tr 0.25\n").transmittance == Approx(0.25));
  CHECK(from_mtl("Tr 0.25\n").refraction_index == 1);
}

TEST_CASE("a paint that would reflect more than arrives is scaled down") {
  const Material paint = from_mtl("Kd 1 0.5 0\nKs 1 1 1\nillum 3\nd 0.5\n");
  CHECK(most_light(paint) == Approx(1));
  CHECK(paint.diffuse == Approx(0.25));
  CHECK(paint.specular == Approx(0.25));
  CHECK(paint.transmittance == Approx(0.5));
}

TEST_CASE("numbers out of range are brought into it") {
  const Material paint = from_mtl("Kd 7 -1 0.5\nKs 9 9 9\nNs 1e9\nd -3\nNi -1\nillum 3\n");
  CHECK(paint.color == Vec3d{1, 0, 0.5});
  CHECK(paint.transmittance == 1);
  CHECK(paint.shine == 10'000);
  CHECK(paint.refraction_index == 1);
}

TEST_CASE("glTF: what is rough and no metal is diffuse") {
  const Material paint =
      from_gltf(R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,0,1],"metallicFactor":0,"roughnessFactor":1}})");
  CHECK(near(paint.color, {0.5, 0.25, 0}));
  CHECK(paint.diffuse == 1);
  CHECK(paint.specular == 0);
}

TEST_CASE("glTF: smooth things reflect, metals in their colour, others as glass does") {
  const auto smooth = [](const std::string& metallic) {
    return from_gltf(R"({"pbrMetallicRoughness":{"baseColorFactor":[0.9,0.6,0.3,1],"roughnessFactor":0,"metallicFactor":)" +
                     metallic + "}}");
  };
  CHECK(smooth("1").specular == 0);
  CHECK(smooth("1").tinted_specular == 1);
  CHECK(smooth("1").diffuse == 0);
  CHECK(smooth("0").specular == Approx(0.04));
  CHECK(!smooth("0").has_extension());
  CHECK(smooth("0.5").specular == Approx(0.02));
  CHECK(smooth("0.5").tinted_specular == Approx(0.5));
}

TEST_CASE("glTF: for pictures by paths a surface of tiny mirrors is as the file says; Phong's has none") {
  const Material paint =
      from_gltf(R"({"pbrMetallicRoughness":{"baseColorFactor":[0.9,0.6,0.3,1],"roughnessFactor":0.25,"metallicFactor":0.75},)"
                R"("extensions":{"KHR_materials_transmission":{"transmissionFactor":0.5},"KHR_materials_ior":{"ior":2}}})");
  CHECK(paint.microfacets.roughness == Approx(0.25));
  CHECK(paint.microfacets.metallic == Approx(0.75));
  CHECK(paint.microfacets.transmission == Approx(0.5));
  CHECK(paint.microfacets.reflectance == Approx(1.0 / 9));
  CHECK(paint.microfacets.opacity == 1);
  const core::Microfacets plain = from_gltf("{}").microfacets;  // white, of metal and rough
  CHECK(plain == core::Microfacets{.roughness = 1, .metallic = 1, .reflectance = plain.reflectance});
  CHECK(plain.reflectance == Approx(0.04));
  CHECK(!from_mtl("Kd 0.5 0.25 0.125\nKs 1 1 1\nillum 3\n").microfacets.are_there());
  CHECK(from_mtl("Kd 0.5 0.25 0.125\nPr 0.5\nPm 1\n").microfacets.metallic == 1);
}

TEST_CASE("glTF: what is blended is there as far as its alpha says, what is a mask or opaque is there altogether") {
  const auto opacity = [](const std::string& mode) {
    return from_gltf(R"({"alphaMode":")" + mode + R"(","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.75]}})")
        .microfacets.opacity;
  };
  CHECK(opacity("BLEND") == Approx(0.75));
  CHECK(opacity("MASK") == 1);
  CHECK(opacity("OPAQUE") == 1);
}

TEST_CASE("MTL: Pr or Pm makes tiny mirrors, rough and no metal unless said, whose index is Ni") {
  const core::Microfacets metal = from_mtl("Kd 0.5 0.5 0.5\nPm 0.75\n").microfacets;
  CHECK(metal.metallic == Approx(0.75));
  CHECK(metal.roughness == 1);
  const core::Microfacets smooth = from_mtl("Kd 0.5 0.5 0.5\nPr 0.25\nNi 2\nd 0.5\n").microfacets;
  CHECK(smooth.metallic == 0);
  CHECK(smooth.roughness == Approx(0.25));
  CHECK(smooth.reflectance == Approx(1.0 / 9));
  CHECK(smooth.opacity == Approx(0.5));
  const core::Microfacets beyond = from_mtl("Kd 0.5 0.5 0.5\nPr 7\nPm -1\n").microfacets;
  CHECK(beyond.roughness == 1);
  CHECK(beyond.metallic == 0);
}

TEST_CASE("formats that say nothing of metal and roughness have no tiny mirrors") {
  for (const auto& [name, text] : {std::pair{"a.ply", tests::triangle_ply}, {"a.obj", tests::triangle_obj}}) {
    CAPTURE(name);
    for (const Material& material : tests::read_mesh(name, text).scene.materials) {
      CHECK(material.microfacets == core::Microfacets{});
    }
  }
}

TEST_CASE("glTF: a factor, and its strength, is light of the surface's own, unless a texture has its say") {
  const std::string factor = R"({"emissiveFactor":[0.5,0.25,1])";
  CHECK(near(from_gltf(factor + "}").emission, {0.5, 0.25, 1}));
  CHECK(near(from_gltf(factor + R"(,"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":8}}})").emission,
             {4, 2, 8}));
}

TEST_CASE("glTF: a mask with a constant alpha leaves all or nothing") {
  const auto masked = [](const std::string& alpha, const std::string& more) {
    const tests::Gltf gltf{.materials = R"([{"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,)" + alpha +
                                        R"(]},"alphaMode":"MASK")" + more + "}]"};
    return tests::read_mesh("a.gltf", gltf.text());
  };
  CHECK(masked("0.3", "").scene.objects.empty());
  CHECK(masked("0.5", "").scene.objects.size() == 1);
  CHECK(!masked("0.5", "").scene.materials.at(0).lets_through());
  CHECK(masked("0.3", R"(,"alphaCutoff":0.25)").scene.objects.size() == 1);
  CHECK(masked("0.3", R"(,"alphaCutoff":0.75)").scene.objects.empty());
  CHECK(masked("1", R"(,"alphaCutoff":1.5)").scene.objects.empty());
}

TEST_CASE("glTF: transmission refracts by its index, alpha goes straight through where it is blended") {
  const std::string surface = R"("pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.25],"metallicFactor":0,"roughnessFactor":1})";
  const Material glass =
      from_gltf("{" + surface +
                R"(,"extensions":{"KHR_materials_transmission":{"transmissionFactor":0.5},"KHR_materials_ior":{"ior":1.25}}})");
  CHECK(glass.transmittance == Approx(0.5));
  CHECK(glass.refraction_index == Approx(1.25));
  const Material veil = from_gltf("{" + surface + R"(,"alphaMode":"BLEND"})");
  CHECK(veil.transmittance == Approx(0.75));
  CHECK(veil.diffuse == Approx(0.25));
  CHECK(veil.refraction_index == 1);
  CHECK(from_gltf("{" + surface + "}").transmittance == 0);
  CHECK(from_gltf("{" + surface + R"(,"alphaMode":"MASK","alphaCutoff":0.25})").transmittance == 0);
}

TEST_CASE("glTF: no material reflects more than arrives") {
  for (const char* roughness : {"0", "0.5", "1"}) {
    for (const char* metallic : {"0", "0.5", "1"}) {
      for (const char* transmission : {"0", "0.7", "1"}) {
        const Material material =
            from_gltf(std::string(R"({"pbrMetallicRoughness":{"roughnessFactor":)") + roughness + R"(,"metallicFactor":)" +
                      metallic + R"(},"extensions":{"KHR_materials_transmission":{"transmissionFactor":)" + transmission + "}}}");
        CHECK(most_light(material) <= 1 + 1e-6);
      }
    }
  }
}

TEST_CASE("the rougher, the wider the highlight") {
  CHECK(shine_of_roughness(0) == 10'000);
  CHECK(shine_of_roughness(1e-9) == 10'000);
  CHECK(shine_of_roughness(0.5) == Approx(7.5));
  CHECK(shine_of_roughness(1) == 1);
}

}  // namespace dmpc::apps::material_test
