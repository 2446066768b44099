#include "apps/reader/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "apps/frontend/system/resource_exhaustion.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace fs = std::filesystem;

namespace {

/// What leads to an open file whatever becomes of its name.
fs::path link_of(const Descriptor& descriptor) { return "/proc/self/fd/" + std::to_string(descriptor.number()); }

[[noreturn]] void fail_to_open() {
  const int error = errno;
  throw_if_short(error, "no further file can be opened");
  throw core::InputError(std::string("cannot be opened: ") + std::strerror(error));
}

}  // namespace

bool is_ordinary_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

InputFile find_input_file(const fs::path& path) {
  InputFile file;
  file.descriptor = Descriptor(::open(path.c_str(), O_PATH | O_CLOEXEC));
  struct stat status {};
  if (!file.descriptor.is_open() || ::fstat(file.descriptor.number(), &status) != 0) {
    fail_to_open();
  }
  if (S_ISDIR(status.st_mode)) {
    throw core::InputError("is a folder, expected a file");
  }
  if (!S_ISREG(status.st_mode)) {
    throw core::InputError("is a pipe, a device or the like, expected an ordinary file; give the name of one");
  }
  std::error_code error;
  file.resolved = fs::read_symlink(link_of(file.descriptor), error);
  if (std::error_code none; error && !fs::exists("/proc/self/fd", none)) {
    throw core::InputError("cannot be opened, as there is no /proc here, which says what its name leads to: mount it");
  }
  if (error) {
    throw core::InputError("lies so deep in folders that its name cannot be told; move it");
  }
  file.bytes = static_cast<std::uint64_t>(status.st_size);
  return file;
}

void open_input_file(InputFile& file) {
  Descriptor opened(::open(link_of(file.descriptor).c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY));
  if (!opened.is_open()) {
    fail_to_open();
  }
  file.descriptor = std::move(opened);
}

std::uint64_t bytes_without_holes(const Descriptor& file, std::uint64_t bytes) {
  constexpr int pieces_max = 1000;  // the rest of a file with more pieces counts in full
  std::uint64_t holes = 0, at = 0;
  for (int piece = 0; piece < pieces_max && at < bytes; ++piece) {
    const off_t data = ::lseek(file.number(), static_cast<off_t>(at), SEEK_DATA);
    if (data < 0 && errno != ENXIO) {
      holes = 0;  // a file system that does not tell
      break;
    }
    const std::uint64_t begin = data < 0 ? bytes : static_cast<std::uint64_t>(data);
    holes += begin - at;
    const off_t end = data < 0 ? -1 : ::lseek(file.number(), data, SEEK_HOLE);
    at = end < 0 ? bytes : static_cast<std::uint64_t>(end);
  }
  ::lseek(file.number(), 0, SEEK_SET);
  return bytes - std::min(holes, bytes);
}

}  // namespace dmpc::apps
