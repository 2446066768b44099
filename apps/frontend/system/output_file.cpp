#include "apps/frontend/system/output_file.h"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "apps/frontend/system/resource_exhaustion.h"
#include "apps/frontend/system/surroundings.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kept_bytes = 65536;

/// More than one try is needed only if somebody makes files with the names that are about to be used.
constexpr int tries_max = 100;

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

/// Returns a word of 65 random bits, so that two processes never choose the same.
std::string random_word() {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz234567";
  std::string word(13, '\0');
  core::expect(::getrandom(word.data(), word.size(), 0) == static_cast<ssize_t>(word.size()), "random numbers can be had");
  for (char& letter : word) {
    letter = letters[static_cast<unsigned char>(letter) % letters.size()];
  }
  return word;
}

int open_patiently(Files& files, const fs::path& path, int flags) {
  int file = 0;
  do {
    file = files.open(path, flags);
  } while (file < 0 && errno == EINTR);
  return file;
}

/// Returns 0, or an errno.
int sync_patiently(Files& files, int file) {
  while (files.sync(file) != 0) {
    if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

/// Asks a device by writing nothing: on Linux /dev/full reports an error even then.
void ask_device(const fs::path& path, const std::string& what) {
  if (!fs::is_character_file(path)) {
    return;
  }
  const int file = ::open(path.c_str(), O_WRONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  const bool is_taken = file >= 0 && ::write(file, "", 0) == 0;
  const int error = errno;
  if (file >= 0) {
    ::close(file);
  }
  if (!is_taken) {
    throw core::InputError(what + "this device takes nothing: " + std::strerror(error) + "; give another name");
  }
}

/// Returns where a program that opens a dangling link for writing would make the file. No path has more than `links_max` links.
fs::path end_of_links(fs::path path) {
  constexpr int links_max = 40;
  std::error_code error;
  for (int links = 0; links < links_max && fs::is_symlink(path, error); ++links) {
    path = folder_of(path) / fs::read_symlink(path, error);
  }
  const fs::path folder = fs::canonical(folder_of(path), error);
  return error ? path : folder / path.filename();
}

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
  return sync() == 0 && migration({text, static_cast<std::size_t>(count)}) ? count : 0;
}

int FileStream::sync() {
  const bool is_taken = migration({pbase(), static_cast<std::size_t>(pptr() - pbase())});
  setp(kept_.data(), kept_.data() + kept_.size());
  return is_taken ? 0 : -1;
}

bool FileStream::migration(std::string_view bytes) {
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

fs::path hidden_name(const fs::path& target, const std::string& who) {
  return folder_of(target) / (".dmpc-" + who + "-" + target.filename().string());
}

fs::path next_name(const fs::path& target) { return hidden_name(target, "next"); }

fs::path file_behind(const fs::path& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) {
    return path;
  }
  const fs::file_status status = fs::status(path, error);
  if (error == std::errc::permission_denied) {
    throw core::InputError(path.string() +
                           ": this is a symbolic link that may not be followed, give the name of the file itself");
  }
  if (error == std::errc::too_many_symbolic_link_levels) {
    throw core::InputError(path.string() + ": this symbolic link leads round in a circle, remove it or give another name");
  }
  if (!fs::exists(status)) {
    return end_of_links(path);
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
    const std::string message = std::string(what) + " could not be written to the standard output";
    if (is_pipe_broken()) {
      throw BrokenPipe(message);
    }
    throw core::InputError(message);
  }
}

void check_output_path(const fs::path& path, std::string_view option) {
  const std::string what = std::string(option) + " " + path.string() + ": ";
  std::error_code error;
  if (path.empty() || !path.has_filename() || fs::is_directory(path, error)) {
    throw core::InputError(what + "this is a folder, expected the name of a file");
  }
  static_cast<void>(fs::status(path, error));
  if (error == std::errc::filename_too_long) {
    throw core::InputError(what + "this name is too long, give a shorter one");
  }
  const fs::path folder = folder_of(file_behind(path));
  if (!fs::is_directory(folder, error)) {
    throw core::InputError(what + "there is no folder " + folder.string() + ", make it first");
  }
  if (is_special(path) || is_standard_output(path)) {
    ask_device(path, what);
    return;
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw core::InputError(what + "cannot write into the folder " + folder.string() + ": " + std::strerror(errno));
  }
  OutputFile probe(path, {.durability = Durability::until_power_loss, .option = std::string(option)});
  probe.write("\n");
}

void make_output_folder(const fs::path& path, std::string_view option) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error || !fs::is_directory(path)) {
    throw core::InputError(std::string(option) + " " + path.string() + ": expected a folder, or a name for one that can be made");
  }
  check_output_path(path / "file", option);
}

