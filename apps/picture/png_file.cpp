#include "apps/picture/png_file.h"

#include <png.h>

#include <cstddef>
#include <new>
#include <string_view>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// What libpng's simplified interface is told, which writes what says that the bytes lie on the sRGB curve by itself.
png_image description(int width, int height) {
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  return image;
}

/// libpng says in words alone why it failed.
[[noreturn]] void fail(const png_image& image) {
  const std::string_view message = image.message;
  if (message.find("memory") != std::string_view::npos) {
    throw std::bad_alloc();
  }
  throw core::InternalError("libpng: " + std::string(message));
}

}  // namespace

std::string png_file(int width, int height, std::span<const std::uint8_t> rgb) {
  core::expect(width > 0 && height > 0 &&
                   rgb.size() == std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
               "a picture has three bytes for each of its pixels");
  png_image image = description(width, height);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);  // so that nothing is packed twice
  std::string file(size, '\0');
  if (::png_image_write_to_memory(&image, file.data(), &size, 0, rgb.data(), 0, nullptr) == 0) {
    fail(image);
  }
  file.resize(size);
  return file;
}

}  // namespace dmpc::apps
