#include "apps/picture/exr_file.h"

#include <OpenEXR/openexr.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>

#include "apps/picture/deflater.h"
#include "apps/picture/exr_bytes.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"
#include "core/base/units.h"
#include "core/database/parallel.h"

namespace dmpc::apps {
namespace {

constexpr int the_part = 0;
constexpr int effort = 1;  ///< floats gain little from more: 4 takes half as long again for files 1 to 4 % smaller

using core::operator""_MiB;
/// Limits of the blocks that are packed at a time: several for each thread, so that threads rarely wait for each other, and at
/// most this many bytes.
constexpr std::size_t blocks_a_thread = 4;
constexpr std::size_t blocks_bytes_max = 64_MiB;

/// Writing fails only for lack of memory.
void check(exr_result_t result) {
  if (result == EXR_ERR_OUT_OF_MEMORY || result == EXR_ERR_WRITE_IO) {
    throw std::bad_alloc();
  }
  if (result != EXR_ERR_SUCCESS) {
    throw core::InternalError(std::string("OpenEXR: ") + ::exr_get_default_error_message(result));
  }
}

/// Writes into a std::string, called from C, through which nothing may be thrown.
std::int64_t write_at(exr_const_context_t, void* file, const void* bytes, std::uint64_t size, std::uint64_t place,
                      exr_stream_error_func_ptr_t) noexcept {
  auto& to = *static_cast<std::string*>(file);
  const std::size_t inside = std::min<std::size_t>(size, to.size() - std::min<std::size_t>(to.size(), place));
  try {
    to.resize(std::max<std::size_t>(to.size(), place));
    to.append(static_cast<const char*>(bytes) + inside, size - inside);
  } catch (const std::bad_alloc&) {
    return -1;
  }
  std::memcpy(to.data() + place, bytes, inside);
  return static_cast<std::int64_t>(size);
}

/// OpenEXR would print the error on stderr; check() throws it.
void say_nothing(exr_const_context_t, exr_result_t, const char*) noexcept {}

/// Memory for packing blocks of rows, one after the other, each by any thread.
class BlockPacker {
 public:
  /// `first` is the picture's first block, which is the largest.
  BlockPacker(exr_context_t context, const ExrRows& picture, const exr_chunk_info_t& first)
      : context_(context),
        picture_(picture),
        numbers_(first.unpacked_size / sizeof(float)),
        split_(first.unpacked_size),
        deflated_(first.unpacked_size) {
    check(::exr_encoding_initialize(context_, the_part, &first, &encoder_));
    check(::exr_encoding_choose_default_routines(context_, the_part, &encoder_));
    encoder_.encoding_user_data = this;
    encoder_.compress_fn = deflate;
    encoder_.yield_until_ready_fn = nullptr;
    encoder_.write_fn = nullptr;  // write() does it
  }

  ~BlockPacker() {
    encoder_.compressed_buffer = nullptr;  // the buffer does not belong to OpenEXR
    ::exr_encoding_destroy(context_, &encoder_);
  }

  BlockPacker(const BlockPacker&) = delete;
  BlockPacker& operator=(const BlockPacker&) = delete;

  /// Returns the memory of one packer.
  static std::size_t bytes_for(const exr_chunk_info_t& block) { return 4 * block.unpacked_size + 1_MiB; }

  void pack(const exr_chunk_info_t& block) {
    check(::exr_encoding_update(context_, the_part, &block, &encoder_));
    take_numbers();
    check(::exr_encoding_run(context_, the_part, &encoder_));
  }

  /// Writes the packed block. Requires that the block before it is written.
  void write() {
    check(::exr_write_scanline_chunk(context_, the_part, encoder_.chunk.start_y, encoder_.compressed_buffer,
                                     encoder_.compressed_bytes));
  }

 private:
  /// Replaces OpenEXR's own compression by zlib. A block that does not get smaller is stored uncompressed, which readers
  /// recognize.
  static exr_result_t deflate(exr_encode_pipeline_t* encoder) noexcept {
    auto& self = *static_cast<BlockPacker*>(encoder->encoding_user_data);
    const std::span bytes(static_cast<const std::uint8_t*>(encoder->packed_buffer), encoder->packed_bytes);
    const std::span split = std::span(self.split_).first(bytes.size());
    split_bytes(bytes, split);
    const std::size_t size = self.deflater_.pack(split, std::span(self.deflated_).first(bytes.size() - 1));
    encoder->compressed_buffer = size > 0 ? self.deflated_.data() : encoder->packed_buffer;
    encoder->compressed_bytes = size > 0 ? size : bytes.size();
    encoder->compressed_alloc_size = 0;
    return EXR_ERR_SUCCESS;
  }

