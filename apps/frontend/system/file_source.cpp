#include "apps/frontend/system/file_source.h"

#include <fcntl.h>

#include <cerrno>

namespace dmpc::apps {

namespace {

constexpr std::size_t read_bytes_kept = 65536;

}  // namespace

FileSource::FileSource(const std::filesystem::path& path, Files& files)
    : std::istream(this), files_(files), kept_(read_bytes_kept) {
  do {
    file_ = files.open(path, O_RDONLY);
  } while (file_ < 0 && errno == EINTR);
  if (file_ < 0) {
    error_ = errno;
    setstate(std::ios::failbit);
  }
}

FileSource::~FileSource() {
  if (file_ >= 0) {
    files_.close(file_);
  }
}

std::streambuf::int_type FileSource::underflow() {
  ssize_t count = -1;
  while (error_ == 0 && (count = files_.read(file_, kept_)) < 0) {
    error_ = errno == EINTR ? 0 : errno;
  }
  if (count <= 0) {
    return std::char_traits<char>::eof();
  }
  setg(kept_.data(), kept_.data(), kept_.data() + count);
  return std::char_traits<char>::to_int_type(*gptr());
}

}  // namespace dmpc::apps
