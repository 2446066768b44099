// Filtered look-ups in textures against OpenImageIO's texture system, which is given the very levels of ours.
#include "core/picture/surfaces/texture_lookup.h"

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/texture.h>
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "core/scene/texel.h"
#include "tests/support/noise_texture.h"
#include "tests/support/shown_texture.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests::modules_texture_lookup_test {

namespace {

std::vector<float> linear_texels(const core::Texture& texture, const core::TextureLevel& level) {
  std::vector<float> values;
  for (const std::uint32_t texel : level.texels) {
    const core::Color color = core::decoded(texture.format, texel);
    values.insert(values.end(), {color.x, color.y, color.z});
  }
  return values;
}

/// All levels in one file of linear floats.
void write_levels(const core::Texture& texture, const std::string& path) {
  const auto output = OIIO::ImageOutput::create(path);
  REQUIRE(output);
  auto mode = OIIO::ImageOutput::Create;
  for (const core::TextureLevel& level : texture.levels) {
    OIIO::ImageSpec spec(static_cast<int>(level.width), static_cast<int>(level.height), 3, OIIO::TypeDesc::FLOAT);
    spec.tile_width = spec.tile_height = 64;
    spec.attribute("textureformat", "Plain Texture");
    spec.attribute("openexr:levelmode", 1);
    spec.attribute("openexr:roundingmode", 0);
    REQUIRE(output->open(path, spec, mode));
    REQUIRE(output->write_image(OIIO::TypeDesc::FLOAT, linear_texels(texture, level).data()));
    mode = OIIO::ImageOutput::AppendMIPLevel;
  }
  REQUIRE(output->close());
}

OIIO::TextureOpt::Wrap wrap_of(core::TextureWrap wrap) {
  return wrap == core::TextureWrap::repeat   ? OIIO::TextureOpt::WrapPeriodic
         : wrap == core::TextureWrap::mirror ? OIIO::TextureOpt::WrapMirror
                                             : OIIO::TextureOpt::WrapClamp;
}

/// OpenImageIO's answer for a square that covers `share` of the texture along each side.
class Oracle {
 public:
  Oracle(const core::Texture& texture, const TemporaryFolder& folder)
      : path_((folder / "texture.exr").string()), system_(OIIO::TextureSystem::create(true)) {
    write_levels(texture, path_);
    options_.swrap = wrap_of(texture.wrap_s);
    options_.twrap = wrap_of(texture.wrap_t);
    options_.mipmode = OIIO::TextureOpt::MipModeTrilinear;
    options_.interpmode = OIIO::TextureOpt::InterpBilinear;
  }

  std::array<float, 3> look_up(const core::TexturePlace& place, double share) {
    std::array<float, 3> color{};
    const auto s = static_cast<float>(place.s), t = static_cast<float>(place.t), width = static_cast<float>(share);
    const bool found = system_->texture(OIIO::ustring(path_), options_, s, t, width, 0, 0, width, 3, color.data());
    INFO(system_->geterror());
    REQUIRE(found);
    return color;
  }

 private:
  std::string path_;
  OIIO::TextureSystem* system_;  ///< the one that OpenImageIO shares; ends with the program
  OIIO::TextureOpt options_;
};

/// Largest difference of a channel over places drawn at random, at one level of detail.
double largest_difference(ShownTexture& shown, Oracle& oracle, double texels) {
  std::mt19937 random(21);
  std::uniform_real_distribution<float> place(-1.5F, 2.5F);
  double largest = 0;
  for (int i = 0; i < 500; ++i) {
    const core::TexturePlace at{double{place(random)}, double{place(random)}};
    const core::Color ours = shown.look_up(at, texels);
    const auto theirs = oracle.look_up(at, texels / shown.texture().levels[0].width);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      largest = std::max(largest, std::fabs(double{ours[channel]} - double{theirs[channel]}));
    }
  }
  return largest;
}

}  // namespace

TEST_CASE("look-ups are those of OpenImageIO on every level, whatever lies beyond the edges") {
  using core::TextureWrap;
  for (const TextureWrap wrap : {TextureWrap::repeat, TextureWrap::mirror, TextureWrap::clamp}) {
    const TemporaryFolder folder;
    ShownTexture shown(noise_texture(64, 64, wrap, wrap));
    Oracle oracle(shown.texture(), folder);
    for (int level = 0; level < 7; ++level) {
      CAPTURE(level);
      CHECK(largest_difference(shown, oracle, std::ldexp(1.0, level)) < 1e-3);
    }
  }
}

TEST_CASE("between two levels OpenImageIO blends by another share: no farther from ours than that moves it") {
  const TemporaryFolder folder;
  ShownTexture shown(noise_texture(64, 64));
  Oracle oracle(shown.texture(), folder);
  // Ours takes log2(f) of the coarser level for a cone of f texels, 1 to 2, OpenImageIO 2 - 2 / f: up to 0.09 more.
  const double largest = largest_difference(shown, oracle, 3);
  CHECK(largest < 0.1);
  CHECK(largest > 0.001);
}

}  // namespace dmpc::tests::modules_texture_lookup_test
