// glTF's textures of metal and roughness: where they lie, and what they say.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "apps/formats/mesh_file.h"
#include "apps/picture/image_file.h"
#include "core/base/expect.h"
#include "core/base/srgb.h"
#include "tests/support/mesh_files.h"
#include "tests/support/packed_gltf.h"
#include "tests/support/read_mesh.h"

namespace dmpc::tests::gltf_facet_texture_test {

namespace {

using core::FacetTexture;
using doctest::Approx;

/// Two pixels, of which roughness is 51 and 102, metal 255 and 0, in 255ths.
void write_facets(const std::filesystem::path& path) {
  apps::Image image(2, 1);
  const std::array<int, 6> bytes{9, 51, 255, 9, 102, 0};
  std::transform(bytes.begin(), bytes.end(), image.rgb.begin(),
                 [](int byte) { return static_cast<float>(core::linear_from_srgb(byte / 255.0)); });
  apps::write_image(path, image);
}

/// A triangle with two sets of coordinates, of a material of these members; there are the pictures a.png and b.png, and none
/// else.
apps::MeshFile read(const std::string& material, const apps::MeshOptions& options = {.is_by_paths = true}) {
  const TemporaryFolder folder;
  apps::write_image(folder / "a.png", apps::Image(4, 4));
  write_facets(folder / "b.png");
  GltfDocument document;
  const std::string positions = document.add(triangle_corners, 3);
  const std::string places = document.add(std::array<float, 6>{0, 0, 1, 0, 0, 0.5F}, 2);
  write_text(folder / "a.gltf", document.text(R"({"material":0,"attributes":{"POSITION":)" + positions + R"(,"TEXCOORD_0":)" +
                                                  places + R"(,"TEXCOORD_1":)" + places + "}}",
                                              R"("materials":[{)" + material +
                                                  R"(}],"textures":[{"source":0},{"source":1,"sampler":0},{"source":2},{}],)"
                                                  R"("samplers":[{"wrapS":33071}],)"
                                                  R"("images":[{"uri":"a.png"},{"uri":"b.png"},{"uri":"nowhere.png"}])"));
  return apps::read_mesh_file(folder / "a.gltf", options);
}

std::string metal(const std::string& color, const std::string& facets, const std::string& factors = "") {
  return R"("pbrMetallicRoughness":{)" + factors + (color.empty() ? "" : R"("baseColorTexture":{)" + color + "},") +
         R"("metallicRoughnessTexture":{)" + facets + "}}";
}

std::string transformed(double offset) {
  return R"(,"extensions":{"KHR_texture_transform":{"offset":[)" + std::to_string(offset) + ",0]}}";
}

bool says_mean(const apps::MeshFile& file) {
  return notes(file, "roughness is shown by its mean, as it does not lie where that of their colour does: 1");
}

}  // namespace

TEST_CASE("metal and roughness are what their texture says, beside that of the colour, times their factors") {
  const apps::MeshFile file = read(metal(R"("index":0)", R"("index":1)", R"("metallicFactor":0.5,"roughnessFactor":0.75,)"));
  const core::Material& material = file.scene.materials.at(0);
  CHECK(material.texture == 0);
  CHECK(material.microfacets.roughness == Approx(0.75));
  CHECK(material.microfacets.metallic == Approx(0.5));
  CHECK(material.microfacets.use == FacetTexture::placed);
  REQUIRE(material.microfacets.texture == 1);
  const core::Texture& texture = file.scene.textures.at(1);
  CHECK(texture.format == core::TexelFormat::linear);
  CHECK((texture.levels.at(0).texels == std::vector<std::uint32_t>{9 | 51 << 8 | 255 << 16, 9 | 102 << 8}));
  CHECK(texture.wrap_s == core::TextureWrap::clamp);
  CHECK(texture.wrap_t == core::TextureWrap::repeat);
  CHECK_FALSE(says_mean(file));
  CHECK_FALSE(notes(file, "not used"));
}

TEST_CASE("where it lies elsewhere than the colour's, or that has none, its mean multiplies the factors, and that is said") {
  for (const std::string& material : {metal("", R"("index":1)", R"("roughnessFactor":0.5,)"),
                                      metal(R"("index":0)", R"("index":1,"texCoord":1)", R"("roughnessFactor":0.5,)"),
                                      metal(R"("index":0)", R"("index":1)" + transformed(0.5), R"("roughnessFactor":0.5,)")}) {
    CAPTURE(material);
    const apps::MeshFile file = read(material);
    const core::Microfacets& facets = file.scene.materials.at(0).microfacets;
    CHECK(facets.roughness == Approx(0.5 * 0.3));
    CHECK(facets.metallic == Approx(0.5));
    CHECK_FALSE(facets.have_texture());
    CHECK(file.scene.textures.size() == (contains(material, "baseColor") ? 1 : 0));
    CHECK(says_mean(file));
  }
  CHECK_FALSE(says_mean(read(metal(R"("index":0)" + transformed(0.5), R"("index":1)" + transformed(0.5)))));
}

TEST_CASE("one picture may be a colour and say what is metal: it is two textures") {
  const apps::MeshFile file = read(metal(R"("index":1)", R"("index":1)"));
  CHECK(file.scene.textures.at(0).format == core::TexelFormat::srgb);
  CHECK(file.scene.textures.at(1).format == core::TexelFormat::linear);
  CHECK(file.scene.materials.at(0).microfacets.texture == 1);
}

TEST_CASE("a picture of metal and roughness that is missing is an error, or by --missing=plain as if there were none") {
  CHECK_THROWS_WITH_AS(read(metal(R"("index":0)", R"("index":2)")), doctest::Contains("nowhere.png"), core::InputError);
  const apps::MeshFile plain = read(metal(R"("index":0)", R"("index":2)"), {.allows_missing = true, .is_by_paths = true});
  CHECK_FALSE(plain.scene.materials.at(0).microfacets.have_texture());
  CHECK(plain.scene.materials.at(0).microfacets.metallic == 1);
  const apps::MeshFile none = read(metal(R"("index":0)", R"("index":3)"));
  CHECK(notes(none, "textures that name no picture, left out: 1"));
  CHECK(none.scene.materials.at(0).microfacets.metallic == 1);
}

TEST_CASE("where nothing is by paths nobody reads a picture of metal and roughness, so it may be missing") {
  const apps::MeshFile file = read(metal(R"("index":0)", R"("index":2)"), {});
  CHECK_FALSE(file.scene.materials.at(0).microfacets.have_texture());
  CHECK(file.scene.textures.size() == 1);
  CHECK_FALSE(says_mean(read(metal("", R"("index":1)"), {})));
}

TEST_CASE("a material of specular and glossiness has no metal, whatever texture of it stands beside") {
  const apps::MeshFile file =
      read(metal("", R"("index":1)") + R"(,"extensions":{"KHR_materials_pbrSpecularGlossiness":{"glossinessFactor":0.25}})");
  const core::Microfacets& facets = file.scene.materials.at(0).microfacets;
  CHECK(facets.metallic == 0);
  CHECK(facets.roughness == Approx(0.75));
  CHECK_FALSE(facets.have_texture());
  CHECK(notes(file, "textures not used, since they are not of a surface's colour: 1"));
}

}  // namespace dmpc::tests::gltf_facet_texture_test
