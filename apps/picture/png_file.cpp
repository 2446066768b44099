#include "apps/picture/png_file.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <memory>
#include <new>
#include <vector>

#include "apps/picture/deflater.h"
#include "apps/picture/png_filter.h"
#include "core/base/expect.h"
#include "core/base/units.h"
#include "core/database/parallel.h"

namespace dmpc::apps {
namespace {

constexpr std::size_t pixel_bytes = 3;
constexpr int png_effort = 7;  ///< compresses as well as libpng's zlib level, in two thirds of the time

/// Rows that a thread filters at a time.
constexpr std::size_t band_rows = 32;

/// Size of a part of the packed rows, and of what libpng writes beside it.
constexpr std::size_t part_bytes = std::size_t{1} << 20U;
constexpr std::size_t frame_bytes = 12, other_bytes = 128;

/// Uninitialized bytes, so that only the needed ones are touched.
struct RawBytes {
  explicit RawBytes(std::size_t count) : bytes(std::make_unique_for_overwrite<std::uint8_t[]>(count)), size(count) {}
  std::span<std::uint8_t> span() const { return {bytes.get(), size}; }

  std::unique_ptr<std::uint8_t[]> bytes;
  std::size_t size;
};

/// Filters a band of rows into their positions; it also fetches the row above the band.
void filter_band(const PngRows& picture, std::size_t row_bytes, std::size_t first, std::size_t end, std::span<std::uint8_t> all) {
  const auto width = static_cast<std::size_t>(picture.width);
  const std::size_t above = first == 0 ? 0 : 1;
  std::vector<std::uint8_t> rows((end - first + above) * row_bytes);
  picture.take((first - above) * width, rows);
  PngFilter filter(row_bytes);
  for (std::size_t row = first; row < end; ++row) {
    const std::span rest = std::span(rows).subspan((row - first + above) * row_bytes);
    const std::span before = row == 0 ? std::span<std::uint8_t>() : std::span(rest.data() - row_bytes, row_bytes);
    filter.filter(rest.first(row_bytes), before, all.subspan(row * (1 + row_bytes), 1 + row_bytes));
  }
}

/// Returns all rows, filtered. The result does not depend on the number of threads.
RawBytes filtered_rows(const PngRows& picture, std::uint32_t threads) {
  const std::size_t row_bytes = pixel_bytes * static_cast<std::size_t>(picture.width);
  const auto rows = static_cast<std::size_t>(picture.height);
  RawBytes all(rows * (1 + row_bytes));
  core::Parallel(threads).for_each(core::ceil_divide(rows, band_rows), [&](std::size_t band) {
    filter_band(picture, row_bytes, band * band_rows, std::min(rows, (band + 1) * band_rows), all.span());
  });
  return all;
}

/// A file written into memory, and the error if it failed.
struct PngFile {
  std::string bytes;  ///< reserved for everything that follows
  std::array<char, 80> complaint{};
};

void append(png_structp png, png_bytep bytes, std::size_t count) noexcept {
  static_cast<PngFile*>(::png_get_io_ptr(png))->bytes.append(reinterpret_cast<const char*>(bytes), count);
}

void flush(png_structp) noexcept {}

/// libpng requires that this does not return.
[[noreturn]] void leave(png_structp png, png_const_charp message) noexcept {
  auto& file = *static_cast<PngFile*>(::png_get_error_ptr(png));
  static_cast<void>(std::snprintf(file.complaint.data(), file.complaint.size(), "%s", message));
  png_longjmp(png, 1);
}

void say_nothing(png_structp, png_const_charp) noexcept {}

/// libpng's own memory.
class PngMemory {
 public:
  explicit PngMemory(PngFile& file) : png_(::png_create_write_struct(PNG_LIBPNG_VER_STRING, &file, leave, say_nothing)) {
    info_ = png_ == nullptr ? nullptr : ::png_create_info_struct(png_);
    if (info_ == nullptr) {
      ::png_destroy_write_struct(&png_, nullptr);
      throw std::bad_alloc();
    }
  }
  ~PngMemory() { ::png_destroy_write_struct(&png_, &info_); }
  PngMemory(const PngMemory&) = delete;
  PngMemory& operator=(const PngMemory&) = delete;

  png_structp png() const { return png_; }
  png_infop info() const { return info_; }

 private:
  png_structp png_;
  png_infop info_;
};

/// Returns false if libpng reports an error. Nothing in here has a destructor, since libpng would jump past it.
bool write_chunks(png_structp png, png_infop info, png_uint_32 width, png_uint_32 height, std::span<const std::uint8_t> packed) {
  if (setjmp(png_jmpbuf(png)) != 0) {
    return false;
  }
  ::png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  ::png_set_IHDR(png, info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
  ::png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  ::png_write_info(png, info);
  for (std::size_t first = 0; first < packed.size(); first += part_bytes) {
    const std::size_t count = std::min(part_bytes, packed.size() - first);
    ::png_write_chunk(png, reinterpret_cast<png_const_bytep>("IDAT"), packed.data() + first, count);
  }
  ::png_write_chunk(png, reinterpret_cast<png_const_bytep>("IEND"), nullptr, 0);
  return true;
}

std::string file_of(int width, int height, std::span<const std::uint8_t> packed) {
  PngFile file;
  file.bytes.reserve(packed.size() + frame_bytes * core::ceil_divide(packed.size(), part_bytes) + other_bytes);
  const PngMemory memory(file);
  ::png_set_write_fn(memory.png(), &file, append, flush);
  if (!write_chunks(memory.png(), memory.info(), static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), packed)) {
    throw core::InternalError("libpng: " + std::string(file.complaint.data()));
  }
  return std::move(file.bytes);
}

}  // namespace

std::string png_file(const PngRows& picture, std::uint32_t threads) {
  core::expect(picture.width > 0 && picture.height > 0, "a picture that is written has pixels");
  Deflater deflater(png_effort);
  const RawBytes filtered = filtered_rows(picture, threads);
  const RawBytes packed(deflater.packed_bytes_max(filtered.size));
  return file_of(picture.width, picture.height, packed.span().first(deflater.pack(filtered.span(), packed.span())));
}

}  // namespace dmpc::apps
