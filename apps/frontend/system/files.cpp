#include "apps/frontend/system/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace dmpc::apps {

namespace {

namespace fs = std::filesystem;

class RealFiles final : public Files {
 public:
  int open(const fs::path& path, int flags) override { return ::open(path.c_str(), flags | O_CLOEXEC, 0666); }
  ssize_t read(int file, std::span<char> room) override { return ::read(file, room.data(), room.size()); }
  ssize_t write(int file, std::string_view bytes) override { return ::write(file, bytes.data(), bytes.size()); }
  int sync(int file) override { return ::fsync(file); }
  int close(int file) override { return ::close(file); }
  int rename(const fs::path& from, const fs::path& to) override { return ::rename(from.c_str(), to.c_str()); }
  int remove(const fs::path& path) override { return ::unlink(path.c_str()); }
  void take_mode(int file, const fs::path& like) override {
    struct stat status {};
    if (::lstat(like.c_str(), &status) == 0 && S_ISREG(status.st_mode)) {
      static_cast<void>(!!::fchmod(file, status.st_mode & 0777U));
    }
  }
};

}  // namespace

Files& real_files() {
  static RealFiles files;
  return files;
}

}  // namespace dmpc::apps
