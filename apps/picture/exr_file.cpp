#include "apps/picture/exr_file.h"

#include <OpenEXR/openexr.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <new>
#include <string_view>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr int the_part = 0;
constexpr int effort = 4;  ///< floats gain nothing from more

/// Writing fails for want of room alone, and so does packing, which OpenEXR takes for a broken block.
void check(exr_result_t result) {
  if (result == EXR_ERR_OUT_OF_MEMORY || result == EXR_ERR_WRITE_IO || result == EXR_ERR_CORRUPT_CHUNK) {
    throw std::bad_alloc();
  }
  if (result != EXR_ERR_SUCCESS) {
    throw core::InternalError(std::string("OpenEXR: ") + ::exr_get_default_error_message(result));
  }
}

/// Into a std::string, from C that lets nothing be thrown.
std::int64_t write_at(exr_const_context_t, void* file, const void* bytes, std::uint64_t size, std::uint64_t place,
                      exr_stream_error_func_ptr_t) noexcept {
  auto& to = *static_cast<std::string*>(file);
  try {
    to.resize(std::max<std::size_t>(to.size(), place + size));
  } catch (const std::bad_alloc&) {
    return -1;
  }
  std::memcpy(to.data() + place, bytes, size);
  return static_cast<std::int64_t>(size);
}

/// OpenEXR would say it on stderr; check() throws it.
void say_nothing(exr_const_context_t, exr_result_t, const char*) noexcept {}

/// A file on its way into memory.
class ExrWriter {
 public:
  explicit ExrWriter(const ExrPicture& picture);
  ~ExrWriter();
  ExrWriter(const ExrWriter&) = delete;
  ExrWriter& operator=(const ExrWriter&) = delete;

  void write_header();
  void write_rows();
  /// Whole after both.
  std::string take_file() { return std::move(file_); }

 private:
  exr_chunk_info_t block_from(int row);
  void point_at_values(int row);

  const ExrPicture& picture_;
  std::string file_;
  exr_context_t context_ = nullptr;
  exr_encode_pipeline_t encoder_ = EXR_ENCODE_PIPELINE_INITIALIZER;
};

ExrWriter::ExrWriter(const ExrPicture& picture) : picture_(picture) {
  exr_context_initializer_t initializer = EXR_DEFAULT_CONTEXT_INITIALIZER;
  initializer.error_handler_fn = say_nothing;
  initializer.user_data = &file_;
  initializer.write_fn = write_at;
  initializer.zip_level = effort;
  check(::exr_start_write(&context_, "in memory", EXR_WRITE_FILE_DIRECTLY, &initializer));
}

ExrWriter::~ExrWriter() {
  ::exr_encoding_destroy(context_, &encoder_);
  ::exr_finish(&context_);
}

void ExrWriter::write_header() {
  int part = the_part;
  check(::exr_add_part(context_, nullptr, EXR_STORAGE_SCANLINE, &part));
  check(::exr_initialize_required_attr_simple(context_, part, picture_.width, picture_.height, EXR_COMPRESSION_ZIP));
  for (const ExrChannel& channel : picture_.channels) {
    check(::exr_add_channel(context_, part, channel.name.c_str(), EXR_PIXEL_FLOAT, EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
  }
  check(::exr_attr_set_string(context_, part, "Software", "dmpc"));
  for (const auto& [name, text] : picture_.remarks) {
    check(::exr_attr_set_string(context_, part, name.c_str(), text.c_str()));
  }
  check(::exr_write_header(context_));
}

exr_chunk_info_t ExrWriter::block_from(int row) {
  exr_chunk_info_t block = {};
  check(::exr_write_scanline_chunk_info(context_, the_part, row, &block));
  return block;
}

/// OpenEXR sorts the channels by their names.
void ExrWriter::point_at_values(int row) {
  const auto width = static_cast<std::size_t>(picture_.width);
  for (exr_coding_channel_info_t& place : std::span(encoder_.channels, static_cast<std::size_t>(encoder_.channel_count))) {
    const auto channel = std::find_if(picture_.channels.begin(), picture_.channels.end(),
                                      [&](const ExrChannel& one) { return one.name == place.channel_name; });
    const float* const values = channel->values.data() + static_cast<std::size_t>(row) * width * channel->stride;
    place.encode_from_ptr = reinterpret_cast<const std::uint8_t*>(values);
    place.user_pixel_stride = static_cast<std::int32_t>(channel->stride * sizeof(float));
    place.user_line_stride = static_cast<std::int32_t>(width * channel->stride * sizeof(float));
  }
}

void ExrWriter::write_rows() {
  exr_chunk_info_t block = block_from(0);
  check(::exr_encoding_initialize(context_, the_part, &block, &encoder_));
  check(::exr_encoding_choose_default_routines(context_, the_part, &encoder_));
  for (int row = 0;;) {
    point_at_values(row);
    check(::exr_encoding_run(context_, the_part, &encoder_));
    row += block.height;
    if (row >= picture_.height) {
      return;
    }
    block = block_from(row);
    check(::exr_encoding_update(context_, the_part, &block, &encoder_));
  }
}

}  // namespace

std::string exr_file(const ExrPicture& picture) {
  const auto pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  for (const ExrChannel& channel : picture.channels) {
    core::expect(pixels > 0 && (pixels - 1) * channel.stride < channel.values.size(), "a channel has a number for each pixel");
  }
  ExrWriter writer(picture);
  writer.write_header();
  writer.write_rows();
  return writer.take_file();
}

}  // namespace dmpc::apps
