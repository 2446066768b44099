#include "apps/edge/system/file_stream.h"

#include <cerrno>

namespace dmpc::apps {

namespace {

constexpr std::size_t kept_bytes = 65536;

}  // namespace

FileStream::FileStream(Files& files, int file) : std::ostream(this), files_(files), file_(file), kept_(kept_bytes) {
  setp(kept_.data(), kept_.data() + kept_.size());
}

int FileStream::finish() {
  flush();
  return error_;
}

int FileStream::overflow(int character) {
  if (sync() != 0) {
    return std::char_traits<char>::eof();
  }
  if (character != std::char_traits<char>::eof()) {
    sputc(std::char_traits<char>::to_char_type(character));
  }
  return std::char_traits<char>::not_eof(character);
}

std::streamsize FileStream::xsputn(const char* text, std::streamsize count) {
  if (count <= epptr() - pptr()) {
    return std::streambuf::xsputn(text, count);
  }
  return sync() == 0 && hand_over({text, static_cast<std::size_t>(count)}) ? count : 0;
}

int FileStream::sync() {
  const bool is_taken = hand_over({pbase(), static_cast<std::size_t>(pptr() - pbase())});
  setp(kept_.data(), kept_.data() + kept_.size());
  return is_taken ? 0 : -1;
}

bool FileStream::hand_over(std::string_view bytes) {
  while (error_ == 0 && !bytes.empty()) {
    const ssize_t count = files_.write(file_, bytes);
    if (count > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    } else if (count == 0 || errno != EINTR) {
      error_ = count == 0 ? EIO : errno;
    }
  }
  return error_ == 0;
}

}  // namespace dmpc::apps
