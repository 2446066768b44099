// Files on a disk that is not there, which errs and loses its power as a seed says.
//
// What a power loss keeps is what POSIX promises and no more: bytes that were synced, names whose folder was synced; of the rest
// any part. Bytes that were not synced are cut off anywhere, or zeros, by blocks; of names that were not synced those up to a
// moment, or any of them.
#pragma once

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "apps/frontend/system/files.h"

namespace dmpc::tests {

/// Not thread-safe: one thread at a time calls.
class SimulatedFiles final : public apps::Files {
 public:
  struct Faults {
    std::uint64_t power_lasts_calls = UINT64_MAX;  ///< then the power is lost, before or after what the call does
    std::uint32_t error_every = 0;                 ///< one call of so many fails; 0: none
    std::uint32_t short_every = 0;                 ///< one write or read of so many takes a part; 0: none
  };

  explicit SimulatedFiles(std::uint64_t seed) : random_(seed) {}

  void begin(const Faults& faults);
  bool has_power() const { return has_power_; }
  std::uint64_t errors() const { return errors_; }

  /// From now on all is as after a power loss and a start; also if the power has been there.
  void lose_power();

  using Contents = std::map<std::filesystem::path, std::string>;
  /// What is there now.
  Contents contents() const;
  /// Everything that had this name and was whole when it got it, in order; how many of them, the last of which is meant, are
  /// certain to be there or have been followed by others.
  const std::vector<std::string>& versions(const std::filesystem::path& path) { return versions_[path]; }
  std::size_t certain(const std::filesystem::path& path) { return certain_[path]; }

  int open(const std::filesystem::path& path, int flags) override;
  ssize_t read(int file, std::span<char> room) override;
  ssize_t write(int file, std::string_view bytes) override;
  int sync(int file) override;
  int close(int file) override;
  int rename(const std::filesystem::path& from, const std::filesystem::path& to) override;
  int remove(const std::filesystem::path& path) override;

 private:
  struct File {
    std::string bytes, synced;
    bool is_spoilt = false;  ///< a sync failed: what was not on the disk then never will be
  };
  /// A file that is read, and where.
  struct Reading {
    std::shared_ptr<File> file;
    std::size_t at = 0;
  };
  using Names = std::map<std::filesystem::path, std::shared_ptr<File>>;
  /// What one call did to names.
  using Change = std::map<std::filesystem::path, std::shared_ptr<File>>;
  struct Folder {
    Names names, synced;
    std::vector<Change> changes;  ///< since then
  };

  /// Whether the call is to do what it does; else it fails, with errno set, after `effect` if that is how the power goes.
  template <class Effect>
  bool goes_on(const std::vector<int>& errors, const Effect& effect);
  bool is_one_of(std::uint32_t every) { return every != 0 && random_() % every == 0; }
  void change(const Change& change);
  std::string survivor(const File& file);

