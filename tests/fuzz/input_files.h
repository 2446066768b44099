// What a fuzzer gives a reader of mesh files: one file, and nothing beside it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/foreign/mesh/scene_files.h"
#include "apps/foreign/mesh_reader.h"
#include "core/base/expect.h"

namespace dmpc::fuzz {

class InputBytes final : public apps::FileBytes {
 public:
  explicit InputBytes(std::span<const std::byte> bytes) : bytes_(bytes) {}
  std::span<const std::byte> bytes() const override { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

/// The input is the only file; a picture within it is taken for one.
class InputFiles : public apps::SceneFiles {
 public:
  /// `input` outlives it.
  InputFiles(std::string name, std::span<const std::byte> input, std::uint64_t memory_bytes = std::uint64_t{1} << 30U)
      : SceneFiles(apps::SceneTotals(memory_bytes)), name_(std::move(name)), input_(input) {}

  std::unique_ptr<apps::FileBytes> open(const std::string& path) override {
    if (path != name_) {
      throw core::InputError(path + ": is not there");
    }
    return std::make_unique<InputBytes>(input_);
  }
  bool exists(const std::string& path) override { return path == name_; }
  std::vector<std::filesystem::path> meant(const std::filesystem::path& /*folder*/, const std::string& /*name*/) override {
    return {};
  }
  void add_texture(const std::string& path, const apps::TextureEdges& /*edges*/) override {
    throw core::InputError(path + ": is not there");
  }
  void add_texture(std::span<const std::byte> /*file*/, const std::string& /*name*/, const std::string& /*format_hint*/,
                   const apps::TextureEdges& /*edges*/) override {}
  void show_progress(float share) override { core::expect(share >= 0 && share <= 1, "progress is a share"); }

 private:
  std::string name_;
  std::span<const std::byte> input_;
};

/// What the file of this name is read as, with its vertices; nothing if it is refused, for a reason.
inline std::optional<apps::MeshScene> read_or_refuse(const std::string& name, const apps::MeshOptions& options,
                                                     apps::SceneFiles& files) {
  try {
    apps::MeshScene mesh = apps::read_mesh(name, options, files);
    mesh.scene.vertices = apps::expanded(mesh.vertices);
    return mesh;
  } catch (const core::InputError& error) {
    core::expect(!std::string_view(error.what()).empty(), "who refuses says why");
  }
  return std::nullopt;
}

}  // namespace dmpc::fuzz
