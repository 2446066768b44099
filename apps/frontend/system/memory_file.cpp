#include "apps/frontend/system/memory_file.h"

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "apps/frontend/system/resource_exhaustion.h"
#include "core/base/expect.h"

namespace dmpc::apps {

MemoryFile::MemoryFile() : file_(::memfd_create("dmpc", MFD_CLOEXEC)) {
  if (!file_.is_open()) {
    const int error = errno;
    throw_if_short(error, "no file in memory can be made");
    throw core::InputError(std::string("this computer lets no file in memory be made (memfd_create): ") + std::strerror(error) +
                           ": other programs are started with one, so let dmpc make that call, as a container's profile may say");
  }
}

std::string MemoryFile::path() const { return "/proc/self/fd/" + std::to_string(descriptor()); }

std::string MemoryFile::bytes() const {
  struct stat status {};
  core::expect(::fstat(descriptor(), &status) == 0, "a file in memory has a size");
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t count = ::pread(descriptor(), bytes.data() + at, bytes.size() - at, static_cast<off_t>(at));
    core::expect(count > 0, "a file in memory can be read");
    at += static_cast<std::size_t>(count);
  }
  return bytes;
}

}  // namespace dmpc::apps
