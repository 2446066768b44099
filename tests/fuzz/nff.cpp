// Any bytes as an NFF file: refused with core::InputError, or read, written and read again without a change, built and rendered.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>

#include "apps/formats/nff_reader.h"
#include "apps/formats/nff_writer.h"
#include "core/base/expect.h"
#include "core/scene/scene.h"
#include "tests/fuzz/small_picture.h"
#include "tests/fuzz/targets.h"
#include "tests/support/same_scene.h"

namespace dmpc::fuzz {

namespace {

/// More of them make an input slow and find nothing new.
constexpr std::size_t vertices_max = 2000, lights_max = 16;

std::optional<core::Scene> read(const std::string& text) {
  std::istringstream input(text);
  try {
    return apps::read_nff(input, "input");
  } catch (const core::InputError&) {
    return std::nullopt;
  }
}

bool in_unit_range(const core::Vec3d& color) {
  return std::min({color.x, color.y, color.z}) >= 0 && std::max({color.x, color.y, color.z}) <= 1;
}

/// What apps/formats/nff_reader.h says of every scene that it lets pass.
void check_promises(const core::Scene& scene) {
  using core::expect;
  for (const std::uint64_t bits : tests::bits_of(scene)) {
    expect(std::isfinite(std::bit_cast<double>(bits)), "every number is finite");
  }
  const core::View& view = scene.view;
  expect(view.width >= 1 && view.height >= 1 && std::int64_t{view.width} * view.height <= apps::picture_pixels_max,
         "the picture has a pixel, and not too many");
  expect(view.from != view.at && view.angle_degrees > 0 && view.angle_degrees < 180, "the view looks somewhere");
  expect(in_unit_range(scene.background), "the background is a colour");
  for (const core::Material& material : scene.materials) {
    expect(in_unit_range(material.color) && in_unit_range({material.specular, material.transmittance, 0}), "a material is one");
    expect(material.diffuse >= 0 && std::isfinite(material.diffuse) && material.shine >= 0 && std::isfinite(material.shine),
           "Kd and Shine are 0 or more");
    expect(!(material.transmittance > 0) || material.refraction_index > 0, "what is transparent refracts");
  }
  for (const core::Cone& cone : scene.cones) {
    expect(!(cone.base_radius < 0 && cone.apex_radius > 0) && !(cone.base_radius > 0 && cone.apex_radius < 0),
           "the radii of a cone have one sign");
  }
}

void check_round_trip(const core::Scene& scene) {
  std::ostringstream text;
  apps::NffWriter writer(text);
  core::replay(scene, writer);
  const std::optional<core::Scene> again = read(text.str());
  core::expect(again.has_value(), "what the writer writes is read");
  core::expect(tests::same_scene(scene, *again), "what is written and read again is the same scene");
}

}  // namespace

void try_nff(const std::uint8_t* data, std::size_t size) {
  const std::optional<core::Scene> scene = read(std::string(data, data + size));
  const bool is_tried = scene && scene->vertices.size() <= vertices_max,
             is_rendered = is_tried && scene->lights.size() <= lights_max;
  covered().count("refused", !scene);
  covered().count("read and written", is_tried);
  covered().count("rendered", is_rendered);
  covered().count("with an object", is_rendered && !scene->objects.empty());
  if (is_tried) {
    check_promises(*scene);
    check_round_trip(*scene);
  }
  if (is_rendered) {
    tests::render_tiny(*scene);
  }
}

}  // namespace dmpc::fuzz
