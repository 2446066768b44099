// Any bytes as a .gltf or .glb of version 2, by our own reader: refused with core::InputError, or a scene that is built and
// rendered.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "apps/foreign/gltf/document.h"
#include "core/base/expect.h"
#include "tests/fuzz/input_files.h"
#include "tests/fuzz/small_picture.h"
#include "tests/fuzz/targets.h"

namespace dmpc::fuzz {

namespace {

using Bytes = std::span<const std::byte>;

constexpr const char* name = "input.gltf";

/// Whether our reader gets it, and gets through it soon: what has no bytes in the file may be said to be as large as memory.
bool is_of_interest(Bytes input) {
  constexpr std::uint64_t most = 4096;
  try {
    const apps::gltf::Document document = apps::gltf::parse_document(input);
    for (const apps::gltf::Part& accessor : document.root().list("accessors")) {
      if (accessor.whole("count", 0) > most) {
        return false;
      }
    }
    return true;
  } catch (const core::InputError&) {
    return true;
  }
}

bool has_animation(Bytes input) {
  try {
    return !apps::gltf::parse_document(input).root().list("animations").empty();
  } catch (const core::InputError&) {
    return false;
  }
}

/// At a moment of its first animation, if it has one.
std::optional<core::Scene> read(Bytes input, bool is_animated) {
  InputFiles files(name, input);
  apps::MeshOptions options{.allows_missing = true};
  if (is_animated) {
    options.animation = apps::AnimationMoment{.seconds = 0.7};
  }
  std::optional<apps::MeshScene> mesh = read_or_refuse(name, options, files);
  if (!mesh) {
    return std::nullopt;
  }
  core::expand(mesh->scene, mesh->instances);
  return std::move(mesh->scene);
}

}  // namespace

void try_gltf(const std::uint8_t* data, std::size_t size) {
  const Bytes input = std::as_bytes(std::span(data, size));
  if (!is_of_interest(input)) {
    return;
  }
  const bool is_animated = has_animation(input);
  std::optional<core::Scene> scene = read(input, is_animated);
  covered().count("refused", !scene);
  covered().count("rendered", scene.has_value());
  covered().count("moved by an animation", scene && is_animated);
  covered().count("with a texture", scene && !scene->textures.empty());
  if (scene) {
    tests::check_textured(*scene);
  }
}

}  // namespace dmpc::fuzz
