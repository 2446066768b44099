// Any bytes as PLY, STL or OFF, by our own readers: refused with core::InputError, or a scene that is built and rendered. The
// first byte says which.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "tests/fuzz/input_files.h"
#include "tests/fuzz/small_picture.h"
#include "tests/fuzz/targets.h"

namespace dmpc::fuzz {

void try_polygon(const std::uint8_t* data, std::size_t size) {
  constexpr std::array<const char*, 3> names{"input.ply", "input.stl", "input.off"};
  if (size == 0) {
    return;
  }
  const std::size_t kind = data[0] % names.size();
  InputFiles files(names[kind], std::as_bytes(std::span(data + 1, size - 1)));
  const std::optional<apps::MeshScene> mesh = read_or_refuse(names[kind], {.allows_missing = true}, files);
  for (std::size_t i = 0; i < names.size(); ++i) {
    covered().count(std::string(names[i]) + " refused", i == kind && !mesh);
    covered().count(std::string(names[i]) + " rendered", i == kind && mesh.has_value());
  }
  if (mesh) {
    tests::check_scene(mesh->scene);
    tests::render_small(mesh->scene);
  }
}

}  // namespace dmpc::fuzz
