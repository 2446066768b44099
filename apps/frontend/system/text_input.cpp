#include "apps/frontend/system/text_input.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/available_memory.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using Traits = std::streambuf::traits_type;

constexpr std::size_t buffer_bytes = 64 * 1024;
constexpr std::chrono::milliseconds pause{10};

/// The data made from a text take more memory than the text: a scene some ten times as much.
std::uint64_t pipe_bytes_max() { return reader_memory_bytes_max() / 16; }

}  // namespace

TextInput::TextInput(const std::filesystem::path& path, const PipeTimeout& timeout)
    : std::istream(this), name_(path.string()), timeout_(timeout), buffer_(buffer_bytes) {
  // Opening may trigger a device and may block on a pipe, so the type is checked before.
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    fail_with("cannot be opened");
  }
  if (S_ISDIR(status.st_mode)) {
    fail("is a folder, expected a file");
  }
  is_pipe_ = S_ISFIFO(status.st_mode);
  if (!is_pipe_ && !S_ISREG(status.st_mode)) {
    fail("is a device or the like, expected a file or a pipe");
  }
  descriptor_ = Descriptor(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (!descriptor_.is_open()) {
    fail_with("cannot be opened");
  }
  file_bytes_ = is_pipe_ ? 0 : static_cast<std::uint64_t>(status.st_size);
  exceptions(std::ios::badbit);  // so that exceptions of underflow() are not lost
}

void TextInput::fail(const std::string& sentence) const { throw core::InputError(name_ + ": " + sentence); }

void TextInput::fail_with(const std::string& words) const { fail(words + ": " + std::strerror(errno)); }

std::size_t TextInput::read_some() {
  ssize_t count = 0;
  do {
    count = ::read(descriptor_.number(), buffer_.data(), buffer_.size());
  } while (count < 0 && errno == EINTR);
  if (count < 0 && errno != EAGAIN) {
    fail_with("cannot be read");
  }
  return static_cast<std::size_t>(count < 0 ? 0 : count);
}

std::streambuf::int_type TextInput::underflow() {
  const std::size_t count = is_pipe_ ? read_pipe() : read_some();
  bytes_read_ += count;
  if (is_pipe_ && bytes_read_ > pipe_bytes_max()) {
    fail("this pipe has given " + mebibytes_text(bytes_read_) +
         " and does not end, more than there is memory for; write it into a file");
  }
  setg(buffer_.data(), buffer_.data(), buffer_.data() + count);
  return count == 0 ? Traits::eof() : Traits::to_int_type(*gptr());
}

/// A pipe that nobody has opened for writing yet looks as if it had ended.
std::size_t TextInput::read_pipe() {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  while (true) {
    errno = 0;
    const std::size_t count = read_some();
    if (count > 0 || (errno != EAGAIN && bytes_read_ > 0)) {
      return count;
    }
    if (errno == EAGAIN) {
      wait_for_byte();
    } else if (Clock::now() - start > timeout_.writer) {
      fail("is a pipe that nobody writes to; expected text");
    } else {
      ::poll(nullptr, 0, static_cast<int>(pause.count()));
    }
  }
}

void TextInput::wait_for_byte() {
  pollfd entry{.fd = descriptor_.number(), .events = POLLIN, .revents = 0};
  if (::poll(&entry, 1, static_cast<int>(timeout_.byte.count())) == 0) {
    fail("is a pipe that has given nothing for " + std::to_string(timeout_.byte.count() / 1000) +
         " seconds; write it into a file first");
  }
}

std::string bounded_text(const std::filesystem::path& file, std::uint64_t bytes_max, const std::string& expected) {
  TextInput stream(file);
  std::string text;
  std::array<char, 65536> part;
  std::uint64_t bytes = stream.file_bytes();
  while (bytes <= bytes_max && (stream.read(part.data(), part.size()) || stream.gcount() > 0)) {
    text.append(part.data(), static_cast<std::size_t>(stream.gcount()));
    bytes = std::max<std::uint64_t>(bytes, text.size());
  }
  if (bytes > bytes_max) {
    throw core::InputError(file.string() + ": has more than " + mebibytes_text(bytes_max) + ", expected " + expected);
  }
  return text;
}

}  // namespace dmpc::apps
