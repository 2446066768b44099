#include "apps/picture_options.h"

#include <charconv>

#include "core/expect.h"

namespace dmpc::apps {

void add_options(OptionSet options, PictureOptions& picture) {
  options.add_argument(
      "SCENE", [&picture](const std::string& text) { picture.scene = text; },
      "An NFF file, or a built-in scene such as teapot-12, rings-4-t1, tetra-9");
  options.add_text(
      "--resolution", "WxH [the scene's]", [&picture](const std::string& text) { picture.resolution = parse_resolution(text); },
      "Pixels of the picture");
  options.add_number("--samples", picture.samples, 1, 32768, "1", "Rays through each pixel");
  options.add_number("--depth", picture.depth, 1, 255, "5",
                     "Longest chain of reflections and refractions; 1 is the eye's ray alone");
  options.add_choice<core::Convention>("--convention", picture.convention,
                                       {{"haines", core::Convention::haines}, {"paper", core::Convention::paper}},
                                       "When shadow rays are cast: towards lights that the surface faces, or towards all");
}

core::RenderSettings render_settings(const PictureOptions& options, const core::Scene& scene, const core::Database& database) {
  const Resolution size = options.resolution.value_or(Resolution{scene.view.width, scene.view.height});
  return {.header = database.header(),
          .camera = core::Camera(scene.view, database.header().frame, size.width, size.height, options.samples),
          .shade = {.convention = options.convention, .depth_max = options.depth}};
}

Resolution parse_resolution(std::string_view text) {
  Resolution size;
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, size.height);
    const auto pixels = std::int64_t{size.width} * size.height;
    if (height.ec == std::errc() && height.ptr == end && size.width >= 1 && size.height >= 1 && size.width <= 65536 &&
        size.height <= 65536 && pixels <= picture_pixels_max) {
      return size;
    }
  }
  throw core::UsageError("--resolution=" + std::string(text) +
                         ": expected WIDTHxHEIGHT such as 512x384, each 1 to 65536 and at most 268435456 pixels in all");
}

}  // namespace dmpc::apps
