#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstring>
#include <new>

#include "apps/foreign/plain_picture.h"

namespace dmpc::apps {
namespace {

/// libpng's error handler, which must not return, and its warning handler.
[[noreturn]] void leave(png_structp png, png_const_charp) noexcept { png_longjmp(png, 1); }

void take(png_structp png, png_bytep room, std::size_t count) noexcept {
  auto& rest = *static_cast<std::span<const std::byte>*>(::png_get_io_ptr(png));
  if (count > rest.size()) {
    leave(png, "the file ends early");
  }
  std::memcpy(room, rest.data(), count);
  rest = rest.subspan(count);
}

/// libpng's own memory. It takes what it reads from the front of `file`.
class PngReading {
 public:
  explicit PngReading(std::span<const std::byte>& file)
      : png_(::png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, leave, leave)) {
    info_ = png_ == nullptr ? nullptr : ::png_create_info_struct(png_);
    if (info_ == nullptr) {
      ::png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::bad_alloc();
    }
    ::png_set_read_fn(png_, &file, take);
  }
  ~PngReading() { ::png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReading(const PngReading&) = delete;
  PngReading& operator=(const PngReading&) = delete;

  png_structp png() const { return png_; }
  png_infop info() const { return info_; }

 private:
  png_structp png_;
  png_infop info_;
};

/// Asks for what OpenImageIO asks for. False if libpng complains. Nothing in here has a destructor, past which it would leave.
bool read_head(png_structp png, png_infop info, int& passes) {
  if (setjmp(png_jmpbuf(png)) != 0) {
    return false;
  }
  constexpr int all_but_those_of_pixels = -1;
  ::png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, all_but_those_of_pixels);
  ::png_read_info(png, info);
  ::png_set_expand(png);
  if constexpr (std::endian::native == std::endian::little) {
    ::png_set_swap(png);
  }
  passes = ::png_set_interlace_handling(png);
  ::png_read_update_info(png, info);
  return true;
}

/// Likewise. What follows the rows is looked at where OpenImageIO looks at it.
bool read_rows(png_structp png, png_infop info, int passes, std::uint8_t* first, std::size_t row_bytes, std::uint32_t rows) {
  if (setjmp(png_jmpbuf(png)) != 0) {
    return false;
  }
  for (int pass = 0; pass < passes; ++pass) {
    for (std::uint32_t row = 0; row < rows; ++row) {
      ::png_read_row(png, first + row * row_bytes, nullptr);
    }
  }
  if (passes > 1) {
    ::png_read_end(png, info);
  }
  return true;
}

}  // namespace

std::optional<RawPicture> png_picture(std::span<const std::byte> file, std::uint64_t pixels_max, bool has_values) {
  std::span<const std::byte> rest = file;
  const PngReading reading(rest);
  const auto png = reading.png();
  const auto info = reading.info();
  int passes = 0;
  if (!read_head(png, info, passes)) {
    return std::nullopt;
  }
  RawPicture picture{.width = ::png_get_image_width(png, info),
                     .height = ::png_get_image_height(png, info),
                     .channels = ::png_get_channels(png, info),
                     .value_bytes = ::png_get_bit_depth(png, info) == 16 ? std::size_t{2} : 1,
                     .values = {}};
  const std::size_t row_bytes = picture.width * static_cast<std::size_t>(picture.channels) * picture.value_bytes;
  if (!is_plain_size(picture.width, picture.height, picture.value_bytes, file.size(), pixels_max) ||
      ::png_get_rowbytes(png, info) != row_bytes) {
    return std::nullopt;
  }
  if (!has_values) {
    return picture;
  }
  picture.values.resize(row_bytes * picture.height);
  const bool is_read = read_rows(png, info, passes, picture.values.data(), row_bytes, picture.height);
  return is_read ? std::optional(std::move(picture)) : std::nullopt;
}

}  // namespace dmpc::apps
