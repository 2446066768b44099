// Reads pictures in a separate process.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "apps/frontend/system/descriptor.h"
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
  std::string ending;  ///< "tga": for formats that the content does not identify
  bool is_new = true;  ///< its bytes have not yet added reading time
};

/// Opens the ordinary file at `path`. Throws core::InputError "PATH: ..." if there is none.
PictureFile open_picture(const std::filesystem::path& path);
/// Returns a copy in memory of these bytes.
PictureFile picture_of(std::span<const std::byte> bytes, const std::string& name, const std::string& ending);

/// Keeps its process from one picture to the next, as long as the process lives. The first process reads only PNG, JPEG and EXR;
/// once a picture comes that it does not read, it is replaced by the one that reads all formats and is slow to start. All
/// pictures share one time budget, which only their bytes renew, and textures share one memory budget, which is checked before
/// memory is allocated. All functions throw core::InputError "NAME: ...", and core::CapacityError if this computer has not enough
/// memory for the process or for the picture.
class PictureReader {
 public:
  explicit PictureReader(const ReaderLimits& limits = {}) : budget_(limits) {}

  /// Adds reading time for the bytes of files that contain pictures.
  void add_bytes(std::uint64_t bytes) { budget_.add_bytes(bytes); }

  /// Reads the first three channels (the first one is repeated if there are one or two) of the first picture in the file, and
  /// makes its smaller levels. Alpha is left out, and the colours stay as they are; if alpha counts, and some of it is not 1,
  /// texels have 8 bits a channel with it (core::TexelFormat::srgb_alpha). Integers are taken as sRGB, whatever the file says of
  /// gamma or profiles: 8 bits are kept, more are stored as fine_srgb. Floats are linear, and stored with a shared exponent.
  /// Throws core::InputError if there is no such picture, if it is larger than core::Texture::size_max along a side or than any
  /// database, or if it has no texels, several layers, or several samples a texel.
  core::Texture read_texture(const PictureFile& file, const TextureEdges& edges);
  /// Adds the size of a texture, from the bytes before its pixels, to the total of the scene's textures, as read_texture() of all
  /// of them comes later. Throws core::CapacityError, with the texture's name and both sizes, at the one that exceeds the memory,
  /// and core::InputError if the size cannot be determined.
  void weigh_texture(const PictureFile& file);
  /// Returns how many textures had alpha that is not shown, among those for which that is to be reported.
  std::uint64_t hidden_alphas() const { return hidden_alphas_; }
  /// Reads as read_image() of apps/picture/image_file.h does.
  Image read_image(const PictureFile& file);
  /// As above for a sky; that it is not too large for a scene and for this computer is checked before memory is allocated.
  Image read_sky(const PictureFile& file);

 private:
  struct Head {
    std::uint32_t width, height;
    core::TexelFormat format;
    bool hides_alpha;
  };

  /// A request to the process for a picture.
  struct Request {
    Saying saying;
    TextureAlpha alpha;
  };
  /// `plain` reads common PNG, JPEG and EXR pictures, `any` all formats.
  enum class Program : std::uint8_t { plain, any };

  template <class Take>
  void read(const PictureFile& file, const Request& request, const Take& take);
  Head ask(const PictureFile& file, const std::string& format, const Request& request);
  Message answer_of(Program program, const PictureFile& file, const std::string& format, const Request& request);
  void start(Program program, std::uint64_t file_bytes);
  void check_time() const;
  void take_room(const Head& head, std::uint64_t& taken) const;
  void check_sky(const Head& head) const;
  template <class Check>
  Image read_image(const PictureFile& file, const Check& check);
  std::uint64_t memory_bytes_max() const;
  static Head head_of(const Message& message, const PictureFile& file);
  template <class T>
  std::vector<T> receive_values(std::uint64_t count, std::uint64_t believed);
  Message receive();

  ReadingBudget budget_;
  std::optional<ReaderProcess> process_;
  Program program_ = Program::plain;  ///< which program the process runs
  std::uint64_t hidden_alphas_ = 0;
  std::uint64_t memory_bytes_ = 0, weighed_bytes_ = 0, texture_bytes_ = 0;
};

}  // namespace dmpc::apps
