// Any bytes as PLY, STL or OFF, by our own readers: refused with core::InputError, or a scene that is built and rendered. The
// first byte says which.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "apps/foreign/mesh_reader.h"
#include "core/base/expect.h"
#include "tests/fuzz/input_files.h"
#include "tests/fuzz/small_picture.h"
#include "tests/fuzz/targets.h"

namespace dmpc::fuzz {

namespace {

std::optional<core::Scene> read_polygons(const std::string& name, std::span<const std::byte> input) {
  InputFiles files(name, input);
  try {
    apps::MeshScene mesh = apps::read_mesh(name, {.allows_missing = true}, files);
    mesh.scene.vertices = apps::expanded(mesh.vertices);
    return std::move(mesh.scene);
  } catch (const core::InputError& error) {
    core::expect(!std::string_view(error.what()).empty(), "who refuses says why");
  }
  return std::nullopt;
}

}  // namespace

void try_polygon(const std::uint8_t* data, std::size_t size) {
  constexpr std::array<const char*, 3> names{"input.ply", "input.stl", "input.off"};
  if (size == 0) {
    return;
  }
  const std::size_t kind = data[0] % names.size();
  const std::optional<core::Scene> scene = read_polygons(names[kind], std::as_bytes(std::span(data + 1, size - 1)));
  for (std::size_t i = 0; i < names.size(); ++i) {
    covered().count(std::string(names[i]) + " refused", i == kind && !scene);
    covered().count(std::string(names[i]) + " rendered", i == kind && scene.has_value());
  }
  if (scene) {
    tests::check_scene(*scene);
    tests::render_small(*scene);
  }
}

}  // namespace dmpc::fuzz
