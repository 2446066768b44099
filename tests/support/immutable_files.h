// What a process leaves that ends before it has removed anything.
#pragma once

#include "apps/frontend/system/files.h"

namespace dmpc::tests {

/// The files of this computer, none of which is removed.
class ImmutableFiles final : public apps::Files {
 public:
  int open(const std::filesystem::path& path, int flags) override { return files_.open(path, flags); }
  ssize_t read(int file, std::span<char> room) override { return files_.read(file, room); }
  ssize_t write(int file, std::string_view bytes) override { return files_.write(file, bytes); }
  int sync(int file) override { return files_.sync(file); }
  int close(int file) override { return files_.close(file); }
  int rename(const std::filesystem::path& from, const std::filesystem::path& to) override { return files_.rename(from, to); }
  int remove(const std::filesystem::path& /*path*/) override { return 0; }

 private:
  apps::Files& files_ = apps::real_files();
};

}  // namespace dmpc::tests