OutputFile::OutputFile(const fs::path& path) : OutputFile(path, Settings{}) {}

OutputFile::OutputFile(const fs::path& path, const Settings& settings, Files& files)
    : settings_(settings), files_(files), target_(file_behind(path)), temporary_(target_) {
  open();
  try {
    stream_.emplace(files_, file_);
  } catch (...) {  // no destructor runs
    drop();
    throw;
  }
}

void OutputFile::open() {
  if (is_special(target_)) {
    file_ = open_patiently(files_, target_, O_WRONLY | O_NOCTTY);
  } else {
    for (int tries = 0; file_ < 0 && (tries == 0 || (errno == EEXIST && tries < tries_max)); ++tries) {
      // The target's fixed temporary name may be in use by somebody else's file, which may not be removable: then a random name
      // is used.
      const bool is_random = settings_.name == TemporaryName::random || tries > 0;
      make(is_random ? folder_of(target_) / (".dmpc-" + random_word()) : next_name(target_));
    }
  }
  if (file_ < 0) {
    fail("cannot be written", errno);
  }
}

/// A file without a name (O_TMPFILE) would leave nothing after a SIGKILL, but no call gives it a name that is in use: it would
/// still need a temporary name, if for a shorter time, and another way to write on file systems without such files.
void OutputFile::make(const fs::path& temporary) {
  temporary_ = temporary;
  removed_at_once_.reset();
  removed_at_once_.emplace(temporary_);
  if (settings_.name == TemporaryName::of_target) {
    files_.remove(temporary_);  // left by a killed process
  }
  file_ = open_patiently(files_, temporary_, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW);
  if (file_ >= 0) {
    files_.take_mode(file_, target_);
  }
}

OutputFile::~OutputFile() { drop(); }

void OutputFile::drop() {
  close();
  if (is_temporary() && !is_renamed_) {
    files_.remove(temporary_);
  }
}

/// Returns 0, or an errno.
int OutputFile::close() {
  const bool is_closed = file_ < 0 || files_.close(std::exchange(file_, -1)) == 0 || errno == EINTR;
  return is_closed ? 0 : errno;
}

void OutputFile::write(std::string_view text) {
  *stream_ << text;
  if (const int error = stream_->finish(); error != 0) {
    fail("cannot be written", error);
  }
}

void OutputFile::commit() {
  const bool is_synced = is_temporary() && settings_.durability == Durability::on_disk;
  int error = stream_->finish();
  if (error == 0 && is_synced) {
    error = sync_patiently(files_, file_);
  }
  if (const int failure = close(); error == 0) {
    error = failure;
  }
  if (error != 0) {
    fail("cannot be written", error);
  }
  if (is_temporary() && files_.rename(temporary_, target_) != 0) {
    fail("cannot be written", errno);
  }
  is_renamed_ = true;
  if (is_synced) {
    sync_folder();
  }
}

/// If folders cannot be read or synced, nothing better can be done, and nothing has failed.
void OutputFile::sync_folder() const {
  const int folder = open_patiently(files_, folder_of(target_), O_RDONLY | O_DIRECTORY);
  if (folder < 0 && errno == EACCES) {
    return;
  }
  const int error = folder < 0 ? errno : sync_patiently(files_, folder);
  if (folder >= 0) {
    files_.close(folder);
  }
  if (error != 0 && error != EINVAL && error != EROFS && error != ENOTSUP) {
    fail("is written, but a loss of power might take it away", error);
  }
}

void OutputFile::fail(const std::string& what, int error) const {
  const std::string option = settings_.option.empty() ? "" : settings_.option + " ";
  const std::string sentence = option + target_.string() + ": " + what;
  throw_if_short(error, sentence);
  throw core::InputError(sentence + ": " + std::strerror(error));
}

void write_file(const fs::path& path, std::string_view text, Durability durability, Files& files) {
  OutputFile file(path, {.durability = durability}, files);
  file.write(text);
  file.commit();
}

}  // namespace dmpc::apps
