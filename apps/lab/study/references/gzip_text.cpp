#include "apps/lab/study/references/gzip_text.h"

#include <zlib.h>

#include <new>

#include "core/base/expect.h"

namespace dmpc::apps {

struct GzipText::Stream : z_stream {};

namespace {

constexpr std::size_t buffer_bytes = 64 * 1024;
/// zlib's largest window, and 16 for gzip's headers and checksums, which are verified.
constexpr int gzip_window_bits = 15 + 16;

}  // namespace

GzipText::GzipText(std::istream& packed)
    : std::istream(this), packed_(packed), stream_(std::make_unique<Stream>()), input_(buffer_bytes), text_(buffer_bytes) {
  if (::inflateInit2(stream_.get(), gzip_window_bits) != Z_OK) {
    throw std::bad_alloc();
  }
  exceptions(std::ios::badbit);  // so that exceptions of underflow() are not lost
}

GzipText::~GzipText() { ::inflateEnd(stream_.get()); }

bool GzipText::take_packed() {
  packed_.read(input_.data(), static_cast<std::streamsize>(input_.size()));
  stream_->next_in = reinterpret_cast<Bytef*>(input_.data());
  stream_->avail_in = static_cast<uInt>(packed_.gcount());
  return stream_->avail_in > 0;
}

std::size_t GzipText::unpack() {
  stream_->next_out = reinterpret_cast<Bytef*>(text_.data());
  stream_->avail_out = static_cast<uInt>(text_.size());
  while (stream_->avail_out == text_.size()) {
    if (stream_->avail_in == 0 && !take_packed()) {
      if (is_between_files_) {
        return 0;
      }
      throw core::InputError("is packed by gzip and cut short; pack it anew");
    }
    is_between_files_ = false;
    const int result = ::inflate(stream_.get(), Z_NO_FLUSH);
    if (result == Z_STREAM_END) {
      is_between_files_ = true;
      ::inflateReset(stream_.get());
    } else if (result == Z_MEM_ERROR) {
      throw std::bad_alloc();
    } else if (result != Z_OK && result != Z_BUF_ERROR) {
      throw core::InputError("is packed by gzip and damaged; pack it anew");
    }
  }
  return text_.size() - stream_->avail_out;
}

std::streambuf::int_type GzipText::underflow() {
  const std::size_t count = unpack();
  setg(text_.data(), text_.data(), text_.data() + count);
  return count == 0 ? std::streambuf::traits_type::eof() : std::streambuf::traits_type::to_int_type(*gptr());
}

}  // namespace dmpc::apps