  std::mt19937_64 random_;
  Faults faults_;
  bool has_power_ = true;
  std::uint64_t calls_ = 0, errors_ = 0;
  int next_descriptor_ = 1000;
  std::map<std::filesystem::path, Folder> folders_;
  std::map<int, std::shared_ptr<File>> open_files_;
  std::map<int, Reading> readings_;
  std::map<int, std::filesystem::path> open_folders_;
  std::map<std::filesystem::path, std::vector<std::string>> versions_;
  std::map<std::filesystem::path, std::size_t> certain_;
};

inline void SimulatedFiles::begin(const Faults& faults) {
  faults_ = faults;
  calls_ = 0;
}

template <class Effect>
bool SimulatedFiles::goes_on(const std::vector<int>& errors, const Effect& effect) {
  if (has_power_ && ++calls_ > faults_.power_lasts_calls) {
    if (random_() % 2 == 0) {
      effect();
    }
    has_power_ = false;
  }
  if (!has_power_) {
    errno = EIO;
    return false;
  }
  if (!errors.empty() && is_one_of(faults_.error_every)) {
    ++errors_;
    errno = errors[random_() % errors.size()];
    return false;
  }
  effect();
  return true;
}

inline void SimulatedFiles::change(const Change& change) {
  Folder& folder = folders_[change.begin()->first.parent_path()];
  for (const auto& [name, file] : change) {
    folder.names[name] = file;
    if (file == nullptr) {
      folder.names.erase(name);
    }
  }
  folder.changes.push_back(change);
}

inline int SimulatedFiles::open(const std::filesystem::path& path, int flags) {
  const int descriptor = next_descriptor_++;
  if ((flags & O_DIRECTORY) != 0) {
    return goes_on({EINTR, EIO, EMFILE}, [&] { open_folders_[descriptor] = path; }) ? descriptor : -1;
  }
  const Names& names = folders_[path.parent_path()].names;
  const auto found = names.find(path);
  if ((flags & O_CREAT) == 0 && found != names.end()) {
    return goes_on({EINTR, EIO, EMFILE}, [&] { readings_[descriptor].file = found->second; }) ? descriptor : -1;
  }
  if ((flags & O_CREAT) == 0 || found != names.end()) {
    errno = found == names.end() ? ENOENT : EEXIST;
    return -1;
  }
  const auto make = [&] {
    const auto file = std::make_shared<File>();
    change({{path, file}});
    open_files_[descriptor] = file;
  };
  return goes_on({EINTR, ENOSPC, EIO, EMFILE}, make) ? descriptor : -1;
}

inline ssize_t SimulatedFiles::read(int file, std::span<char> room) {
  Reading& reading = readings_.at(file);
  std::size_t count = std::min(room.size(), reading.file->bytes.size() - reading.at);
  if (count > 0 && is_one_of(faults_.short_every)) {
    count = 1 + random_() % count;
  }
  const auto take = [&] {
    reading.file->bytes.copy(room.data(), count, reading.at);
    reading.at += count;
  };
  return goes_on({EINTR, EIO}, take) ? static_cast<ssize_t>(count) : -1;
}

inline ssize_t SimulatedFiles::write(int file, std::string_view bytes) {
  const std::size_t count = is_one_of(faults_.short_every) ? 1 + random_() % bytes.size() : bytes.size();
  const auto add = [&] { open_files_.at(file)->bytes += bytes.substr(0, count); };
  return goes_on({EINTR, ENOSPC, EIO}, add) ? static_cast<ssize_t>(count) : -1;
}

inline int SimulatedFiles::sync(int descriptor) {
  const auto folder = open_folders_.find(descriptor);
  if (folder != open_folders_.end()) {
    const auto keep = [&] {
      Folder& kept = folders_[folder->second];
      kept.synced = kept.names;
      kept.changes.clear();
      for (const auto& [name, file] : kept.names) {
        certain_[name] = versions_[name].size();
      }
    };
    return goes_on({EINTR, EIO}, keep) ? 0 : -1;
  }
  File& file = *open_files_.at(descriptor);
  const bool is_kept = goes_on({EINTR, EIO}, [&] {
    if (!file.is_spoilt) {
      file.synced = file.bytes;
    }
  });
  file.is_spoilt = file.is_spoilt || (!is_kept && errno == EIO);
  return is_kept ? 0 : -1;
}

inline int SimulatedFiles::close(int file) {
  open_files_.erase(file);
  readings_.erase(file);
  open_folders_.erase(file);
  return goes_on({}, [] {}) ? 0 : -1;
}

inline int SimulatedFiles::rename(const std::filesystem::path& from, const std::filesystem::path& to) {
  const auto effect = [&] {
    const std::shared_ptr<File> file = folders_[from.parent_path()].names.at(from);
    versions_[to].push_back(file->bytes);
    change({{from, nullptr}, {to, file}});
  };
  return goes_on({ENOSPC, EIO}, effect) ? 0 : -1;
}

inline int SimulatedFiles::remove(const std::filesystem::path& path) {
  if (folders_[path.parent_path()].names.count(path) == 0) {
    errno = ENOENT;
    return -1;
  }
  return goes_on({EIO}, [&] { change({{path, nullptr}}); }) ? 0 : -1;
}

/// The bytes of a file that a power loss leaves.
inline std::string SimulatedFiles::survivor(const File& file) {
  constexpr std::size_t leaf = 512;
  if (file.bytes == file.synced) {
    return file.synced;
  }
  std::string bytes = file.bytes.substr(0, file.synced.size() + random_() % (file.bytes.size() - file.synced.size() + 1));
  for (std::size_t at = file.synced.size(); at < bytes.size(); at += leaf) {
    if (random_() % 3 == 0) {
      std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                bytes.begin() + static_cast<std::ptrdiff_t>(std::min(at + leaf, bytes.size())), '\0');
    }
  }
  return bytes;
}

inline void SimulatedFiles::lose_power() {
  for (auto& [path, folder] : folders_) {
    const bool is_in_order = random_() % 2 == 0;
    const std::size_t count = random_() % (folder.changes.size() + 1);
    Names names = folder.synced;
    for (std::size_t i = 0; i < folder.changes.size(); ++i) {
      if (is_in_order ? i < count : random_() % 2 == 0) {
        for (const auto& [name, file] : folder.changes[i]) {
          names[name] = file;
        }
      }
    }
    folder = {};
    for (const auto& [name, file] : names) {
      if (file != nullptr) {
        const std::string bytes = survivor(*file);
        folder.names[name] = std::make_shared<File>(File{bytes, bytes});
      }
    }
    folder.synced = folder.names;
  }
  open_files_.clear();
  readings_.clear();
  open_folders_.clear();
  has_power_ = true;
}

inline SimulatedFiles::Contents SimulatedFiles::contents() const {
  Contents contents;
  for (const auto& [path, folder] : folders_) {
    for (const auto& [name, file] : folder.names) {
      contents[name] = file->bytes;
    }
  }
  return contents;
}

}  // namespace dmpc::tests
