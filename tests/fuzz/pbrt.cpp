// Any bytes as a scene of pbrt-v4, by our reader: refused with core::InputError, or a scene that is built and rendered. What
// stands behind the first byte 0, if there is one, is every other file that the scene names.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
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

using Bytes = std::span<const std::byte>;

constexpr const char* name = "input.pbrt";

class SceneAndPart final : public InputFiles {
 public:
  explicit SceneAndPart(Bytes input) : InputFiles(name, input), scene_(input), other_(input.subspan(input.size())) {
    if (const auto end = std::find(input.begin(), input.end(), std::byte{0}); end != input.end()) {
      scene_ = input.first(static_cast<std::size_t>(end - input.begin()));
      other_ = input.subspan(scene_.size() + 1);
    }
  }

  std::unique_ptr<apps::FileBytes> open(const std::string& path) override {
    if (path != name && other_.empty()) {
      throw core::InputError(path + ": is not there");
    }
    return std::make_unique<InputBytes>(path == name ? scene_ : other_);
  }
  bool exists(const std::string& path) override { return path == name || !other_.empty(); }

 private:
  Bytes scene_, other_;
};

/// Whether it is read soon: each level of subdivision takes four times as long.
bool is_of_interest(std::string_view text) {
  constexpr double levels_max = 4;
  constexpr std::string_view word = "levels";
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const std::size_t digit = text.find_first_of("+.0123456789", at);
    if (digit != std::string_view::npos && std::strtod(std::string(text.substr(digit, 20)).c_str(), nullptr) > levels_max) {
      return false;
    }
  }
  return text.find("levels") == std::string_view::npos || text.find("Attribute ") == std::string_view::npos;
}

}  // namespace

void try_pbrt(const std::uint8_t* data, std::size_t size) {
  const Bytes input = std::as_bytes(std::span(data, size));
  if (!is_of_interest({reinterpret_cast<const char*>(data), size})) {
    return;
  }
  SceneAndPart files(input);
  const bool is_by_paths = size % 2 == 0;
  std::optional<apps::MeshScene> mesh = read_or_refuse(name, {.allows_missing = true, .is_below_own_sky = is_by_paths}, files);
  core::Scene* const scene = mesh ? &mesh->scene : nullptr;
  covered().count("refused", !scene);
  covered().count("rendered", scene != nullptr);
  covered().count("with a sphere", scene && !scene->spheres.empty());
  covered().count("with what shines",
                  scene && std::any_of(scene->materials.begin(), scene->materials.end(),
                                       [](const auto& material) { return material.emission != core::Vec3d{}; }));
  if (scene) {
    tests::check_textured(*scene);
  }
}

}  // namespace dmpc::fuzz
