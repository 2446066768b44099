#include <csetjmp>
#include <cstdio>  // which the header of libjpeg takes for granted

#include <jpeglib.h>

#include "apps/foreign/plain_picture.h"

namespace dmpc::apps {
namespace {

/// `client_data` is where to go.
[[noreturn]] void leave(j_common_ptr state) noexcept { std::longjmp(*static_cast<std::jmp_buf*>(state->client_data), 1); }

/// Levels of 0 and more are no warnings.
void leave_if_warned(j_common_ptr state, int level) noexcept {
  if (level < 0) {
    leave(state);
  }
}

/// libjpeg's own memory.
class JpegReading {
 public:
  explicit JpegReading(std::span<const std::byte> file) : file_(file) {
    state_.err = ::jpeg_std_error(&manager_);
    manager_.error_exit = leave;
    manager_.emit_message = leave_if_warned;
    state_.client_data = &out_;
  }
  ~JpegReading() { ::jpeg_destroy_decompress(&state_); }
  JpegReading(const JpegReading&) = delete;
  JpegReading& operator=(const JpegReading&) = delete;

  /// False if libjpeg complains. Nothing in here has a destructor, past which it would leave.
  bool read_head() {
    if (setjmp(out_) != 0) {
      return false;
    }
    jpeg_create_decompress(&state_);
    ::jpeg_mem_src(&state_, reinterpret_cast<const unsigned char*>(file_.data()), file_.size());
    return ::jpeg_read_header(&state_, TRUE) == JPEG_HEADER_OK;
  }
  /// Likewise.
  bool read_rows(std::uint8_t* row) {
    if (setjmp(out_) != 0) {
      return false;
    }
    ::jpeg_start_decompress(&state_);
    const std::size_t row_bytes = state_.output_width * static_cast<std::size_t>(state_.output_components);
    while (state_.output_scanline < state_.output_height) {
      JSAMPROW rows = row + state_.output_scanline * row_bytes;
      ::jpeg_read_scanlines(&state_, &rows, 1);
    }
    return true;
  }
  const jpeg_decompress_struct& state() const { return state_; }

 private:
  std::span<const std::byte> file_;
  jpeg_error_mgr manager_{};
  std::jmp_buf out_{};
  jpeg_decompress_struct state_{};
};

}  // namespace

std::optional<RawPicture> jpeg_picture(std::span<const std::byte> file, std::uint64_t pixels_max, bool has_values) {
  JpegReading reading(file);
  if (!reading.read_head()) {
    return std::nullopt;
  }
  const jpeg_decompress_struct& state = reading.state();
  const bool is_plain = state.jpeg_color_space == JCS_GRAYSCALE || state.jpeg_color_space == JCS_YCbCr;
  if (!is_plain || !is_plain_size(state.image_width, state.image_height, 1, file.size(), pixels_max)) {
    return std::nullopt;
  }
  RawPicture picture{.width = state.image_width, .height = state.image_height, .channels = state.num_components, .values = {}};
  if (!has_values) {
    return picture;
  }
  picture.values.resize(std::size_t{picture.width} * picture.height * static_cast<std::size_t>(picture.channels));
  return reading.read_rows(picture.values.data()) ? std::optional(std::move(picture)) : std::nullopt;
}

}  // namespace dmpc::apps
