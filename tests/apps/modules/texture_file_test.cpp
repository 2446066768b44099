#include "apps/picture/picture_reader.h"

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "apps/formats/mesh_file.h"
#include "core/base/expect.h"
#include "core/scene/texel.h"
#include "tests/support/mesh_files.h"
#include "tests/support/packed_gltf.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests::texture_file_test {

namespace {

using core::TexelFormat;
using core::Texture;

Texture read_texture(const std::filesystem::path& path, const apps::TextureEdges& edges) {
  return apps::PictureReader().read_texture(apps::open_picture(path), edges);
}

Texture read_texture(std::span<const std::byte> file, const std::string& name, const std::string& format) {
  return apps::PictureReader().read_texture(apps::picture_of(file, name, format), {});
}

/// Writes a picture of any type and number of channels.
template <class T>
std::string write(const std::filesystem::path& path, int width, int height, int channels, OIIO::TypeDesc type,
                  const std::vector<T>& values, const std::string& color_space = "") {
  const auto output = OIIO::ImageOutput::create(path.string());
  REQUIRE(output);
  OIIO::ImageSpec spec(width, height, channels, type);
  if (!color_space.empty()) {
    spec.attribute("oiio:ColorSpace", color_space);
  }
  REQUIRE(output->open(path.string(), spec));
  REQUIRE(output->write_image(type, values.data()));
  REQUIRE(output->close());
  return path.string();
}

core::Color color_at(const Texture& texture, std::size_t texel) {
  return core::decoded(texture.format, texture.levels.front().texels.at(texel));
}

}  // namespace

TEST_CASE("an 8-bit picture keeps its bytes, from the top left") {
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> bytes{1, 2, 3, 10, 20, 30, 255, 0, 128, 7, 7, 7};
  const Texture texture = read_texture(write(folder / "a.png", 2, 2, 3, OIIO::TypeDesc::UINT8, bytes), {});
  CHECK(texture.format == TexelFormat::srgb);
  REQUIRE(texture.levels.size() == 2);
  CHECK(texture.levels[0].texels == std::vector<std::uint32_t>{0x030201, 0x1e140a, 0x8000ff, 0x070707});
}

TEST_CASE("alpha is left out, and gray is taken for all channels") {
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> with_alpha{9, 8, 7, 255}, gray{77}, gray_and_alpha{66, 255};
  CHECK(read_texture(write(folder / "a.png", 1, 1, 4, OIIO::TypeDesc::UINT8, with_alpha), {}).levels[0].texels[0] == 0x070809);
  CHECK(read_texture(write(folder / "g.png", 1, 1, 1, OIIO::TypeDesc::UINT8, gray), {}).levels[0].texels[0] == 0x4d4d4d);
  CHECK(read_texture(write(folder / "h.png", 1, 1, 2, OIIO::TypeDesc::UINT8, gray_and_alpha), {}).levels[0].texels[0] ==
        0x424242);
}

