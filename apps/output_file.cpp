#include "apps/output_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <ostream>
#include <system_error>

#include "core/expect.h"

namespace dmpc::apps {

namespace fs = std::filesystem;

namespace {

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

}  // namespace

fs::path hidden_name(const fs::path& target, const std::string& who) {
  return folder_of(target) / (".dmpc-" + who + "-" + target.filename().string());
}

fs::path temporary_name(const fs::path& target, TemporaryName name) {
  return hidden_name(target, name == TemporaryName::of_process ? std::to_string(::getpid()) : "next");
}

fs::path file_behind(const fs::path& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) {
    return path;
  }
  fs::path resolved = fs::weakly_canonical(path, error);
  return error ? path : resolved;
}

bool is_special(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error) && !fs::is_regular_file(path, error);
}

bool is_standard_output(const fs::path& path) {
  struct stat there {};
  struct stat ours {};
  return ::stat(path.c_str(), &there) == 0 && ::fstat(STDOUT_FILENO, &ours) == 0 && there.st_dev == ours.st_dev &&
         there.st_ino == ours.st_ino;
}

void finish_output(std::ostream& output, std::string_view what) {
  if (!output.flush()) {
    throw core::InputError(std::string(what) + " could not be written to the standard output");
  }
}

void check_output_path(const fs::path& path, std::string_view option) {
  const std::string what = std::string(option) + " " + path.string() + ": ";
  std::error_code error;
  if (path.empty() || !path.has_filename() || fs::is_directory(path, error)) {
    throw core::InputError(what + "this is a folder, expected the name of a file");
  }
  const fs::path folder = folder_of(file_behind(path));
  if (!fs::is_directory(folder, error)) {
    throw core::InputError(what + "there is no folder " + folder.string() + ", make it first");
  }
  if (is_special(path) || is_standard_output(path)) {
    return;
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw core::InputError(what + "cannot write into the folder " + folder.string() + ": " + std::strerror(errno));
  }
}

void make_output_folder(const fs::path& path, std::string_view option) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error || !fs::is_directory(path)) {
    throw core::InputError(std::string(option) + " " + path.string() + ": expected a folder, or a name for one that can be made");
  }
  check_output_path(path / "file", option);
}

OutputFile::OutputFile(const fs::path& path, TemporaryName name) : target_(file_behind(path)) {
  if (is_special(target_)) {
    temporary_ = target_;
  } else {
    temporary_ = temporary_name(target_, name);
    removed_at_once_.emplace(temporary_);
  }
}

OutputFile::~OutputFile() {
  if (!committed_ && temporary_ != target_) {
    std::error_code error;
    fs::remove(temporary_, error);
  }
}

void OutputFile::commit() {
  if (temporary_ != target_) {
    std::error_code error;
    fs::rename(temporary_, target_, error);
    if (error) {
      throw core::InputError(target_.string() + ": cannot be written: " + error.message());
    }
  }
  committed_ = true;
}

void write_file(const fs::path& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

void write_to(const std::optional<fs::path>& path, std::string_view text, std::ostream& output, std::string_view what) {
  if (path) {
    write_file(*path, text);
  } else {
    output << text;
    finish_output(output, what);
  }
}

void OutputFile::write(std::string_view text) const {
  std::ofstream stream(temporary_, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) {
    throw core::InputError(target_.string() + ": cannot be written: " + std::strerror(errno));
  }
}

}  // namespace dmpc::apps
