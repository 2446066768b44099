#include "apps/foreign/import.h"

#include <filesystem>
#include <optional>
#include <utility>

#include "apps/foreign/gltf/counts.h"
#include "apps/foreign/gltf/extensions.h"
#include "apps/foreign/gltf/reader.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

std::vector<std::byte> bytes_of_file(const std::string& path, SceneFiles& files) {
  const std::unique_ptr<FileBytes> file = files.open(path);
  return {file->bytes().begin(), file->bytes().end()};
}

}  // namespace

ImportedFile import_gltf(const std::string& path, SceneFiles& files, const std::optional<AnimationMoment>& animation,
                         core::Copies copies) {
  const std::unique_ptr<FileBytes> file = files.open(path);
  const gltf::Document document = gltf::parse_document(file->bytes());
  if (document.version == 1) {
    throw core::InputError("it is of glTF 1, which nobody writes since 2017: write it anew as glTF 2");
  }
  gltf::check_required(document);
  files.expect(gltf::counts_of(document, file->bytes().size(), copies));
  const auto open = [&](const std::string& name) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    const auto found = files.meant(folder, name);
    return bytes_of_file((found.empty() ? folder / name : found.front()).string(), files);
  };
  return gltf::read_gltf(document, open, animation);
}

}  // namespace dmpc::apps
