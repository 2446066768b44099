#include "apps/foreign/pbrt/unpacked.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <new>

#include "core/base/expect.h"

namespace dmpc::apps::pbrt {
namespace {

/// Limit of decompressed bytes per compressed byte; zlib's own limit is 1032.
constexpr std::uint64_t growth_max = 1000;
constexpr std::size_t piece_bytes = std::size_t{1} << 20U;
/// zlib's largest window, plus 16 for gzip's headers and checksums.
constexpr int gzip_window_bits = 15 + 16;

class Unpacker {
 public:
  explicit Unpacker(std::string_view file) : rest_(file) {
    if (::inflateInit2(&stream_, gzip_window_bits) != Z_OK) {
      throw std::bad_alloc();
    }
  }
  ~Unpacker() { ::inflateEnd(&stream_); }
  Unpacker(const Unpacker&) = delete;
  Unpacker& operator=(const Unpacker&) = delete;

  std::vector<char> all() {
    const std::uint64_t most = growth_max * std::max<std::uint64_t>(rest_.size(), 1024);
    std::vector<char> text;
    for (bool has_more = true; has_more;) {
      const std::size_t before = text.size();
      text.resize(before + piece_bytes);
      has_more = add_piece(text.data() + before);
      text.resize(text.size() - stream_.avail_out);
      if (text.size() > most) {
        throw core::InputError("what is packed becomes more than 1,000 times as long, which no scene does: write it anew");
      }
    }
    return text;
  }

 private:
  /// Fills a piece as far as there are data; returns whether there are more.
  bool add_piece(char* room) {
    stream_.next_out = reinterpret_cast<Bytef*>(room);
    stream_.avail_out = piece_bytes;
    while (stream_.avail_out > 0) {
      feed();
      const int answer = ::inflate(&stream_, Z_NO_FLUSH);
      if (answer == Z_STREAM_END && rest_.empty() && stream_.avail_in == 0) {
        return false;
      }
      if (answer == Z_MEM_ERROR) {
        throw std::bad_alloc();
      }
      const bool is_cut_short = answer != Z_STREAM_END && rest_.empty() && stream_.avail_in == 0 && stream_.avail_out > 0;
      if ((answer != Z_OK && answer != Z_STREAM_END) || is_cut_short) {
        throw core::InputError(is_cut_short ? "what is packed is cut short: copy the file anew"
                                            : "what is packed is damaged: copy the file anew");
      }
      if (answer == Z_STREAM_END) {
        ::inflateReset(&stream_);  // gzip files may be concatenated
      }
    }
    return true;
  }

  void feed() {
    if (stream_.avail_in == 0) {
      const std::size_t count = std::min<std::size_t>(rest_.size(), std::numeric_limits<uInt>::max());
      stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(rest_.data()));  // zlib only reads it
      stream_.avail_in = static_cast<uInt>(count);
      rest_.remove_prefix(count);
    }
  }

  z_stream stream_{};
  std::string_view rest_;
};

}  // namespace

bool is_packed(std::string_view file) { return file.starts_with("\x1f\x8b"); }

std::vector<char> unpacked(std::string_view file) { return Unpacker(file).all(); }

}  // namespace dmpc::apps::pbrt