  /// OpenEXR sorts the channels by their names.
  void take_numbers() {
    const auto width = static_cast<std::size_t>(picture_.width);
    const std::size_t pixel_floats = picture_.channels.size(), row_floats = width * pixel_floats;
    picture_.take(static_cast<std::size_t>(encoder_.chunk.start_y) * width,
                  std::span(numbers_).first(static_cast<std::size_t>(encoder_.chunk.height) * row_floats));
    for (exr_coding_channel_info_t& place : std::span(encoder_.channels, static_cast<std::size_t>(encoder_.channel_count))) {
      const auto channel = std::find(picture_.channels.begin(), picture_.channels.end(), place.channel_name);
      place.encode_from_ptr = reinterpret_cast<const std::uint8_t*>(numbers_.data() + (channel - picture_.channels.begin()));
      place.user_pixel_stride = static_cast<std::int32_t>(pixel_floats * sizeof(float));
      place.user_line_stride = static_cast<std::int32_t>(row_floats * sizeof(float));
    }
  }

  exr_context_t context_;
  const ExrRows& picture_;
  Deflater deflater_{effort};
  std::vector<float> numbers_;
  std::vector<std::uint8_t> split_, deflated_;
  exr_encode_pipeline_t encoder_ = EXR_ENCODE_PIPELINE_INITIALIZER;
};

/// Returns an upper bound for the size of blocks, each with two numbers before it, so that the file need not be moved as it
/// grows.
std::size_t bytes_max(const std::vector<exr_chunk_info_t>& blocks) {
  return core::sum_over<std::size_t>(
      blocks, [](const exr_chunk_info_t& block) { return block.unpacked_size + 2 * sizeof(std::int32_t); });
}

class ExrWriter {
 public:
  explicit ExrWriter(const ExrRows& picture) : picture_(picture) {
    exr_context_initializer_t initializer = EXR_DEFAULT_CONTEXT_INITIALIZER;
    initializer.error_handler_fn = say_nothing;
    initializer.user_data = &file_;
    initializer.write_fn = write_at;
    check(::exr_start_write(&context_, "in memory", EXR_WRITE_FILE_DIRECTLY, &initializer));
  }

  ~ExrWriter() { ::exr_finish(&context_); }
  ExrWriter(const ExrWriter&) = delete;
  ExrWriter& operator=(const ExrWriter&) = delete;

  void write_header() {
    int part = the_part;
    check(::exr_add_part(context_, nullptr, EXR_STORAGE_SCANLINE, &part));
    check(::exr_initialize_required_attr_simple(context_, part, picture_.width, picture_.height, EXR_COMPRESSION_ZIP));
    for (const std::string& channel : picture_.channels) {
      check(::exr_add_channel(context_, part, channel.c_str(), EXR_PIXEL_FLOAT, EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
    }
    check(::exr_attr_set_string(context_, part, "Software", "dmpc"));
    for (const auto& [name, text] : picture_.remarks) {
      check(::exr_attr_set_string(context_, part, name.c_str(), text.c_str()));
    }
    check(::exr_write_header(context_));
  }

  /// Packs several blocks at a time, each on any thread; this thread writes them in order.
  void write_rows(const core::Parallel& parallel) {
    const std::vector<exr_chunk_info_t> all = blocks();
    const std::size_t room = std::max<std::size_t>(1, blocks_bytes_max / BlockPacker::bytes_for(all.front()));
    const std::size_t wanted = parallel.threads() == 1 ? 1 : blocks_a_thread * parallel.threads();
    std::vector<std::unique_ptr<BlockPacker>> packers(std::min({room, wanted, all.size()}));
    for (auto& packer : packers) {
      packer = std::make_unique<BlockPacker>(context_, picture_, all.front());
    }
    file_.reserve(file_.size() + bytes_max(all));
    for (std::size_t first = 0; first < all.size(); first += packers.size()) {
      const std::size_t count = std::min(packers.size(), all.size() - first);
      parallel.for_each(count, [&](std::size_t i) { packers[i]->pack(all[first + i]); });
      for (std::size_t i = 0; i < count; ++i) {
        packers[i]->write();
      }
    }
  }

  /// The file is complete after both.
  std::string take_file() { return std::move(file_); }

 private:
  exr_chunk_info_t block_from(int row) const {
    exr_chunk_info_t block = {};
    check(::exr_write_scanline_chunk_info(context_, the_part, row, &block));
    return block;
  }

  std::vector<exr_chunk_info_t> blocks() const {
    std::vector<exr_chunk_info_t> all;
    for (int row = 0; row < picture_.height; row += all.back().height) {
      all.push_back(block_from(row));
    }
    return all;
  }

  const ExrRows& picture_;
  std::string file_;
  exr_context_t context_ = nullptr;
};

}  // namespace

std::string exr_file(const ExrRows& picture, std::uint32_t threads) {
  ExrWriter writer(picture);
  writer.write_header();
  writer.write_rows(core::Parallel(threads));
  return writer.take_file();
}

}  // namespace dmpc::apps
