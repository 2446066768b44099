// PNG and JPEG of every kind, with random pixels.
#pragma once

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>  // which the header of libjpeg takes for granted
#include <cstdlib>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <jpeglib.h>
#include <png.h>

#include "core/base/sampling.h"

namespace dmpc::tests {

/// Rows of bytes, each of which is random, but near to its neighbours where `is_smooth`.
inline std::vector<std::uint8_t> random_bytes(std::size_t count, std::uint64_t seed, bool is_smooth = false) {
  std::vector<std::uint8_t> bytes(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto noise = static_cast<std::uint8_t>(core::mix(seed << 32U | i));
    bytes[i] = is_smooth ? static_cast<std::uint8_t>(i / 7 + noise % 16) : noise;
  }
  return bytes;
}

struct PngKind {
  png_uint_32 width = 13, height = 9;
  int color = PNG_COLOR_TYPE_RGB, depth = 8;
  bool is_interlaced = false, has_transparency = false;
  std::function<void(png_structp, png_infop)> add;  ///< what else it says, before the pixels

  std::string text() const {
    return "colour " + std::to_string(color) + ", " + std::to_string(depth) + " bits" + (is_interlaced ? ", interlaced" : "") +
           (has_transparency ? ", transparency" : "");
  }
};

/// `rows`: each a whole number of bytes, in the file's order.
inline std::string png_of(const PngKind& kind, std::vector<std::uint8_t> rows) {
  std::string file;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &file,
      [](png_structp writer, png_bytep bytes, std::size_t count) {
        static_cast<std::string*>(png_get_io_ptr(writer))->append(reinterpret_cast<const char*>(bytes), count);
      },
      nullptr);
  png_set_IHDR(png, info, kind.width, kind.height, kind.depth, kind.color,
               kind.is_interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  std::vector<png_color> palette;
  for (int entry = 0; entry < 1 << std::min(kind.depth, 8); ++entry) {
    const std::uint64_t random = core::mix(static_cast<std::uint64_t>(entry));
    palette.push_back({static_cast<png_byte>(random), static_cast<png_byte>(random >> 8U), static_cast<png_byte>(random >> 16U)});
  }
  const bool has_palette = kind.color == PNG_COLOR_TYPE_PALETTE;
  if (has_palette) {
    png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
  }
  if (kind.has_transparency) {
    const png_byte alphas[] = {0, 100};
    const png_color_16 transparent{0, rows[0], rows[1], rows[2], static_cast<png_uint_16>(kind.depth == 1 ? 1 : 2)};
    png_set_tRNS(png, info, alphas, has_palette ? 2 : 0, has_palette ? nullptr : &transparent);
  }
  if (kind.add) {
    kind.add(png, info);
  }
  png_write_info(png, info);
  std::vector<png_bytep> starts;
  for (png_uint_32 row = 0; row < kind.height; ++row) {
    starts.push_back(rows.data() + row * png_get_rowbytes(png, info));
  }
  png_write_image(png, starts.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return file;
}

inline std::string png_of(const PngKind& kind, std::uint64_t seed = 1) {
  constexpr std::size_t pixel_bytes_max = 8;
  return png_of(kind, random_bytes(kind.width * kind.height * pixel_bytes_max, seed));
}

/// All colours and depths that there are, interlaced or not, with transparent colours or without where they may have some.
inline std::vector<PngKind> all_png_kinds() {
  std::vector<PngKind> kinds;
  for (const auto& [color, depths] : std::vector<std::pair<int, std::vector<int>>>{{PNG_COLOR_TYPE_GRAY, {1, 2, 4, 8, 16}},
                                                                                   {PNG_COLOR_TYPE_RGB, {8, 16}},
                                                                                   {PNG_COLOR_TYPE_PALETTE, {1, 2, 4, 8}},
                                                                                   {PNG_COLOR_TYPE_GRAY_ALPHA, {8, 16}},
                                                                                   {PNG_COLOR_TYPE_RGB_ALPHA, {8, 16}}}) {
    for (const int depth : depths) {
      for (const bool is_interlaced : {false, true}) {
        for (const bool has_transparency : {false, true}) {
          if (!has_transparency || (color & PNG_COLOR_MASK_ALPHA) == 0) {
            kinds.push_back(
                {.color = color, .depth = depth, .is_interlaced = is_interlaced, .has_transparency = has_transparency});
          }
        }
      }
    }
  }
  return kinds;
}

struct JpegKind {
  JDIMENSION width = 37, height = 29;
  J_COLOR_SPACE colors = JCS_YCbCr;
  int across = 2, down = 2;  ///< pixels of one value of colour
  bool is_progressive = false, is_arithmetic = false;
  unsigned restart = 0;   ///< blocks between two markers
  std::string exif = {};  ///< contents of APP1
  int quality = 90;

  std::string text() const {
    return "colours " + std::to_string(colors) + ", " + std::to_string(across) + "x" + std::to_string(down) +
           (is_progressive ? ", progressive" : "") + (is_arithmetic ? ", arithmetic" : "") + ", restart " +
           std::to_string(restart);
  }
};

inline std::string jpeg_of(const JpegKind& kind, std::uint64_t seed = 1) {
  jpeg_compress_struct state{};
  jpeg_error_mgr manager{};
  state.err = jpeg_std_error(&manager);
  jpeg_create_compress(&state);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&state, &bytes, &size);
  state.image_width = kind.width;
  state.image_height = kind.height;
  state.in_color_space = kind.colors == JCS_YCbCr ? JCS_RGB : kind.colors == JCS_YCCK ? JCS_CMYK : kind.colors;
  state.input_components = kind.colors == JCS_GRAYSCALE ? 1 : kind.colors == JCS_CMYK || kind.colors == JCS_YCCK ? 4 : 3;
  jpeg_set_defaults(&state);
  jpeg_set_colorspace(&state, kind.colors);
  jpeg_set_quality(&state, kind.quality, TRUE);
  state.comp_info[0].h_samp_factor = kind.colors == JCS_GRAYSCALE ? 1 : kind.across;
  state.comp_info[0].v_samp_factor = kind.colors == JCS_GRAYSCALE ? 1 : kind.down;
  state.arith_code = kind.is_arithmetic ? TRUE : FALSE;
  state.restart_interval = kind.restart;
  if (kind.is_progressive) {
    jpeg_simple_progression(&state);
  }
  jpeg_start_compress(&state, TRUE);
  if (!kind.exif.empty()) {
    jpeg_write_marker(&state, JPEG_APP0 + 1, reinterpret_cast<const JOCTET*>(kind.exif.data()),
                      static_cast<unsigned>(kind.exif.size()));
  }
  const std::size_t row_bytes = kind.width * static_cast<std::size_t>(state.input_components);
  std::vector<std::uint8_t> rows = random_bytes(row_bytes * kind.height, seed, true);
  while (state.next_scanline < state.image_height) {
    JSAMPROW row = rows.data() + state.next_scanline * row_bytes;
    jpeg_write_scanlines(&state, &row, 1);
  }
  jpeg_finish_compress(&state);
  std::string file(reinterpret_cast<const char*>(bytes), size);
  jpeg_destroy_compress(&state);
  std::free(bytes);
  return file;
}

}  // namespace dmpc::tests
