// Pictures, read by a process of their own.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "apps/edge/system/descriptor.h"
#include "apps/picture/image_file.h"
#include "apps/picture/texture_file.h"
#include "apps/reader/process.h"
#include "core/scene/texture.h"

namespace dmpc::apps {

/// A file with a picture; `name` is for messages.
struct PictureFile {
  Descriptor descriptor;
  std::uint64_t bytes = 0;
  std::string name;
  std::string ending;  ///< "tga": tells what the content does not
};

/// The ordinary file at `path`. Throws core::InputError "PATH: ..." if there is none.
PictureFile open_picture(const std::filesystem::path& path);
/// A copy in memory of what lies there.
PictureFile picture_of(std::span<const std::byte> bytes, const std::string& name, const std::string& ending);

/// Keeps its process from one picture to the next, as long as that lives. All throw core::InputError "NAME: ...", and
/// core::RoomError, which says so, if this computer has no room for the process or for the picture.
class PictureReader {
 public:
  /// Each picture has its own time, whatever `limits` say.
  explicit PictureReader(const ReaderLimits& limits = {}) : limits_(limits) { limits_.each_file = true; }

  /// As apps/picture/texture_file.h says.
  core::Texture read_texture(const PictureFile& file, const TextureEdges& edges);
  /// As apps/picture/image_file.h says.
  Image read_image(const PictureFile& file);

 private:
  struct Head {
    std::uint32_t width, height;
    core::TexelFormat format;
  };

  template <class Take>
  void read(const PictureFile& file, Saying request, const Take& take);
  void ask(const PictureFile& file, Saying request);
  Head receive_head(const PictureFile& file);
  template <class T>
  std::vector<T> receive_values(std::uint64_t count);
  Message receive();

  ReaderLimits limits_;
  std::optional<ReaderProcess> process_;
  std::uint64_t memory_bytes_ = 0;
};

}  // namespace dmpc::apps