TEST_CASE("colours are those of the file, however transparent the texel is") {
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> texels{200, 100, 50, 0, 200, 100, 50, 128};
  for (const std::string name : {"a.png", "a.tga"}) {
    CAPTURE(name);
    const auto output = OIIO::ImageOutput::create(name);
    OIIO::ImageSpec spec(2, 1, 4, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    REQUIRE(output->open((folder / name).string(), spec));
    REQUIRE(output->write_image(OIIO::TypeDesc::UINT8, texels.data()));
    REQUIRE(output->close());
    CHECK(read_texture(folder / name, {}).levels[0].texels == std::vector<std::uint32_t>{0x3264c8, 0x3264c8});
  }
}

/// 2x1 pixels of the same palette's entry 0, of 200 100 50, the first transparent by entry 1, which has the same colour.
const std::string transparent_gif(
    "GIF89a\2\0\1\0\x80\0\0\xc8\x64\x32\xc8\x64\x32!\xf9\4\1\0\0\1\0,\0\0\0\0\2\0\1\0\0\2\2\x0c\x0a\0;", 44);

TEST_CASE("so they are of a GIF, and of a TIFF whose colours lie multiplied in the file") {
  const TemporaryFolder folder;
  write_text(folder / "a.gif", transparent_gif);
  CHECK(read_texture(folder / "a.gif", {}).levels[0].texels == std::vector<std::uint32_t>{0x3264c8, 0x3264c8});
  const std::vector<std::uint8_t> texels{100, 50, 25, 128};
  const Texture texture = read_texture(write(folder / "a.tif", 1, 1, 4, OIIO::TypeDesc::UINT8, texels), {});
  CHECK(texture.levels[0].texels[0] == 0x3264c7);  // 100 * 255 / 128, and so on
}

TEST_CASE("an EXR's colours, which are multiplied by its alpha, are divided by it where alpha counts") {
  const TemporaryFolder folder;
  const std::vector<float> light{0.25F, 0.125F, 0.5F, 0.5F};
  const std::string path = write(folder / "a.exr", 1, 1, 4, OIIO::TypeDesc::FLOAT, light);
  const Texture kept = read_texture(path, {.alpha = apps::TextureAlpha::kept});
  REQUIRE(kept.format == TexelFormat::srgb_alpha);
  const core::Vec3d color(core::decoded(kept.format, kept.levels[0].texels[0]));
  CHECK(length(color - core::Vec3d{0.5, 0.25, 1}) < 0.01);
}

namespace {

/// How many of the texels of level 2 come up to half of alpha: of 16 x 16, of which every third is there, with this mode.
std::size_t there_from_afar(const std::string& mode) {
  const TemporaryFolder folder;
  std::vector<std::uint8_t> texels;
  for (std::size_t i = 0; i < 256; ++i) {
    texels.insert(texels.end(), {9, 8, 7, static_cast<std::uint8_t>(i % 3 == 0 ? 255 : 0)});
  }
  write(folder / "a.png", 16, 16, 4, OIIO::TypeDesc::UINT8, texels);
  GltfDocument document;
  const std::size_t positions = document.accessor(document.view(bytes_of(triangle_corners)), 5126, 3, "VEC3"),
                    places = document.accessor(document.view(bytes_of(std::array<float, 6>{0, 0, 1, 0, 0, 1})), 5126, 3, "VEC2");
  write_text(folder / "a.gltf",
             document.text(R"({"material":0,"attributes":{"POSITION":)" + std::to_string(positions) + R"(,"TEXCOORD_0":)" +
                               std::to_string(places) + "}}",
                           R"("materials":[{"alphaMode":")" + mode +
                               R"(","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"textures":[{"source":0}],)" +
                               R"("images":[{"uri":"a.png"}])"));
  const core::Texture texture = apps::read_mesh_file(folder / "a.gltf").scene.textures.at(0);
  return static_cast<std::size_t>(std::count_if(texture.levels.at(2).texels.begin(), texture.levels.at(2).texels.end(),
                                                [](std::uint32_t texel) { return texel >> 24U >= 128; }));
}

}  // namespace

TEST_CASE("what a texture of mode MASK cuts out stays as large from afar, and what blends is the mean") {
  CHECK(there_from_afar("MASK") > 2);
  CHECK(there_from_afar("MASK") < 9);
  CHECK(there_from_afar("BLEND") == 0);
}

TEST_CASE("alpha of a texture that OBJ does not show is said, if some of it is not 1") {
  const TemporaryFolder folder;
  write_text(folder / "a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n");
  write_text(folder / "a.mtl", "newmtl a\nmap_Kd a.png\n");
  for (const std::uint8_t alpha : {std::uint8_t{255}, std::uint8_t{128}}) {
    write(folder / "a.png", 1, 1, 4, OIIO::TypeDesc::UINT8, std::vector<std::uint8_t>{9, 8, 7, alpha});
    const auto notes = apps::read_mesh_file(folder / "a.obj").notes;
    CHECK(std::count(notes.begin(), notes.end(), "textures whose alpha is not shown: 1") == (alpha < 255 ? 1 : 0));
  }
}

/// A lossless pixel of 200 100 50 with alpha 128, written bit by bit by the specification of VP8L: each channel has a code of one
/// symbol.
const std::string lossless_webp("RIFF\030\000\000\000WEBPVP8L\014\000\000\000/\000\000\000\020(Y\221+S\300\000", 32);

TEST_CASE("so they are of a WebP, lossy or not") {
  const TemporaryFolder folder;
  write_text(folder / "a.webp", lossless_webp);
  CHECK(read_texture(folder / "a.webp", {}).levels[0].texels == std::vector<std::uint32_t>{0x3264c8});
  std::vector<std::uint8_t> texels;
  for (int i = 0; i < 16 * 16; ++i) {
    texels.insert(texels.end(), {200, 100, 50, static_cast<std::uint8_t>(i)});
  }
  const std::string lossy = file_text(write(folder / "b.webp", 16, 16, 4, OIIO::TypeDesc::UINT8, texels));
  const std::size_t colours = lossy.find("VP8 ");
  REQUIRE(lossy.find("ALPH") < colours);
  std::string alone = "RIFF" + bytes_of(static_cast<std::uint32_t>(lossy.size() - colours + 4)) + "WEBP" + lossy.substr(colours);
  write_text(folder / "c.webp", alone);
  CHECK(read_texture(folder / "b.webp", {}).levels[0].texels == read_texture(folder / "c.webp", {}).levels[0].texels);
}

