// Lets a reader process request files from dmpc.
#pragma once

#include "apps/foreign/mesh/scene_files.h"
#include "apps/reader/line.h"

namespace dmpc::apps {

/// dmpc has closed the connection: the result is not wanted any more.
struct HungUp {};

class AskedFiles final : public SceneFiles {
 public:
  AskedFiles(Line& line, const SceneTotals& totals) : SceneFiles(totals), line_(line) {}

  std::unique_ptr<FileBytes> open(const std::string& path) override;
  bool exists(const std::string& path) override;
  std::vector<std::filesystem::path> meant(const std::filesystem::path& folder, const std::string& name) override;
  void add_texture(const std::string& path, const TextureEdges& edges) override;
  void add_texture(std::span<const std::byte> file, const std::string& name, const std::string& format_hint,
                   const TextureEdges& edges) override;
  void only_weigh_textures(bool does) override { weighs_ = does; }
  void show_progress(float share) override;

 private:
  Message ask(Saying question, const Packer& fields);
  void ask_for_texture(Saying question, const Packer& fields, const TextureEdges& edges);
  void send(std::span<const std::byte> bytes);

  Line& line_;
  bool weighs_ = false;
  float shown_ = -1;
};

}  // namespace dmpc::apps
