#include "apps/foreign/gltf/images.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <string_view>

#include "core/base/expect.h"

namespace dmpc::apps::gltf {
namespace {

using ImageBytes = std::vector<std::byte>;

bool begins_with(const ImageBytes& bytes, std::string_view beginning, std::size_t at = 0) {
  return bytes.size() >= at + beginning.size() &&
         std::string_view(reinterpret_cast<const char*>(bytes.data()) + at, beginning.size()) == beginning;
}

/// How files of this kind end, by what the bytes begin with: what a document says of them need not be true.
std::string ending_of(const ImageBytes& bytes) {
  if (begins_with(bytes, "\x89PNG")) {
    return "png";
  }
  if (begins_with(bytes, "\xff\xd8\xff")) {
    return "jpg";
  }
  if (begins_with(bytes, "RIFF") && begins_with(bytes, "WEBP", 8)) {
    return "webp";
  }
  return begins_with(bytes, "\xabKTX") ? "ktx2" : begins_with(bytes, "GIF8") ? "gif" : begins_with(bytes, "BM") ? "bmp" : "png";
}

aiTexture* texture_of(const ImageBytes& bytes) {
  core::expect(bytes.size() <= std::numeric_limits<unsigned>::max(), "a picture within a file was checked for its size");
  auto* const texture = new aiTexture;
  texture->pcData = new aiTexel[bytes.size() / sizeof(aiTexel) + 1];
  texture->mWidth = static_cast<unsigned>(bytes.size());
  std::memcpy(reinterpret_cast<char*>(texture->pcData), bytes.data(), bytes.size());
  const std::string ending = ending_of(bytes);
  std::copy(ending.begin(), ending.end(), std::begin(texture->achFormatHint));
  return texture;
}

}  // namespace

std::string Images::name_of(std::size_t image) {
  const Part& part = images_[image];
  const std::string address = part.text("uri", "");
  if (!address.empty() && !is_data(address)) {
    return address;
  }
  if (!numbers_[image]) {
    if (address.empty()) {
      const auto view = buffers_.view(part.required_index("bufferView", buffers_.view_count(), "bufferViews")).bytes;
      within_.emplace_back(view.begin(), view.end());
    } else {
      within_.push_back(bytes_of_data(address, part));
    }
    if (within_.back().size() > std::numeric_limits<unsigned>::max()) {
      part.fail("is larger than 4 GiB");
    }
    numbers_[image] = within_.size() - 1;
  }
  return "*" + std::to_string(*numbers_[image]);
}

void Images::give_to(aiScene& scene) {
  if (within_.empty()) {
    return;
  }
  scene.mTextures = new aiTexture*[within_.size()];
  for (const ImageBytes& bytes : within_) {
    scene.mTextures[scene.mNumTextures] = texture_of(bytes);
    ++scene.mNumTextures;
  }
}

}  // namespace dmpc::apps::gltf