TEST_CASE("floats are linear light beyond 1, too") {
  const TemporaryFolder folder;
  const std::vector<float> light{0.5F, 2, 1000};
  const Texture texture = read_texture(write(folder / "a.exr", 1, 1, 3, OIIO::TypeDesc::FLOAT, light), {});
  CHECK(texture.format == TexelFormat::shared_exponent);
  CHECK(color_at(texture, 0).z == doctest::Approx(1000).epsilon(1.0 / 512));
  CHECK(texture.brightest == doctest::Approx(1000).epsilon(1.0 / 512));
}

TEST_CASE("16 bits go through the sRGB curve, and keep more than 8") {
  const TemporaryFolder folder;
  const std::vector<std::uint16_t> values{65535, 32896, 0};
  const Texture texture = read_texture(write(folder / "a.png", 1, 1, 3, OIIO::TypeDesc::UINT16, values), {});
  CHECK(texture.format == TexelFormat::fine_srgb);
  CHECK(color_at(texture, 0).x == 1);
  CHECK(color_at(texture, 0).y == doctest::Approx(0.2159).epsilon(0.0005));
}

TEST_CASE("a saturated colour of 16 bits is as good as one of 8 in each channel") {
  const TemporaryFolder folder;
  const std::vector<std::uint16_t> values{65535, 8000, 3341};
  const Texture texture = read_texture(write(folder / "a.png", 1, 1, 3, OIIO::TypeDesc::UINT16, values), {});
  CHECK(color_at(texture, 0).y == doctest::Approx(0.01383).epsilon(0.005));
  CHECK(color_at(texture, 0).z == doctest::Approx(0.00405).epsilon(0.005));
}

TEST_CASE("what a picture says of gamma and profiles does not count") {
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> gray{128, 128, 128};
  const std::string plain = write(folder / "a.png", 1, 1, 3, OIIO::TypeDesc::UINT8, gray);
  std::string text = file_text(plain);  // a chunk gAMA of 1.0 behind IHDR, which ends with byte 33
  text.insert(33, std::string("\0\0\0\4gAMA\0\1\x86\xa0\x31\xe8\x96\x5f", 16));
  write_text(folder / "gamma.png", text);
  const Texture texture = read_texture(folder / "gamma.png", {});
  CHECK(texture.format == TexelFormat::srgb);
  CHECK(texture.levels[0].texels[0] == 0x808080);
  const std::vector<std::uint8_t> tiff{128, 128, 128};
  CHECK(read_texture(write(folder / "a.tif", 1, 1, 3, OIIO::TypeDesc::UINT8, tiff, "Linear"), {}).format == TexelFormat::srgb);
}

TEST_CASE("the edges asked for are noted") {
  const TemporaryFolder folder;
  const std::string path = write(folder / "a.png", 1, 1, 1, OIIO::TypeDesc::UINT8, std::vector<std::uint8_t>{1});
  CHECK(read_texture(path, {}).wrap_s == core::TextureWrap::repeat);
  const Texture texture = read_texture(path, {core::TextureWrap::mirror, core::TextureWrap::clamp});
  CHECK(texture.wrap_s == core::TextureWrap::mirror);
  CHECK(texture.wrap_t == core::TextureWrap::clamp);
}

TEST_CASE("a picture in memory is read like one in a file, whatever its format") {
  const TemporaryFolder folder;
  for (const std::string format : {"png", "jpg", "tif"}) {
    CAPTURE(format);
    const std::vector<std::uint8_t> bytes(3 * 16 * 16, 200);
    const std::string path = write(folder / ("a." + format), 16, 16, 3, OIIO::TypeDesc::UINT8, bytes);
    const std::string file = file_text(path);
    const Texture texture = read_texture(std::as_bytes(std::span(file)), "model.glb, texture 3", format);
    CHECK(texture.name == "model.glb, texture 3");
    CHECK(texture.levels[0].texels == read_texture(path, {}).levels[0].texels);
  }
}

TEST_CASE("what is no picture is refused by its name") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(read_texture(folder / "none.png", {}), core::InputError);
  write_text(folder / "text.png", "no picture");
  CHECK_THROWS_AS(read_texture(folder / "text.png", {}), core::InputError);
  const std::string nothing;
  CHECK_THROWS_WITH_AS(read_texture(std::as_bytes(std::span(nothing)), "model.glb, texture 0", ""),
                       doctest::Contains("model.glb, texture 0: is no picture that is read"), core::InputError);
}

}  // namespace dmpc::tests::texture_file_test
